// stream: the events of a mesh stream, some thousands at a time. Depends on schema.h.
//
// A batch stands for the events: its vertices, then its cells in order, each cell followed by the
// finalizations that it carries (last_uses), then the explicit finalizations. Where exactly in the
// batch a vertex is introduced has no meaning: consumers introduce it with the first cell that
// uses it or a later one. So the same mesh stream cut into other batches is the same stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema.h"

namespace tetstream {

// Borrowed arrays; whoever hands out a view says how long they live.
struct BatchView {
  uint64_t first_vertex = 0;  // rank in the stream of the batch's first vertex
  size_t vertex_count = 0;
  const void* positions = nullptr;      // [vertex_count][3] of position_type
  const void* const* fields = nullptr;  // per column: [vertex_count][components]
  const uint8_t* locked = nullptr;      // [vertex_count], non-zero: never moved; or null
  const int64_t* origins = nullptr;     // [vertex_count]: ranks in the input before it was put
                                        // into another order; or null: as they are here
  size_t cell_count = 0;
  const int64_t* cells = nullptr;          // [cell_count][4] vertex ranks
  const uint8_t* last_uses = nullptr;      // [cell_count], bit j: corner j is its vertex's
                                           // last use; or null: none
  const void* const* cell_data = nullptr;  // per column: [cell_count][components]
  size_t finalized_count = 0;
  const int64_t* finalized = nullptr;  // ranks, final after the batch's last cell
  size_t face_count = 0;
  const int64_t* faces = nullptr;         // [face_count][3] labelled boundary faces of cells
                                          // so far; their vertices may be final already
  const int64_t* face_labels = nullptr;   // [face_count]
  const int64_t* face_origins = nullptr;  // [face_count]: their numbers in the input, for
                                          // messages; or null: as they come, from 0
  const uint8_t* face_locks = nullptr;    // [face_count], non-zero: its vertices are never moved
  size_t edge_count = 0;
  const int64_t* locked_edges = nullptr;  // [edge_count][2], of cells so far: never moved

  bool isEmpty() const {
    return vertex_count == 0 && cell_count == 0 && finalized_count == 0 && face_count == 0 &&
           edge_count == 0;
  }
};

// An owned batch, filled row by row or column by column. Capacity is kept from fill to fill, so
// that a reader's main loop does not allocate.
class Batch {
 public:
  explicit Batch(const Schema& schema);

  void clear(uint64_t first_vertex);
  // Makes room for `count` more rows and returns the index of the first one; the caller writes
  // them through the pointers below, which the next add may move.
  size_t addVertices(size_t count);
  size_t addCells(size_t count);  // last_uses of the new cells are 0
  void addFinalized(int64_t vertex) { finalized_.push_back(vertex); }
  void addFace(const int64_t corners[3], int64_t label);
  void addFaceOrigin(int64_t number) { face_origins_.push_back(number); }  // for all or for none
  void lock(size_t vertex_row);
  // For all vertices of the batch or for none.
  void addOrigin(int64_t origin) { origins_.push_back(origin); }

  void* position(size_t row) { return positions_.data() + row * position_stride_; }
  void* field(size_t column, size_t row) {
    return fields_[column].data() + row * field_strides_[column];
  }
  int64_t* cell(size_t row) { return cells_.data() + 4 * row; }
  uint8_t& lastUses(size_t row) { return last_uses_[row]; }
  void* cellData(size_t column, size_t row) {
    return cell_data_[column].data() + row * cell_strides_[column];
  }

  uint64_t firstVertex() const { return first_vertex_; }
  size_t vertexCount() const { return vertex_count_; }
  size_t cellCount() const { return cell_count_; }
  size_t finalizedCount() const { return finalized_.size(); }
  bool empty() const {
    return vertex_count_ + cell_count_ + finalized_.size() + face_labels_.size() == 0;
  }

  BatchView view();  // valid until the batch changes

 private:
  using Bytes = std::vector<unsigned char>;
  uint64_t first_vertex_ = 0;
  size_t vertex_count_ = 0, cell_count_ = 0, position_stride_;
  bool any_locked_ = false;
  std::vector<size_t> field_strides_, cell_strides_;
  Bytes positions_, locked_, last_uses_;
  std::vector<Bytes> fields_, cell_data_;
  std::vector<int64_t> origins_, cells_, finalized_, faces_, face_labels_, face_origins_;
  std::vector<const void*> field_pointers_, cell_pointers_;
};

}  // namespace tetstream
