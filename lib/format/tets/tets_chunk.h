// format/tets: the chunk that the `.tets` writer is filling. Depends on tets_codec.h, batch.h.
#pragma once

#include "batch.h"
#include "tets_codec.h"

namespace tetstream::tets {

// Rows go in one kind at a time, as they come; encode gives the section and empties the chunk.
class ChunkBuilder {
 public:
  explicit ChunkBuilder(const Schema& schema);

  // Where the next chunk's rows stand in the stream.
  void start(uint64_t first_vertex, uint64_t first_cell);
  void addVertices(const BatchView& batch, size_t first, size_t count);
  void addCells(const BatchView& batch, size_t first, size_t count);
  void addFinalized(int64_t vertex);  // after the chunk's cells so far
  void addFace(const int64_t corners[3], int64_t label);

  uint32_t vertexCount() const { return counts_.vertices; }
  uint32_t cellCount() const { return counts_.cells; }
  uint32_t finalizedCount() const { return counts_.finalized; }
  uint32_t faceCount() const { return counts_.faces; }
  bool empty() const {
    return counts_.vertices + counts_.cells + counts_.finalized + counts_.faces == 0;
  }

  // The section, sealed, valid until the next call; *entry gets all but its offset.
  const std::vector<unsigned char>& encode(uint64_t rank, bool compress, IndexEntry* entry);
  const Box& box() const { return box_; }  // of the chunk encoded last, or being filled

 private:
  using Bytes = std::vector<unsigned char>;
  void growBox(size_t box_column, const void* rows, ScalarType type, size_t components,
               size_t count);
  bool idsFitNarrow() const;
  void writeColumns(uint32_t flags, unsigned char* payload);

  const Schema& schema_;
  ChunkShape shape_;
  Codec codec_;
  ChunkOwn counts_ = {};
  uint64_t first_cell_ = 0;
  bool any_locked_ = false, any_last_use_ = false;
  std::vector<Bytes> columns_;  // as in the shape, but cells always as int64
  std::vector<int64_t> cells_;
  Box box_;
  Bytes section_;
};

}  // namespace tetstream::tets
