// mesh: labelled faces round the ends of an edge, in the window or in a patch of it. Depends on
// window.h.
#pragma once

#include <algorithm>
#include <vector>

#include "vertex_pair.h"
#include "window.h"

namespace tetstream {

template <class Mesh>
class EdgeFaces {
 public:
  EdgeFaces(const Mesh& mesh, LabelledFaces& faces) : mesh_(mesh), faces_(faces) {}

  // Whether one end's edge to `other` is one of a labelled face inside the domain. `ring`: the
  // cells that hold both, as gathered from that end.
  bool holdEdge(const Star& ring, uint32_t other) const {
    for (const StarCell& s : ring)
      for (uint32_t t : s.t)
        if (t != other && has(s.cell, t)) return true;
    return false;
  }
  // The labelled faces round an end, as edges of its link, sorted: all of its cells are there, and
  // one of a face's two knows of it.
  void list(const Star& star, const Star& ring, std::vector<uint64_t>& links) const {
    links.clear();
    const uint8_t* const flags = mesh_.allFlags();
    for (const Star* part : {&star, &ring})
      for (const StarCell& s : *part)
        for (int i = 0; i < 3; ++i) {
          const uint32_t a = s.t[i], b = s.t[(i + 1) % 3];
          if ((flags[a] & flags[b] & kInterface) && has(s.cell, s.t[(i + 2) % 3]))
            links.push_back(pairOf(a, b));
        }
    std::sort(links.begin(), links.end());
  }
  // Before v is merged into u: the faces uab and vab of a dying cell u v a b become one, of the
  // cell across that of them which has no label: where both are on a sheet the edge is not
  // collapsed.
  void handOver(uint32_t u, uint32_t v, const Stars& stars) {
    for (const StarCell& dying : stars.ring) {
      for (const Star* star : {&stars.u, &stars.v}) {
        // Across the face at u lies a cell of u's star; the face at v is opposite u.
        const uint32_t from = mesh_.cornerSlot(cornerOf(dying.cell, star == &stars.u ? u : v));
        if (!faces_.labelOf(from)) continue;
        for (const StarCell& s : *star) {
          uint32_t beyond = kNone, shared = 0;
          for (uint32_t t : s.t) dying.has(t) ? void(++shared) : void(beyond = t);
          if (shared == 2) faces_.hand(from, mesh_.cornerSlot(cornerOf(s.cell, beyond)));
        }
      }
      faces_.forgetCell(mesh_.cellSlotOf(dying.cell));
    }
  }

 private:
  uint32_t cornerOf(uint32_t cell, uint32_t v) const {
    uint32_t j = 0;
    while (mesh_.vertexOf(cell, j) != v) ++j;
    return 4 * cell + j;
  }
  // The face opposite a vertex, known by this cell.
  bool has(uint32_t cell, uint32_t opposite) const {
    return faces_.labelOf(mesh_.cornerSlot(cornerOf(cell, opposite))) != nullptr;
  }

  const Mesh& mesh_;
  LabelledFaces& faces_;
};

}  // namespace tetstream
