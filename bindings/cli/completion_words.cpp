#include "completion_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "option_table.h"

namespace tetstream::cli {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : " ").append(word);
  return text;
}

// Of formats that are written, or read.
std::string formatNames(bool written) {
  std::vector<std::string> names;
  const char* name = nullptr;
  int32_t read = 0, write = 0;
  for (int32_t i = 0; tetstream_format_at(i, &name, nullptr, nullptr, &read, &write) >= 0; ++i)
    if (written ? write : read) names.emplace_back(name);
  return joined(names);
}

// The choices of an option of the library's.
std::string tableChoices(const std::string& flag) {
  for (const tetstream_option_info& info : optionTable())
    if (flag == std::string("--") + info.name && info.choices) return info.choices;
  return "";
}

class Collector {
 public:
  explicit Collector(const CLI::App& app)
      : app_(app), read_(formatNames(false)), written_(formatNames(true)) {}
  CompletionWords collect();

 private:
  CompletionFlag flagOf(const CLI::Option& option, const CLI::App& command) const;
  CompletionFlag argumentOf(const CLI::Option& option) const;
  void setValue(CompletionFlag& flag, bool writes) const;
  static void setWords(CompletionFlag& flag, const std::string& words) {
    flag.value = Value::kWords;
    flag.words = words;
  }

  const CLI::App& app_;
  std::string read_, written_;  // names of formats
  CompletionWords words_;
};

// By the flag's name and what its help shows for the value: "yes|no", "FILE". `writes`: the command
// has an OUT, whose format is --format; that of what is read is --format-in then.
void Collector::setValue(CompletionFlag& flag, bool writes) const {
  const std::string& name = flag.names.front();
  std::string choices = tableChoices(name);
  if (choices.empty() && flag.label.find('|') != std::string::npos) {
    choices = flag.label;
    std::replace(choices.begin(), choices.end(), '|', ' ');
  }
  if (name.rfind("--format", 0) == 0) choices = name == "--format" && writes ? written_ : read_;
  if (!choices.empty())
    setWords(flag, choices);
  else if (name == "--tmpdir")
    flag.value = Value::kFolder;
  else
    flag.value = flag.label == "FILE" ? Value::kFile : Value::kAnything;
}

CompletionFlag Collector::flagOf(const CLI::Option& option, const CLI::App& command) const {
  CompletionFlag flag;
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
  flag.text = option.get_description();
  flag.label = option.get_option_text();
  if (option.get_items_expected_max() > 0)
    setValue(flag, command.get_option_no_throw("OUT") != nullptr);
  return flag;
}

CompletionFlag Collector::argumentOf(const CLI::Option& option) const {
  CompletionFlag argument;
  argument.text = option.get_description();
  argument.label = option.get_name(true);
  if (argument.label == "KIND")
    setWords(argument, "fluid ball fluid+stress ball+stress");
  else if (argument.label == "COMMAND")
    setWords(argument, words_.names());
  else if (argument.label == "SHELL")
    setWords(argument, "bash zsh fish");
  else
    argument.value = Value::kFile;
  return argument;
}

CompletionWords Collector::collect() {
  const auto every = [](const CLI::Option*) { return true; };
  for (const CLI::Option* option : app_.get_options(every))
    words_.flags.push_back(flagOf(*option, app_));
  const std::vector<const CLI::App*> commands =
      app_.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands)
    words_.commands.push_back({command->get_name(), command->get_description(), {}, {}});
  for (size_t i = 0; i < commands.size(); ++i)
    for (const CLI::Option* option : commands[i]->get_options(every)) {
      CompletionCommand& command = words_.commands[i];
      if (option->get_positional())
        command.arguments.push_back(argumentOf(*option));
      else
        command.flags.push_back(flagOf(*option, *commands[i]));
    }
  return std::move(words_);
}

}  // namespace

std::string CompletionWords::names() const {
  std::vector<std::string> names;
  for (const CompletionCommand& command : commands) names.push_back(command.name);
  return joined(names);
}

CompletionWords completionWords(const CLI::App& app) {
  return Collector(app).collect();
}

}  // namespace tetstream::cli
