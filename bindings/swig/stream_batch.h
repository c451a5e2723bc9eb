// swig: a batch of events, filled by a language or shown to it. Depends on stream_info.h.
#pragma once

#include <vector>

#include "stream_info.h"

namespace tetstream::swig {

// Arrays are borrowed: the language keeps them for as long as tetstream.h says. Getters give them
// for the duration of the callback that shows the batch.
class StreamBatch {
 public:
  StreamBatch() = default;
  StreamBatch(const tetstream_batch& batch, const StreamInfo& info);

  void clear();
  void setPositions(const ArrayView& positions) { positions_ = positions; }  // [n][3]
  void addField(const ArrayView& field) { fields_.push_back(field); }        // [n][components]
  void setLocked(const ArrayView& locked) { locked_ = locked; }              // [n] bytes
  void setCells(const ArrayView& cells) { cells_ = cells; }                  // [m][4]
  void setLastUses(const ArrayView& last_uses) { last_uses_ = last_uses; }   // [m] bytes
  void addCellData(const ArrayView& data) { cell_data_.push_back(data); }    // [m][components]
  void setFinalized(const ArrayView& finalized) { finalized_ = finalized; }  // [k]
  void setFaces(const ArrayView& faces) { faces_ = faces; }                  // [f][3]
  void setFaceLabels(const ArrayView& labels) { face_labels_ = labels; }     // [f]
  void setLockedFaces(const ArrayView& locked) { locked_faces_ = locked; }   // [f] bytes
  void setLockedEdges(const ArrayView& edges) { locked_edges_ = edges; }     // [e][2]

  ArrayView positions() const { return positions_; }
  ArrayView field(int32_t index) const;
  ArrayView locked() const { return locked_; }
  ArrayView cells() const { return cells_; }
  ArrayView lastUses() const { return last_uses_; }
  ArrayView cellData(int32_t index) const;
  ArrayView finalized() const { return finalized_; }
  ArrayView faces() const { return faces_; }
  ArrayView faceLabels() const { return face_labels_; }
  ArrayView lockedFaces() const { return locked_faces_; }
  ArrayView lockedEdges() const { return locked_edges_; }

  // The struct, which points to this and to the arrays. Throws Failure unless their types and
  // shapes are those of `info` and agree with one another. Cells may be int32 where `cell_type`
  // says so, else they are int64 as all ids are.
  tetstream_batch batch(const StreamInfo& info, int32_t cell_type = TETSTREAM_TYPE_INT64);
  int32_t cellType() const { return cells_.data ? cells_.type : TETSTREAM_TYPE_INT64; }

 private:
  ArrayView positions_, locked_, cells_, last_uses_, finalized_, faces_, face_labels_,
      locked_faces_, locked_edges_;
  std::vector<ArrayView> fields_, cell_data_;
  std::vector<const void*> field_pointers_, cell_data_pointers_;
};

}  // namespace tetstream::swig
