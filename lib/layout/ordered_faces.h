// layout: the labelled faces of a mesh in the order in which a stream can take them. Depends on
// ranked_vertices.h.
#pragma once

#include "ranked_vertices.h"

namespace tetstream {

// A face of the stream that is to come.
struct OrderedFace {
  int64_t vertices[3];  // as the stream numbers them
  int64_t label;
  int64_t number;  // in the source, from the one that it starts with
  int64_t last() const { return std::max({vertices[0], vertices[1], vertices[2]}); }
};

// Faces are sorted by the vertex that the stream introduces last: with that one they can come, and
// they do not come too late, as their cell has still to come or is just there, and needs all three.
// Memory is bounded; the vertices' new numbers are joined to the faces by sorting both.
class OrderedFaces {
 public:
  OrderedFaces(IndexedSource& source, const RankedVertices::Budget& budget);

  bool empty() const { return count_ == 0; }
  // All vertices of the stream, in any order.
  void number(uint64_t point, int64_t vertex);
  // Reads the faces, twice. Points that are none or are in no cell are kBadData.
  void finish(const Tell& tell);

  // Then:
  uint64_t count() const { return rows_.rows(); }
  OrderedFace face(uint64_t place);
  uint64_t mostDiskBytes() const { return disk_; }  // while they were sorted, and now

 private:
  ExternalSort& sorted(std::unique_ptr<ExternalSort>& sort, size_t payload_bytes);
  void sortCorners();
  void joinNumbers();
  void sortFaces(const Tell& tell);

  IndexedSource& source_;
  RankedVertices::Budget budget_;
  uint64_t count_;
  std::unique_ptr<ExternalSort> points_;  // by point: its vertex
  std::unique_ptr<ExternalSort>
      corners_;  // by point: three times the face's number, and the corner
  std::unique_ptr<ExternalSort> numbers_;  // by such a number: the vertex
  RowSpool rows_;
  uint64_t disk_ = 0;
};

}  // namespace tetstream
