// cli: scripts that complete the command line in a shell, made from the very flags that are parsed.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tetstream::cli {

// For "bash", "zsh" or "fish". Throws Failure for another shell.
std::string completionScript(const CLI::App& app, const std::string& shell);

}  // namespace tetstream::cli
