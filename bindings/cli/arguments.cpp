#include "arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>

#include "completion.h"
#include "failure.h"
#include "help_format.h"
#include "text.h"

namespace tetstream::cli {

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 ok, 1 usage, 2 bad data, 3 input or output, 4 memory, 5 target missed (the\n"
    "output is complete), 6 unsupported, 7 cancelled, 8 internal error.";

// Every row of the library's table of formats, one line each.
std::string formatsText() {
  std::string text = "formats:\n";
  const char *name, *extensions, *line;
  int32_t read, write;
  for (int32_t i = 0;
       tetstream_format_at(i, &name, &extensions, &line, &read, &write) == TETSTREAM_OK; ++i) {
    const char* ways = read && write ? "reads, writes" : read ? "reads" : "writes";
    text += textOf("  %-6s %-18s %-14s %s\n", name, extensions, ways, line);
  }
  return text;
}

std::string versionText() {
  return std::string("tetstream ") + tetstream_version_text() + "\n" + formatsText();
}

// CLI11's sentences, in the voice of the others, and where to look.
Failure usageFailure(std::string sentence, const std::string& command) {
  sentence = oneLine(std::move(sentence));
  if (sentence.size() > 1 && std::islower(static_cast<unsigned char>(sentence[1])))
    sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
  const std::string name = command.empty() ? "tetstream" : "tetstream " + command;
  return {kUsage, sentence + "; see `" + name + " --help`"};
}

// note: an empty one is a variable of a script that was not set, not what may be left out.
CLI::Option* addWord(CLI::App* command, const char* name, std::string& word, const char* value,
                     const char* text) {
  const auto problem = [](const std::string& given) {
    return std::string(given.empty() ? "it is empty" : "");
  };
  return command->add_option(name, word, text)->option_text(value)->check(problem);
}

// A word that has to be there.
void addArgument(CLI::App* command, const char* name, std::string& word, const char* text) {
  addWord(command, name, word, " ", text)->required();
}

// The words of the command line, as CLI11 is told about them.
class Parser {
 public:
  // The first of them, if any.
  explicit Parser(const std::string& first);
  Arguments parse(int argc, const char* const* argv);

 private:
  struct Command;
  static const Command kCommands[];
  static std::string namesOfCommands();
  static Failure unknownCommand(const std::string& word);
  void addCommand(const Command& command);
  void addRemark(CLI::App* command, const std::string& remark);
  void addSimplify(CLI::App* command);
  void addInfo(CLI::App* command);
  void addConvert(CLI::App* command);
  void addLayout(CLI::App* command);
  void addGenerate(CLI::App* command);
  void addDiagram(CLI::App* command);
  void addCompare(CLI::App* command);
  void addTitle(CLI::App* command, const char* text);
  void addFields(CLI::App* command, const char* text, const char* value);
  void addHelp(CLI::App* command);
  void addCompletion(CLI::App* command);
  void addIn(CLI::App* command);
  void addOut(CLI::App* command);
  void addFormat(CLI::App* command);
  void addReport(CLI::App* command, const char* what = "Form of the closing report (default text)");
  void addProgress(CLI::App* command);
  void addTraces(CLI::App* command);
  CLI::Option* addTableOption(CLI::App* command, const tetstream_option_info& info);
  void addStreamOptions(CLI::App* command);
  std::string textOfCommand() const;
  std::string helpOf(const std::string& command) const;
  std::string chosenCommand() const;
  std::string unknownOption() const;
  std::string unexpectedText() const;
  void settleFormats();

  CLI::App app_{"Simplifies tetrahedral meshes with fields as a stream.", "tetstream"};
  std::vector<std::pair<CLI::App*, Arguments::Command>> commands_;
  Arguments arguments_;
  std::string format_, help_about_, shell_;
  bool version_ = false;
};

struct Parser::Command {
  const char *name, *text;
  Arguments::Command number;
  bool stands_alone;  // needs to know of no other
  void (Parser::*add)(CLI::App* command);
};

const Parser::Command Parser::kCommands[] = {
    {"simplify", "Make a mesh smaller, following its fields", Arguments::Command::kSimplify, true,
     &Parser::addSimplify},
    {"info", "Say what a mesh holds, how large and how coherent it is", Arguments::Command::kInfo,
     true, &Parser::addInfo},
    {"convert", "Copy a mesh into another format", Arguments::Command::kConvert, true,
     &Parser::addConvert},
    {"layout", "Bring a mesh into an order that streams well", Arguments::Command::kLayout, true,
     &Parser::addLayout},
    {"generate", "Make a mesh to try things with", Arguments::Command::kGenerate, true,
     &Parser::addGenerate},
    {"diagram", "Draw how good the order of a mesh stream is", Arguments::Command::kDiagram, true,
     &Parser::addDiagram},
    {"compare", "Measure how well a simplified mesh follows its original",
     Arguments::Command::kCompare, true, &Parser::addCompare},
    {"help", "Show the help of a command", Arguments::Command::kText, false, &Parser::addHelp},
    {"completion", "Print a script that completes commands in a shell", Arguments::Command::kText,
     false, &Parser::addCompletion}};

// "simplify, ..., help or completion".
std::string Parser::namesOfCommands() {
  std::string names;
  const Command* const last = std::end(kCommands) - 1;
  for (const Command& command : kCommands) {
    if (!names.empty()) names += &command == last ? " or " : ", ";
    names += command.name;
  }
  return names;
}

Failure Parser::unknownCommand(const std::string& word) {
  return usageFailure("there is no command \"" + word + "\", but " + namesOfCommands(), "");
}

// Where the first word is a command that stands alone the others are left out: to tell of them
// takes longer than to read a small mesh.
Parser::Parser(const std::string& first) {
  app_.formatter(helpFormat());
  app_.require_subcommand(0, 1);  // further words are names, whatever they are
  app_.set_help_flag("-h,--help", "Show this text and stop");
  app_.add_flag("--version", version_, "Show the library's version and formats and stop");
  app_.footer(std::string("`tetstream help COMMAND` says more about one.\n") + kExitCodes +
              "\nMore: man tetstream");
  for (const Command& command : kCommands)
    if (first == command.name && command.stands_alone) {
      addCommand(command);
      return;
    }
  for (const Command& command : kCommands) addCommand(command);
}

void Parser::addCommand(const Command& command) {
  CLI::App* const added = app_.add_subcommand(command.name, command.text)->group("Commands");
  addRemark(added, "");
  commands_.emplace_back(added, command.number);
  (this->*command.add)(added);
}

// Below the flags stands a remark, and the name of the command's manual page.
void Parser::addRemark(CLI::App* command, const std::string& remark) {
  command->footer(remark + (remark.empty() ? "" : "\n") + "More: man tetstream-" +
                  command->get_name());
}

void Parser::addIn(CLI::App* command) {
  addArgument(command, "IN", arguments_.in.path, "The mesh: a file, or - for standard input");
  addWord(command, "--format-in", arguments_.in.format, "NAME",
          "Format of IN (its extension, tets for -)");
}

void Parser::addOut(CLI::App* command) {
  addArgument(command, "OUT", arguments_.out.path, "The result: a file, or - for standard output");
  const auto addProperty = [&](const char* flag, const char* property, const char* values,
                               const char* text) {
    command
        ->add_option_function<std::string>(
            flag,
            [=, this](const std::string& value) {
              arguments_.properties.push_back({flag, property, value});
            },
            text)
        ->option_text(values);
  };
  addProperty("--compress", "compress", "yes|no", "Compress OUT (tets, vtu, vtkhdf)");
  addProperty("--vertex-order", "order", "pre|post",
              "Vertices before or after their cells (sva, svb)");
  addProperty("--encoding", "encoding", "binary|text", "Numbers of OUT (msh)");
  addProperty("--msh-version", "version", "4.1|2.2", "Version of OUT's format (msh)");
}

void Parser::addFormat(CLI::App* command) {
  addWord(command, "--format", format_, "NAME",
          "Format of what is -, or of OUT if nothing is (default tets)");
}

void Parser::addReport(CLI::App* command, const char* what) {
  CLI::Option* const form = addWord(command, "--report", arguments_.report, "text|json", what)
                                ->check(CLI::IsMember({"text", "json"}));
  command
      ->add_flag_callback(
          "--json", [this] { arguments_.report = "json"; }, "The same as --report json")
      ->excludes(form)
      ->option_text(" ");  // in place of what it excludes
}

void Parser::addProgress(CLI::App* command) {
  command->add_flag("--progress", arguments_.always_progress,
                    "Show progress even where standard error is no terminal");
  command->add_flag("--quiet", arguments_.quiet, "Say nothing but errors");
}

void Parser::addTraces(CLI::App* command) {
  addWord(command, "--map", arguments_.map.path, "FILE",
          "Tell where each vertex of IN lies in OUT: FILE.tetmap, FILE.csv, - (csv)");
  addWord(command, "--collapse-log", arguments_.log.path, "FILE",
          "Tell every collapse, in order: FILE.tetlog, FILE.csv, - (csv)");
}

CLI::Option* Parser::addTableOption(CLI::App* command, const tetstream_option_info& info) {
  const std::string name = info.name;
  if (info.id == TETSTREAM_OPTION_SPLIT || info.id == TETSTREAM_OPTION_RECOVER ||
      info.id == TETSTREAM_OPTION_CELLS_TO_POINTS) {
    return command->add_flag_callback(
        "--" + name, [this, name] { arguments_.options.values.emplace_back(name, "yes"); },
        info.text);
  }
  return command
      ->add_option_function<std::string>(
          "--" + name,
          [this, name](const std::string& word) {
            arguments_.options.values.emplace_back(name, word);
          },
          helpText(info))
      ->option_text(metavariable(info));
}

// Whether an option counts where a file is read and then worked on in that way.
bool counts(const tetstream_option_info& info, int32_t scope) {
  return (info.scope & (TETSTREAM_SCOPE_READ | scope)) != 0;
}

void Parser::addStreamOptions(CLI::App* command) {
  for (const tetstream_option_info& info : optionTable())
    if (counts(info, TETSTREAM_SCOPE_ORDER)) addTableOption(command, info);
}

void Parser::addSimplify(CLI::App* command) {
  addIn(command);
  addOut(command);
  for (tetstream_option_info info : optionTable()) {
    if (!counts(info, TETSTREAM_SCOPE_SIMPLIFY)) continue;
    // The defaults of the two targets do not hold here: one has to be given.
    if (info.id == TETSTREAM_OPTION_RATIO || info.id == TETSTREAM_OPTION_CELLS)
      info.default_text = nullptr;
    addTableOption(command, info);
  }
  addFields(command, "Measure this field, with that weight (default: all, with 1); may be repeated",
            "NAME[:WEIGHT]");
  addTraces(command);
  addFormat(command);
  addReport(command);
  addProgress(command);
  addRemark(command, std::string("One of --ratio, --cells and --error has to be given. ") +
                         "The report goes to standard output, or to\nstandard error if OUT, or the "
                         "map or the log, is -.\n" +
                         kExitCodes);
}

void Parser::addInfo(CLI::App* command) {
  addArgument(command, "FILE", arguments_.in.path, "The mesh: a file, or - for standard input");
  addWord(command, "--format,--format-in", arguments_.in.format, "NAME",
          "Format of FILE (its extension, tets for -)");
  addReport(command, "Form of what is said (default text)");
  addStreamOptions(command);
  addProgress(command);
}

void Parser::addConvert(CLI::App* command) {
  addIn(command);
  addOut(command);
  addFormat(command);
  addStreamOptions(command);
  addProgress(command);
}

void Parser::addLayout(CLI::App* command) {
  addIn(command);
  addOut(command);
  addFormat(command);
  addStreamOptions(command);
  addReport(command);
  addProgress(command);
  addRemark(command, "The report goes to standard output, or to standard error if OUT is -.");
}

void Parser::addGenerate(CLI::App* command) {
  addArgument(command, "KIND", arguments_.kind,
              "fluid: a box of 1 x 1 x 4; ball: a unit ball; fluid+stress, ball+stress: with a "
              "tensor field, too");
  addOut(command);
  for (tetstream_option_info info : optionTable()) {
    if (info.id == TETSTREAM_OPTION_CELLS) {
      info.text = "how many cells, about: 20000, 3M, 2e7";
      info.default_text = nullptr;
      info.minimum = 1;
      // note: CLI11 finds an option by its name in functions that may not throw, memory or not.
      addTableOption(command, info)->required();
    } else if (info.id == TETSTREAM_OPTION_SEED) {
      info.text = "another seed gives another mesh of the same kind";
      addTableOption(command, info);
    }
  }
  addFormat(command);
  addProgress(command);
}

void Parser::addDiagram(CLI::App* command) {
  addIn(command);
  addArgument(command, "OUT", arguments_.out.path, "The picture: a file, FILE.svg or FILE.png");
  command->add_flag("--sweep", arguments_.sweep,
                    "Draw the mesh at four moments instead: written away, in core, to come");
  addTitle(command, "What stands above it (default: IN's name)");
  const auto addPlaces = [&](const char* name, int32_t& places, const char* text) {
    command->add_option(name, places, text)
        ->option_text("N")
        ->check(CLI::Range(1, TETSTREAM_DIAGRAM_LARGEST));
  };
  addPlaces("--columns", arguments_.columns, "Places of the raster across, 1 to 8192 (1200)");
  addPlaces("--rows", arguments_.rows, "Places of the raster down, 1 to 8192 (800)");
  addStreamOptions(command);
  addProgress(command);
}

void Parser::addTitle(CLI::App* command, const char* text) {
  command->add_option("--title", arguments_.title, text)->option_text("TEXT");
}

void Parser::addFields(CLI::App* command, const char* text, const char* value) {
  command->add_option("--field", arguments_.options.fields, text)
      ->option_text(value)
      ->allow_extra_args(false);
}

void Parser::addCompare(CLI::App* command) {
  addArgument(command, "ORIGINAL", arguments_.in.path,
              "The original: a file, or - for standard input");
  addArgument(command, "SIMPLIFIED", arguments_.second.path, "The simplified mesh, likewise");
  addWord(command, "--format-in", arguments_.in.format, "NAME",
          "Format of ORIGINAL (its extension, tets for -)");
  addWord(command, "--format", arguments_.second.format, "NAME",
          "Format of SIMPLIFIED (its extension, tets for -)");
  addFields(command, "Compare this field (default: all that both have); may be repeated", "NAME");
  addWord(command, "--picture", arguments_.out.path, "FILE",
          "Draw a cut through both, the error on it and its spread: FILE.png or FILE.svg");
  addTitle(command, "What stands above the picture (default: the files' names)");
  // What the table says of runs, in words of a comparison.
  const std::map<int32_t, const char*> texts = {
      {TETSTREAM_OPTION_CUT,
       "plane of the picture: auto, across the shortest axis; x, y, z or x=0.3"},
      {TETSTREAM_OPTION_BOX,
       "part of ORIGINAL whose fields and boundary are compared: x0:x1,y0:y1,z0:z1, whose ends may "
       "be left out (default: all of it)"},
      {TETSTREAM_OPTION_REGIONS,
       "cell array of integers, of one component, whose labels are regions; auto: the first of "
       "both with several values, no ids and not named after processes; none"},
      {TETSTREAM_OPTION_SEED, "another seed takes other samples"},
      {TETSTREAM_OPTION_MEMORY, "bytes that the comparison may take; 0: 512M"},
  };
  for (tetstream_option_info info : optionTable()) {
    if (const auto text = texts.find(info.id); text != texts.end()) info.text = text->second;
    if (info.id == TETSTREAM_OPTION_CUT) info.default_text = "auto";
    if (counts(info, TETSTREAM_SCOPE_COMPARE)) addTableOption(command, info);
  }
  addReport(command);
  addProgress(command);
}

void Parser::addHelp(CLI::App* command) {
  command->footer("More: man tetstream");
  addWord(command, "COMMAND", help_about_, " ", "Its name");
}

void Parser::addCompletion(CLI::App* command) {
  addArgument(command, "SHELL", shell_, "bash, zsh or fish");
}

std::string Parser::textOfCommand() const {
  return shell_.empty() ? helpOf(help_about_) : completionScript(app_, shell_);
}

std::string Parser::helpOf(const std::string& command) const {
  if (command.empty()) return app_.get_formatter()->make_help(&app_, "tetstream", {});
  for (const auto& [app, id] : commands_)
    if (app->get_name() == command)
      return app->get_formatter()->make_help(app, "tetstream " + command, {});
  throw unknownCommand(command);
}

// --format is for "-", on either side; if there is none, or --format-in tells of it, for OUT.
void Parser::settleFormats() {
  if (format_.empty()) return;
  const bool is_of_in = arguments_.in.isStandard() && arguments_.in.format.empty();
  if (is_of_in) arguments_.in.format = format_;
  if (arguments_.out.isStandard() || !is_of_in) arguments_.out.format = format_;
}

// The command among the words read so far, or nothing.
std::string Parser::chosenCommand() const {
  const std::vector<CLI::App*> chosen = app_.get_subcommands();
  return chosen.empty() ? "" : chosen.front()->get_name();
}

// One that the command does not know, or "". Behind --, all are arguments.
std::string Parser::unknownOption() const {
  for (const std::string& word : app_.remaining(true)) {
    if (word == "--") break;
    if (word.size() > 1 && word.front() == '-') return word;
  }
  return "";
}

// What the command has no place for: an option that it does not know, before what follows that.
std::string Parser::unexpectedText() const {
  std::vector<std::string> words = app_.remaining();
  if (!words.empty() && !chosenCommand().empty())
    return "options follow the command, but " + words.front() + " comes before it";
  if (const std::string option = unknownOption(); !option.empty())
    return "there is no option " + option;
  words = app_.remaining(true);
  if (const auto mark = std::find(words.begin(), words.end(), "--"); mark != words.end())
    words.erase(mark);
  return words.empty() ? "there are more words than arguments"
                       : "one argument too many: " + words.front();
}

Arguments Parser::parse(int argc, const char* const* argv) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    arguments_.text = helpOf(chosenCommand());
    return arguments_;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string_view what = error.what();
    throw usageFailure(std::string(what.substr(0, what.find(':'))) + " takes one value, once",
                       chosenCommand());
  } catch (const CLI::ParseError& error) {
    if (chosenCommand().empty() && argv[1][0] != '-') throw unknownCommand(argv[1]);
    const bool lacks = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const bool has_more = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                          (lacks && !unknownOption().empty());
    throw usageFailure(has_more ? unexpectedText() : error.what(), chosenCommand());
  }
  if (version_) {
    arguments_.text = versionText();
    return arguments_;
  }
  for (const auto& [app, id] : commands_)
    if (app->parsed()) {
      arguments_.command = id;
      arguments_.options.weighs_fields = id == Arguments::Command::kSimplify;
      if (id == Arguments::Command::kText) arguments_.text = textOfCommand();
      settleFormats();
      return arguments_;
    }
  throw usageFailure("which command? " + namesOfCommands(), "");
}

}  // namespace

Arguments parseArguments(int argc, const char* const* argv) {
  return Parser(argc > 1 ? argv[1] : "").parse(argc, argv);
}

}  // namespace tetstream::cli
