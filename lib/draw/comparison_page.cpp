#include "comparison_page.h"

namespace tetstream {

void drawComparison(const std::string& path, const Comparison&, const std::string&) {
  drawPicture(path, 10, 10, [](Canvas&) {});
}

}  // namespace tetstream
