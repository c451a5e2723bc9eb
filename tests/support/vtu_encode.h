// tests/support: makes .vtu files in every encoding, by other means than the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tetstream::test {

enum class VtuCoding { kAscii, kInline, kAppendedBase64, kAppendedRaw };

struct VtuStyle {
  VtuCoding coding = VtuCoding::kAscii;
  bool zlib = false;
  bool big_endian = false;
  int header_bits = 32;
  size_t block_bytes = 32768;
  bool header_apart = false;   // base64 without zlib: the length word is a text of its own
  const char* codec = "zlib";  // what is meant by `zlib`: also "lz4", "lzma", where built in
};

// Values stand in `reals` if the type is a float, else in `integers` (UInt64: their bit pattern).
struct VtuTestArray {
  std::string type, name;
  int components = 1;
  std::vector<double> reals;
  std::vector<int64_t> integers;
  std::string attributes = "";  // more of them, as they stand in the tag
};

struct VtuTestPiece {
  uint64_t points = 0, cells = 0;  // as the header claims
  std::vector<VtuTestArray> point_data, cell_data, points_element, cells_element;
};

std::string encodeBase64(const std::string& bytes);
std::string makeVtu(const std::vector<VtuTestPiece>& pieces, const VtuStyle& style);

// Five points and two tetrahedra, one field "p" (Float32), one cell array "region" (Int32).
VtuTestPiece twoCellPiece(const std::string& point_type = "Float64",
                          const std::string& id_type = "Int64");

}  // namespace tetstream::test
