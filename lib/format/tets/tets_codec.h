// format/tets: compression of the columns of one `.tets` chunk. Depends on tets_layout.h, zstd.
//
// Before zstd sees them, the numbers of a column are transposed: first the lowest byte of each,
// then the next ones. Vertex ids are first replaced by what they differ from the row above, sign in
// the lowest bit. On real meshes this stores a fifth less than zstd alone, on regular ones two
// thirds, and zstd is twice as fast both ways.
#pragma once

#include <memory>

#include "tets_layout.h"

namespace tetstream::tets {

class Codec {
 public:
  Codec();
  ~Codec();
  static bool builtIn();  // without it, compress never pays and decompress is not to be called

  // Of a section that ends with the columns, which begin at `payload_at`: compressed in their
  // place, with nothing behind; returns their bytes, or 0, and leaves all as it was, where that
  // saves too little.
  size_t compress(const ChunkShape& shape, size_t payload_at, std::vector<unsigned char>& section);
  // False if the bytes are not what compress made of columns of that shape.
  bool decompress(const ChunkShape& shape, const unsigned char* stored, size_t stored_bytes,
                  unsigned char* payload);
  // The same of the first column alone, without a look at the others.
  bool decompressFirst(const ChunkShape& shape, const unsigned char* stored, size_t stored_bytes,
                       unsigned char* column);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tetstream::tets
