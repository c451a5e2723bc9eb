// simplify/collapse: the planes across an axis that faces of a sheet lie in. Depends on nothing.
#pragma once

#include <algorithm>

namespace tetstream {

// Planes x = c, y = c or z = c: symmetry planes, the sides of a box, the ends of a pipe, flat
// layers. Who looks for what lies on them compares coordinates, which are the same but for what
// rounding made of them.
template <class S>
class AxisPlanes {
 public:
  // Coordinates that are no farther apart are the same.
  explicit AxisPlanes(S rounding) : rounding_(rounding) {}

  // A face by its corners' coordinates.
  void add(const S* a, const S* b, const S* c) {
    bool lies_in_one = false;
    for (int i = 0; i < 3; ++i) {
      const auto [least, most] = std::minmax({a[i], b[i], c[i]});
      if (!(most - least <= rounding_)) continue;
      if (faces_[i]++ == 0) at_[i] = a[i];
      parts_[i] |= !(std::max(most - at_[i], at_[i] - least) <= rounding_);
      lies_in_one = true;
    }
    others_ += !lies_in_one;
  }

  // Whether faces lie across an axis, all of them at the same place;
  bool has(int axis) const { return faces_[axis] > 0 && !parts_[axis]; }
  // and no faces elsewhere.
  bool hasAll(int axis) const {
    const int beside = faces_[(axis + 1) % 3] + faces_[(axis + 2) % 3];
    return has(axis) && beside == 0 && others_ == 0;
  }
  // A corner's coordinate there.
  S at(int axis) const { return at_[axis]; }

 private:
  S rounding_;
  S at_[3] = {0, 0, 0};  // of the first face across it
  bool parts_[3] = {false, false, false};
  int faces_[3] = {0, 0, 0}, others_ = 0;
};

}  // namespace tetstream
