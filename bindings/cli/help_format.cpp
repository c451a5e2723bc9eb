#include "help_format.h"

#include <unistd.h>

#include <algorithm>
#include <string>

#include "text.h"

namespace tetstream::cli {

static constexpr size_t kTextColumn = 26, kLeastText = 30;

// In lines of so many characters, where words allow it.
static std::string wrapped(const std::string& text, size_t width) {
  std::string lines;
  for (size_t begin = 0; begin < text.size();) {
    size_t end = text.size();
    if (end - begin > width) {
      end = text.rfind(' ', begin + width);
      if (end == std::string::npos || end <= begin) end = text.find(' ', begin + 1);
      end = std::min(end, text.size());
    }
    lines.append(lines.empty() ? "" : "\n").append(text, begin, end - begin);
    begin = end + 1;
  }
  return lines;
}

namespace {

class HelpFormat final : public CLI::Formatter {
 public:
  HelpFormat() {
    column_width(kTextColumn);
    label("Positionals", "Arguments");
    label("Usage", "usage");
    label("OPTIONS", "options");
    label("SUBCOMMAND", "command");
    label("REQUIRED", "");
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    const size_t width = terminalWidth(STDOUT_FILENO);
    return wrapped(option->get_description(),
                   std::max(width, kTextColumn + kLeastText) - kTextColumn);
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormat() {
  return std::make_shared<HelpFormat>();
}

}  // namespace tetstream::cli
