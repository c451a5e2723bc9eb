// gather/pieces: an indexed mesh as VTK's files and their relatives lay it out: pieces with points,
// cells of any type and named arrays over them, each of which can be read by range. Depends on
// values.h, side_faces.h.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "schema.h"
#include "side_faces.h"
#include "values.h"

namespace tetstream {

struct MeshArray {
  std::string name;
  ValueType type = ValueType::kFloat32;
  int components = 1;
  // Opens the values, which must be exactly `count`, at least one: throws otherwise, before
  // anything of that size is allocated.
  std::function<std::unique_ptr<Values>(uint64_t count)> open;
};

enum class CellForm {
  kOffsets,      // offsets tell where the points of each cell end in the connectivity
  kInterleaved,  // the connectivity has before the points of each cell their number; no offsets
  kTetrahedra,   // four points each and nothing else; no offsets, no types
};

// Cells use the points of their own piece, counted from 0.
struct MeshPiece {
  uint64_t point_count = 0, cell_count = 0;
  uint64_t first_point = 0, first_cell = 0;  // sums over the pieces before
  std::vector<MeshArray> point_data, cell_data;
  std::optional<MeshArray> points, connectivity, offsets, types;
  uint64_t connectivity_size = 0;  // of kInterleaved: its values
};

struct MeshPieces {
  std::string name;  // of the file, for messages
  CellForm form = CellForm::kOffsets;
  bool join = false;       // points that pieces share are to be one each
  std::string global_ids;  // the points' array that tells which those are, if the file names one
  std::vector<MeshPiece> pieces;
  std::vector<LabelName> label_names;        // in any order, of one label maybe several
  std::shared_ptr<SideFaces> faces;          // that are no cells, of the first piece; may be null
  uint64_t point_count = 0, cell_count = 0;  // of all pieces
  bool has_steps = false;                    // of time, of which one was chosen
  std::optional<double> time;                // of the values
  std::vector<std::string> notes;            // what was left out, each once

  void add(MeshPiece piece);  // after the others
  void addNote(const std::string& text) { addNoteTo(notes, text); }
  static void addNoteTo(std::vector<std::string>& notes, const std::string& text);
};

// Bounds of what one file may have, which keep sums and products far from overflow and the time
// that comparing names takes short.
constexpr uint64_t kMaxMeshCount = uint64_t{1} << 56;  // times 9 components of 8 bytes: < 2^63
constexpr size_t kMaxMeshPieces = 1 << 16;

}  // namespace tetstream
