// format/vtk: what the XML header of a .vtu file says: pieces, arrays and where their values lie.
// Depends on mesh_pieces.h, text_pieces.h.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bytes.h"
#include "mesh_pieces.h"
#include "text_pieces.h"

namespace tetstream {

struct VtuCompressor;

enum class VtuFormat { kAscii, kInlineBase64, kAppendedRaw, kAppendedBase64 };

struct VtuArray {
  std::string name;
  ValueType type = ValueType::kFloat32;
  int components = 1;
  VtuFormat format = VtuFormat::kAscii;
  // Bytes of the file: of inline values exactly their text; of appended ones from their length word
  // or block table to, at the latest, the end of the file.
  uint64_t begin = 0, end = 0;
  bool is_doubtful = false;  // while the header is read: perhaps of another step
};

// Cells use the points of their own piece, counted from 0.
struct VtuPiece {
  uint64_t point_count = 0, cell_count = 0;
  std::vector<VtuArray> point_data, cell_data;
  std::optional<VtuArray> points, connectivity, offsets, types;
};

struct VtuFile {
  bool big_endian = false;
  const VtuCompressor* compressor = nullptr;
  size_t word_bytes = 4;  // of lengths and block tables
  std::vector<VtuPiece> pieces;
  std::optional<VtuArray> time;  // one number
  std::string global_ids;        // the points' array of that meaning, if the header names one
  Helpers helpers;
  std::vector<std::string> notes;  // what was left out, each once
  void addNote(const std::string& text) { MeshPieces::addNoteTo(notes, text); }
};

// Of time steps at these times, at least one, which is to be read, from 0.
using ChooseVtuStep = std::function<uint64_t(const std::vector<double>& times)>;

// Reads the header, in pieces, of a seekable source. Inline values are passed over; counts, and
// that the values are all there, are not checked against anything yet. Of files with time steps,
// pieces and arrays are those of the one that was chosen.
VtuFile parseVtuHeader(ByteSource& bytes, const ChooseVtuStep& choose);

}  // namespace tetstream
