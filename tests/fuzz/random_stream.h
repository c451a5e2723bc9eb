// A stream that a fuzz target's input chooses event by event.
#pragma once

#include <string>
#include <vector>

#include "choices.h"
#include "tetstream/tetstream.h"

namespace fuzz {

// Cells use vertices of a small moving front, each vertex is finalized once at most, and then no
// longer used; but now and then the input chooses to break such a rule.
class RandomStream {
 public:
  explicit RandomStream(Choices& choices);

  // The pointers live as long as the stream.
  const tetstream_stream_info& info() const { return info_; }
  // The next batch, empty at the end; its arrays live until the next call.
  void next(tetstream_batch* batch);
  int64_t cellsGiven() const { return cells_given_; }

 private:
  void addColumns(std::vector<tetstream_column>& columns, const char* const* names);
  void addVertices();
  void addCells();
  void addCell();
  void addFinalized();
  void addFaces();
  void addRow(std::vector<unsigned char>& out, const tetstream_column& column);
  int64_t someVertex();
  bool breaksRule() { return wild_ && choices_.below(32) == 0; }

  Choices& choices_;
  bool wild_;
  tetstream_stream_info info_ = {};
  std::vector<tetstream_column> fields_, cell_data_;

  int64_t vertices_ = 0, cells_given_ = 0;
  size_t batches_ = 0;
  std::vector<int64_t> front_;  // not finalized

  // The batch in hand.
  std::vector<unsigned char> positions_;
  std::vector<std::vector<unsigned char>> field_rows_, cell_rows_;
  std::vector<const void*> field_pointers_, cell_pointers_;
  std::vector<uint8_t> locked_, last_uses_, locked_faces_;
  std::vector<int64_t> cells_, finalized_, faces_, face_labels_, edges_;
};

}  // namespace fuzz
