// layout: an indexed mesh as a stream, in an order of choice. Depends on ordered_cells.h,
// ordered_faces.h, orders.h.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ordered_cells.h"
#include "ordered_faces.h"
#include "orders.h"

namespace tetstream {

struct OrderOptions {
  std::string order = "auto";  // the sweep; if `narrowest`, the spectral order where it is narrower
  bool narrowest = false;      // and the mesh fits the memory
  std::string axis = "auto";   // of "spatial": "x", "y", "z"; auto: the direction of fewest cuts
  std::string temp_dir;
  size_t memory_bytes = 0;     // 0: kDefaultLayoutMemory
  bool origins = false;        // vertices tell their ranks in the source, or its origins
  std::vector<bool> measured;  // fields whose values have to be finite; empty: none
  Tell tell;                   // how much of the ordering is done; may be empty
};

constexpr size_t kDefaultLayoutMemory = size_t{512} << 20;

// Bytes of temporary files at once, about and at most, that ordering such a mesh from a file takes.
uint64_t plannedDisk(const Schema& schema, const OrderOptions& options);

class SweptMesh;

// Orders the mesh when it is made, in bounded memory: points are sorted by their keys and get their
// ranks, cells by their highest, both outside of memory where they do not fit; then, from the last
// cell to the first, the last use of each vertex is found. In passes over the cells: two readings
// of the source, the merge, last uses, the front; and one for each reading of the stream.
//
// Its schema is complete: counts of what is used, box, front. Vertices come just before the first
// cell that uses them, in that order; points that no cell uses are left out. Labelled faces come in
// the batch of the last of their vertices; locked edges and faces as locked vertices.
class OrderedSource : public Source {
 public:
  OrderedSource(IndexedSource& source, const OrderOptions& options);
  ~OrderedSource() override;
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;
  std::unique_ptr<Source> again(Part part) override;

  int64_t unusedVertices() const { return unused_; }
  const std::string& chosen() const { return chosen_; }  // "spatial, along z"
  uint64_t diskBytes() const { return disk_; }
  size_t peakBytes() const { return account_.peak(); }  // of memory, while it was ordered

 private:
  class Reading;
  class Places;

  VertexKey placeKey(Order order, const Survey& survey, const std::string& axis);
  VertexKey narrowestKey(const VertexKey& sweep, const Tell& tell);
  VertexKey rankKey();
  VertexKey graphKey(Order order, const OrderOptions& options, size_t memory_bytes,
                     const Tell& tell);
  bool hasRoomForFront(size_t memory_bytes) const;
  void measureFront(const Tell& tell);
  FrontStatistics meterFront(const Tell& tell);
  FrontStatistics takeFront(const Tell& tell);
  void numberFaces(const Tell& tell);

  IndexedSource* source_;
  Schema schema_;
  Account account_;
  std::unique_ptr<SweptMesh> swept_;  // in place of a source too large for its graph
  Array<uint32_t> graph_rank_;        // of points, while vertices are sorted by it
  std::unique_ptr<RankedVertices> vertices_;
  std::optional<CellFront> front_;  // where there is room for it; knows the vertices' numbers
  std::unique_ptr<OrderedCells> cells_;
  std::unique_ptr<OrderedFaces> faces_;
  std::unique_ptr<Reading> reading_;
  bool tells_origins_;
  std::string chosen_;
  int64_t unused_ = 0;
  uint64_t disk_ = 0;
};

}  // namespace tetstream
