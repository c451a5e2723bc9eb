// mesh/topology: the edges of a vertex's link that one cell has: the faces of the boundary round
// the vertex. Depends on base.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "memory.h"

namespace tetstream {

// The link's vertices are numbered as they are met. Bits tell of each to which others an edge
// leads, and from which.
class LinkEdges {
 public:
  static constexpr uint32_t kMostVertices = 128;
  static constexpr uint32_t kNoNumber = std::numeric_limits<uint32_t>::max();

  explicit LinkEdges(Account& account) : marks_(account) {}

  // Forgets all vertices and edges.
  void start() {
    if (first_ > kNoNumber - 2 * kMostVertices) {
      std::fill_n(marks_.data(), marks_.size(), 0u);
      first_ = 0;
    }
    first_ += kMostVertices;
    count_ = 0;
    is_whole_ = true;
  }
  // From 0 on; kNoNumber for a vertex too many.
  uint32_t numberOf(uint32_t vertex) {
    if (vertex >= marks_.size()) grow(vertex);
    uint32_t& mark = marks_[vertex];
    if (mark < first_) {
      is_whole_ &= count_ < kMostVertices;
      if (count_ == kMostVertices) return kNoNumber;
      mark = first_ + count_;
      vertices_[count_] = vertex;
      rows_[count_++] = {};
    }
    return mark - first_;
  }
  // Whether all vertices got numbers.
  bool isWhole() const { return is_whole_; }
  // Of a triangle, in its direction, by the numbers of its ends.
  void add(uint32_t from, uint32_t to) {
    rows_[from].forth[to / 64] |= uint64_t{1} << to % 64;
    rows_[to].back[from / 64] |= uint64_t{1} << from % 64;
  }

  // visit(from, to), vertices, for each edge without one that goes back.
  template <class Visit>
  void forSingle(Visit visit) const {
    for (uint32_t from = 0; from < count_; ++from)
      for (uint32_t word = 0; word < kWords; ++word) {
        uint64_t left = rows_[from].forth[word] & ~rows_[from].back[word];
        for (; left != 0; left &= left - 1)
          visit(vertices_[from],
                vertices_[64 * word + static_cast<uint32_t>(std::countr_zero(left))]);
      }
  }

 private:
  static constexpr uint32_t kWords = kMostVertices / 64;
  struct Row {
    uint64_t forth[kWords], back[kWords];
  };

  void grow(uint32_t vertex) {
    const size_t before = marks_.size();
    marks_.resize(size_t{vertex} + vertex / 4 + 1024);
    std::fill(marks_.data() + before, marks_.data() + marks_.size(), 0u);
  }

  Array<uint32_t> marks_;  // of each vertex: first_ and its number; less for one that has none
  uint32_t first_ = 0, count_ = 0;
  bool is_whole_ = true;
  uint32_t vertices_[kMostVertices];
  Row rows_[kMostVertices];
};

}  // namespace tetstream
