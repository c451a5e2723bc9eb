// cli: how help pages are laid out. Depends on text.h, CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace tetstream::cli {

// Options and arguments in one column, their texts in another, broken between words for the width
// of the terminal.
std::shared_ptr<CLI::FormatterBase> helpFormat();

}  // namespace tetstream::cli
