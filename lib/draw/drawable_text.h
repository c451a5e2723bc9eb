// draw: text that can be drawn. Depends on nothing.
#pragma once

#include <string>

namespace tetstream {

// UTF-8 without control characters: a question mark for each byte that is none.
std::string drawableText(const std::string& text);

}  // namespace tetstream
