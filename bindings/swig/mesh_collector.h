// swig: a whole stream collected into arrays, and a vertex map by vertex: what comes back from the
// library without calling the language. Depends on stream_batch.h.
#pragma once

#include <memory>
#include <optional>

#include "stream_batch.h"

namespace tetstream::swig {

// Takes what a writer is given. The arrays can be taken once, when the stream is complete: before,
// and where it never was, getters throw a TETSTREAM_BAD_STATE.
class MeshCollector {
 public:
  // `cell_type`: of the cells' ids, int32 or int64.
  explicit MeshCollector(int32_t cell_type);

  const StreamInfo& info() const;
  OwnedArray& positions() { return whole(positions_); }
  OwnedArray& field(int32_t index);
  OwnedArray& cells() { return whole(cells_); }
  OwnedArray& cellData(int32_t index);
  OwnedArray& locked() { return whole(locked_); }  // empty if no vertex is
  OwnedArray& faces() { return whole(faces_); }
  OwnedArray& faceLabels() { return whole(face_labels_); }
  OwnedArray& lockedFaces() { return whole(locked_faces_); }  // empty if none is
  OwnedArray& lockedEdges() { return whole(locked_edges_); }

  // Its user is this.
  tetstream_writer_callbacks callbacks();

 private:
  void open(const tetstream_stream_info& info);
  void put(const tetstream_batch& batch);
  void putCells(const tetstream_batch& batch);
  // The same, if the stream is complete.
  template <class T>
  T& whole(T& collected) const {
    needWhole();
    return collected;
  }
  void needWhole() const;

  int32_t cell_type_;
  bool is_whole_ = false;
  std::unique_ptr<StreamInfo> info_;
  OwnedArray positions_, cells_, locked_, faces_, face_labels_, locked_faces_, locked_edges_;
  std::vector<OwnedArray> fields_, cell_data_;
};

// Takes a map, whose rows come in the order of the output's cells, and has them by vertex.
class MapCollector {
 public:
  explicit MapCollector(int64_t vertices);

  OwnedArray& cells() { return cells_; }      // [vertices] int64; -1: the vertex was in no cell
  OwnedArray& weights() { return weights_; }  // [vertices][4] float64

  tetstream_map_callbacks callbacks();

 private:
  void put(const tetstream_map_rows& rows);

  OwnedArray cells_, weights_;
};

}  // namespace tetstream::swig
