// format: what the XML header of a .vtu file says: pieces, arrays and where their values lie.
// Depends on base.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bytes.h"

namespace tetstream {

enum class VtuType {
  kInt8,
  kUInt8,
  kInt16,
  kUInt16,
  kInt32,
  kUInt32,
  kInt64,
  kUInt64,
  kFloat32,
  kFloat64
};

inline size_t sizeOf(VtuType t) {
  constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<int>(t)];
}
inline bool isFloat(VtuType t) {
  return t >= VtuType::kFloat32;
}

constexpr unsigned char kTetra = 10;  // VTK's number of the linear tetrahedron

enum class VtuFormat { kAscii, kInlineBase64, kAppendedRaw, kAppendedBase64 };

struct VtuArray {
  std::string name;
  VtuType type = VtuType::kFloat32;
  int components = 1;
  VtuFormat format = VtuFormat::kAscii;
  // Bytes of the file: of inline values exactly their text; of appended ones from their length word
  // or block table to, at the latest, the end of the file.
  uint64_t begin = 0, end = 0;
};

// Cells use the points of their own piece, counted from 0.
struct VtuPiece {
  uint64_t point_count = 0, cell_count = 0;
  uint64_t first_point = 0, first_cell = 0;  // sums over the pieces before
  std::vector<VtuArray> point_data, cell_data;
  std::optional<VtuArray> points, connectivity, offsets, types;
};

struct VtuFile {
  bool big_endian = false;
  bool zlib = false;
  size_t word_bytes = 4;  // of lengths and block tables
  std::vector<VtuPiece> pieces;
  uint64_t point_count = 0, cell_count = 0;  // of all pieces
  std::vector<std::string> notes;            // what was left out, each once
  void addNote(const std::string& text);
};

// Reads the header, in pieces, of a seekable source. Inline values are passed over; counts, and
// that the values are all there, are not checked against anything yet.
VtuFile parseVtuHeader(ByteSource& bytes);

}  // namespace tetstream
