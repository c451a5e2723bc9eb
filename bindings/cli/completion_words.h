// cli: what can stand where on the command line, as the shells' scripts tell it. Depends on
// option_table.h.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tetstream::cli {

// What a flag takes, or what an argument is.
enum class Value { kNothing, kAnything, kWords, kFile, kFolder };

struct CompletionFlag {
  std::vector<std::string> names;  // "--format", "-h"
  std::string text;                // one line
  std::string label;               // of the value: "N", "NAME"
  Value value = Value::kNothing;
  std::string words;  // of kWords: blank-separated
};

struct CompletionCommand {
  std::string name, text;
  std::vector<CompletionFlag> flags;
  std::vector<CompletionFlag> arguments;  // in their order; no names
};

struct CompletionWords {
  std::vector<CompletionFlag> flags;  // without a command
  std::vector<CompletionCommand> commands;
  std::string names() const;  // of the commands, blank-separated
};

CompletionWords completionWords(const CLI::App& app);

}  // namespace tetstream::cli
