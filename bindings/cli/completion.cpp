#include "completion.h"

#include <initializer_list>
#include <string_view>

#include "completion_words.h"
#include "failure.h"
#include "text.h"

namespace tetstream::cli {

namespace {

// note: not by "+", of which gcc 12 warns in its own headers.
std::string concat(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text.append(part);
  return text;
}

std::string joinedNames(const CompletionFlag& flag, const char* between) {
  std::string text;
  for (const std::string& name : flag.names) text += concat({text.empty() ? "" : between, name});
  return text;
}

std::string allNames(const std::vector<CompletionFlag>& flags) {
  std::string text;
  for (const CompletionFlag& flag : flags)
    text += concat({text.empty() ? "" : " ", joinedNames(flag, " ")});
  return text;
}

// ---------------------------------------------------------------------------------------- bash

// Sets `kind` and `words` for what stands after the flag, or in the argument's place.
std::string bashCase(const std::string& pattern, const CompletionFlag& flag) {
  switch (flag.value) {
    case Value::kNothing:
      return "";
    case Value::kAnything:
      return concat({"    ", pattern, ") kind=anything ;;\n"});
    case Value::kWords:
      return concat({"    ", pattern, ") kind=words words='", flag.words, "' ;;\n"});
    case Value::kFile:
      return concat({"    ", pattern, ") kind=files ;;\n"});
    case Value::kFolder:
      return concat({"    ", pattern, ") kind=folders ;;\n"});
  }
  return "";
}

constexpr const char* kBashBegin =
    R"(# bash completion for tetstream; made by `tetstream completion bash`.

# _tetstream_value COMMAND FLAG: what follows the flag; nothing where it takes no value.
_tetstream_value() {
  kind= words=
  case "$1 $2" in
)";
constexpr const char* kBashArgument = R"(  esac
}

# _tetstream_argument COMMAND RANK: what the argument of that rank, from 0, is.
_tetstream_argument() {
  kind= words=
  case "$1 $2" in
)";
constexpr const char* kBashFlags = R"(  esac
}

# _tetstream_flags COMMAND
_tetstream_flags() {
  case "$1" in
)";
// note: bash cuts a line at "=" also, so that a flag, "=" and its value are three words.
constexpr const char* kBashEnd = R"(  esac
}

_tetstream() {
  local word=${COMP_WORDS[COMP_CWORD]}
  local command= flag= rank=0 kind= words= i
  for ((i = 1; i < COMP_CWORD; i++)); do
    local at=${COMP_WORDS[i]}
    if [[ $at == = ]]; then
      continue
    elif [[ -n $flag ]]; then
      flag=
    elif [[ $at == -?* ]]; then
      _tetstream_value "$command" "$at"
      [[ -n $kind ]] && flag=$at
    elif [[ -z $command ]]; then
      command=$at
    else
      rank=$((rank + 1))
    fi
  done
  [[ $word == = ]] && word=
  if [[ -n $flag ]]; then
    _tetstream_value "$command" "$flag"
  elif [[ $word == -* ]]; then
    kind=words words=$(_tetstream_flags "$command")
  else
    _tetstream_argument "$command" "$rank"
  fi
  COMPREPLY=()
  case $kind in
    words) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word") ;;
    files) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    folders) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
  esac
  [[ $kind == files || $kind == folders ]] && compopt -o filenames 2>/dev/null
  return 0
}
complete -F _tetstream tetstream
)";

std::string bashScript(const CompletionWords& all) {
  std::string values, arguments = bashCase("' 0'", {{}, "", "", Value::kWords, all.names()});
  std::string flags = concat({"    '') echo '", allNames(all.flags), "' ;;\n"});
  for (const CompletionCommand& command : all.commands) {
    for (const CompletionFlag& flag : command.flags) {
      std::string pattern;
      for (const std::string& name : flag.names)
        pattern += concat({pattern.empty() ? "'" : " | '", command.name, " ", name, "'"});
      values += bashCase(pattern, flag);
    }
    for (size_t i = 0; i < command.arguments.size(); ++i)
      arguments +=
          bashCase(concat({"'", command.name, " ", std::to_string(i), "'"}), command.arguments[i]);
    flags += concat({"    ", command.name, ") echo '", allNames(command.flags), "' ;;\n"});
  }
  return kBashBegin + values + kBashArgument + arguments + kBashFlags + flags + kBashEnd;
}

// ----------------------------------------------------------------------------------------- zsh

// In single quotes, with what _arguments takes as its own signs behind a backslash.
std::string zshText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out;
}

std::string zshAction(const CompletionFlag& flag) {
  switch (flag.value) {
    case Value::kWords:
      return concat({"(", flag.words, ")"});
    case Value::kFile:
      return "_files";
    case Value::kFolder:
      return "_files -/";
    default:
      return " ";
  }
}

