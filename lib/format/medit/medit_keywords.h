// format/medit: the keywords of MEDIT's files that are read or written: their names in text, their
// numbers in binary. Depends on cell_kinds.h.
#pragma once

#include <cstdint>
#include <string_view>

#include "cell_kinds.h"

namespace tetstream {

struct MeditKeyword {
  const char* name;
  int number;
  // Of cells and faces: rows of so many points and a reference. Null: it is none.
  const CellKind* kind;
};

constexpr int kMeditDimension = 3, kMeditVertices = 4, kMeditEdges = 5, kMeditTriangles = 6,
              kMeditTetrahedra = 8, kMeditRequiredVertices = 15, kMeditRequiredEdges = 16,
              kMeditRequiredTriangles = 17, kMeditEnd = 54, kMeditSolAtVertices = 62,
              kMeditSolAtTetrahedra = 66;

// Null: none that is known.
const MeditKeyword* meditKeyword(std::string_view name);
const MeditKeyword* meditKeyword(int64_t number);

}  // namespace tetstream
