#include "box_tree.h"

#include <algorithm>
#include <numeric>

namespace tetstream {

BoxTree::BoxTree(Account& account, const Box* boxes, size_t count)
    : nodes_(account, count + 1), items_(account, count) {
  std::iota(items_.data(), items_.data() + count, 0u);
  if (count > 0) build(boxes, 0, count);
}

void BoxTree::build(const Box* boxes, size_t begin, size_t end) {
  const size_t at = used_++;
  Box box, centres;
  for (size_t i = begin; i < end; ++i) {
    const Box& b = boxes[items_[i]];
    const double centre[3] = {b.low[0] / 2 + b.high[0] / 2, b.low[1] / 2 + b.high[1] / 2,
                              b.low[2] / 2 + b.high[2] / 2};
    box.add(b);
    centres.add(centre);
  }
  nodes_[at] = {box, 0, static_cast<uint32_t>(begin), 0};
  if (end - begin <= kLeaf) {
    nodes_[at].count = static_cast<uint32_t>(end - begin);
  } else {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis]) axis = k;
    const size_t middle = begin + (end - begin) / 2;
    const auto centre = [&](uint32_t i) {
      return boxes[i].low[axis] / 2 + boxes[i].high[axis] / 2;
    };
    std::nth_element(items_.data() + begin, items_.data() + middle, items_.data() + end,
                     [&](uint32_t a, uint32_t b) { return centre(a) < centre(b); });
    build(boxes, begin, middle);
    build(boxes, middle, end);
  }
  nodes_[at].next = static_cast<uint32_t>(used_);
}

}  // namespace tetstream