// The next words of a call of _arguments.
constexpr const char* kZshNext = " \\\n        '";

std::string zshFlag(const CompletionFlag& flag) {
  std::string text;
  const bool is_repeated = flag.names.front() == "--field";
  for (const std::string& name : flag.names) {
    text += concat({kZshNext, is_repeated ? "*" : "", name});
    if (flag.value != Value::kNothing) text += "=";
    text += concat({"[", zshText(flag.text), "]"});
    if (flag.value != Value::kNothing)
      text += concat({":", zshText(flag.label), ":", zshAction(flag)});
    text += "'";
  }
  return text;
}

std::string zshCommand(const CompletionCommand& command) {
  std::string text = concat({"    ", command.name, ")\n      _arguments"});
  for (const CompletionFlag& flag : command.flags) text += zshFlag(flag);
  for (const CompletionFlag& argument : command.arguments)
    text += concat({kZshNext, ":", zshText(argument.label), ":", zshAction(argument), "'"});
  return text + "\n      ;;\n";
}

constexpr const char* kZshBegin = R"(#compdef tetstream
# zsh completion for tetstream; made by `tetstream completion zsh`.

_tetstream() {
  local context state state_descr line curcontext=$curcontext
  local -a commands
  typeset -A opt_args
  commands=(
)";
constexpr const char* kZshChoose = R"( \
        '1:command:->command' '*::argument:->argument' && return
  [[ $state == command ]] && { _describe -t commands command commands; return }
  curcontext=${curcontext%:*:*}:tetstream-$words[1]:
  case $words[1] in
)";
constexpr const char* kZshEnd = R"(  esac
}

_tetstream "$@"
)";

std::string zshScript(const CompletionWords& all) {
  std::string text = kZshBegin;
  for (const CompletionCommand& command : all.commands)
    text += concat({"    '", command.name, ":", zshText(command.text), "'\n"});
  text += "  )\n  _arguments -C";
  for (const CompletionFlag& flag : all.flags) text += zshFlag(flag);
  text += kZshChoose;
  for (const CompletionCommand& command : all.commands) text += zshCommand(command);
  return text + kZshEnd;
}

// ---------------------------------------------------------------------------------------- fish

std::string fishText(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  out += '\'';
  return out;
}

std::string fishValue(const CompletionFlag& flag) {
  switch (flag.value) {
    case Value::kNothing:
      return "";
    case Value::kAnything:
      return " -x";
    case Value::kWords:
      return concat({" -xa ", fishText(flag.words)});
    case Value::kFile:
      return " -rF";
    case Value::kFolder:
      return " -xa '(__fish_complete_directories)'";
  }
  return "";
}

constexpr const char* kFishCommand = "complete -c tetstream -n ";

std::string fishFlag(const std::string& condition, const CompletionFlag& flag) {
  std::string text = concat({kFishCommand, fishText(condition)});
  for (const std::string& name : flag.names)
    text += concat({name[1] == '-' ? " -l " : " -s ", name.substr(name[1] == '-' ? 2 : 1)});
  text += concat({fishValue(flag), " -d ", fishText(flag.text), "\n"});
  return text;
}

constexpr const char* kFishBegin =
    "# fish completion for tetstream; made by `tetstream completion fish`.\n"
    "complete -c tetstream -f\n";

std::string fishScript(const CompletionWords& all) {
  std::string text = kFishBegin;
  for (const CompletionFlag& flag : all.flags) text += fishFlag("__fish_use_subcommand", flag);
  for (const CompletionCommand& command : all.commands) {
    const std::string seen = concat({"__fish_seen_subcommand_from ", command.name});
    text += concat({kFishCommand, "__fish_use_subcommand -a ", command.name, " -d ",
                    fishText(command.text), "\n"});
    for (const CompletionFlag& flag : command.flags) text += fishFlag(seen, flag);
    for (const CompletionFlag& argument : command.arguments)
      text +=
          concat({kFishCommand, fishText(seen), argument.value == Value::kWords ? " -a " : " -F",
                  argument.value == Value::kWords ? fishText(argument.words) : "", "\n"});
  }
  return text;
}

}  // namespace

std::string completionScript(const CLI::App& app, const std::string& shell) {
  const CompletionWords words = completionWords(app);
  if (shell == "bash") return bashScript(words);
  if (shell == "zsh") return zshScript(words);
  if (shell == "fish") return fishScript(words);
  throw Failure{kUsage,
                concat({"there is no completion for \"", shell, "\", but for bash, zsh, fish"})};
}

}  // namespace tetstream::cli
