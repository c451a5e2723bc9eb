// mesh/topology: the labelled faces of the window. Depends on label_map.h, winding.h.
//
// A face comes as three vertices, and is then known by a corner: that of a cell, opposite the face.
// A corner keeps its number while its cell lives, whatever is merged.
#pragma once

#include "label_map.h"
#include "topology.h"
#include "winding.h"

namespace tetstream {

class LabelledFaces {
 public:
  explicit LabelledFaces(Account& account) : coming_(account), of_corner_(account) {}

  bool empty() const { return coming_.empty() && of_corner_.empty(); }

  // Three vertices, whose cell is not looked for yet, and the number by which messages name the
  // face. That of the one that has come before and has no cell yet, which stays; null if none has.
  const int64_t* expect(uint32_t a, uint32_t b, uint32_t c, int64_t label, int64_t number) {
    const Face face = Face::of(a, b, c);
    if (const Coming* before = coming_.find(face)) return &before->number;
    coming_.put(face, {label, number, isDown(a, b, c)});
    return nullptr;
  }
  // The label of the face with these vertices, which is wound outwards from the cell of the corner
  // that it is opposite of, and opposite `across`, if there is a cell across it; otherwise that is
  // `corner` again. It may have come since it was last asked for, and is then known by the corner
  // of which it is wound outwards, if there is one. Null if there is none.
  const int64_t* labelOf(uint32_t corner, uint32_t across, uint32_t a, uint32_t b, uint32_t c) {
    const Face face = Face::of(a, b, c);
    if (const Coming* coming = coming_.find(face)) {
      if (labelOf(corner) || labelOf(across))
        again_.add(coming->number);
      else
        of_corner_.put({coming->is_down == isDown(a, b, c) ? corner : across}, coming->label);
      coming_.remove(face);
    }
    const int64_t* label = labelOf(corner);
    return label ? label : labelOf(across);
  }
  const int64_t* labelOf(uint32_t corner) const { return of_corner_.find({corner}); }
  bool anyPlaced() const { return !of_corner_.empty(); }
  // What the face opposite `from` is labelled with, the one opposite `to` is from now on.
  void hand(uint32_t from, uint32_t to) {
    const int64_t* label = of_corner_.find({from});
    if (!label) return;
    const int64_t value = *label;
    of_corner_.remove({from});
    of_corner_.put({to}, value);
  }
  void addOfNoCell(int64_t number) { gone_.add(number); }
  void forgetCell(uint32_t cell) {
    for (uint32_t j = 0; j < 4; ++j) of_corner_.remove({4 * cell + j});
  }

  struct Strange {
    size_t count = 0;
    int64_t first = 0;  // of their numbers the smallest
    void add(int64_t number) { first = count++ == 0 ? number : std::min(first, number); }
  };
  // Those that were faces of no cell, and those that came again when they had one; once all
  // vertices were looked at, all of them.
  Strange ofNoCell() const {
    Strange all = gone_;
    coming_.forEachLabel([&](const Coming& c) { all.add(c.number); });
    return all;
  }
  Strange again() const { return again_; }

  // The window is packed: keep[v] is the new slot of vertex v; cells move to lower ones, in order.
  // What still waits for its cell and loses a vertex has none.
  void remapVertices(const uint32_t* keep) {
    coming_.remap([&](const Face& f, Coming& coming, Face* kept) {
      const uint32_t v[] = {keep[f.v[0]], keep[f.v[1]], keep[f.v[2]]};
      *kept = Face::of(v[0], v[1], v[2]);
      coming.is_down ^= isWoundDown(v);
      if (kept->v[2] == kNone) gone_.add(coming.number);
      return kept->v[2] != kNone;
    });
  }
  void moveCell(uint32_t from, uint32_t to) {
    for (uint32_t j = 0; j < 4 && !of_corner_.empty(); ++j) hand(4 * from + j, 4 * to + j);
  }

 private:
  struct Face {
    uint32_t v[3];  // rising
    static Face of(uint32_t a, uint32_t b, uint32_t c) {
      Face f{{a, b, c}};
      std::sort(f.v, f.v + 3);
      return f;
    }
    bool operator==(const Face& o) const = default;
    uint64_t hash() const { return mix(mix(uint64_t{v[0]} << 32 | v[1]) + v[2]); }
  };
  struct Corner {
    uint32_t number;  // a window has fewer than 2^30 cells
    bool operator==(const Corner& o) const = default;
    uint64_t hash() const { return mix(number); }
  };

  struct Coming {
    int64_t label, number;
    bool is_down;  // its vertices, as they came
  };
  static bool isDown(uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t v[] = {a, b, c};
    return isWoundDown(v);
  }

  LabelMap<Face, Coming> coming_;
  LabelMap<Corner> of_corner_;
  Strange gone_, again_;
};

}  // namespace tetstream
