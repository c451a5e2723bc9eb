// measure/scan: everything about one mesh that one reading of it tells, and its boundary and its
// cells, all or those of a part, for what comes after. Depends on stream, mesh, face_front.h,
// cell_shapes.h, region_parts.h, face_labels.h, part_box.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell_shapes.h"
#include "face_front.h"
#include "face_labels.h"
#include "front.h"
#include "part_box.h"
#include "region_parts.h"
#include "source.h"

namespace tetstream {

// A share of something that is done; may throw to stop.
using Done = std::function<void(double)>;

struct ScanPlan {
  std::string mesh;                 // "the original", for messages
  std::vector<size_t> fields;       // columns whose values are kept, all components
  bool are_finite = true;           // a value that is not is kBadData
  std::vector<size_t> cell_arrays;  // integer columns that may label regions
  bool drops_ids = false;           // those that number the cells
  Box part = partBoxOf("");         // cells are kept whose centres lie in it
};

class MeshScan {
 public:
  struct Budgets {
    RowBudget cells, boundary;
  };
  // `account` bounds what the front takes.
  MeshScan(const Schema& schema, const ScanPlan& plan, const Budgets& budgets, Account& account);
  // Before it is read: all cells are kept that meet the box.
  void keepWhatMeets(const Box& box) { met_ = box; }
  // Reads everything. Throws kBadData, naming the vertex or the cell: what is not known, final,
  // there twice or not finite.
  void read(Source& source, const Done& done);

  const TopologyFigures& topology() { return faces_.figures(); }
  ShapeFigures shapes() const { return shapes_.figures(); }
  RegionParts& regions(size_t array) { return *regions_[array]; }
  // Of a column that is kept: whether all values were.
  bool isFinite(size_t field) const { return is_finite_[field]; }
  // Of each component that is kept, over the vertices that cells use.
  const std::vector<double>& lowest() const { return low_; }
  const std::vector<double>& highest() const { return high_; }
  const Box& box() const { return box_; }  // of all cells
  SimplexRows& cells() { return cells_; }  // that are kept
  double volumeKept() const { return volume_kept_; }
  SimplexRows& boundary() { return boundary_; }  // all of it
  double boundaryArea() const { return boundary_area_; }
  // Of the faces whose centres lie in the part.
  double boundaryAreaInPart() const { return area_in_part_; }
  const FaceLabels& faceLabels() const { return face_labels_; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  FaceFront::Events events();
  std::string rowText(uint64_t vertex) const;
  void takeVertices(const BatchView& batch);
  void takeCells(const BatchView& batch);
  void takeFaces(const BatchView& batch);
  void addCell(const int64_t corners[4], size_t row);
  void keepCell();
  void use(uint32_t vertex);
  uint32_t numberOf(int64_t vertex) const;
  void finalize(int64_t vertex);
  void addBoundary(const uint32_t vertices[3]);
  uint32_t takeNumber(Array<uint32_t>& free, uint32_t& first_free, uint32_t& used);
  const double* dataOf(uint32_t vertex) const { return data_.data() + vertex * stride_; }

  const Schema& schema_;
  ScanPlan plan_;
  size_t values_, stride_;  // doubles of a vertex's values; of its place and values
  Front front_;
  FaceFront faces_;
  CellShapes shapes_;
  std::vector<std::unique_ptr<RegionParts>> regions_;
  Array<double> data_;           // per vertex
  Array<uint32_t> vertex_link_;  // kInUse, or the next free number
  Array<uint32_t> cell_link_;
  uint32_t vertex_free_ = kNone, vertices_used_ = 0, cell_free_ = kNone, cells_used_ = 0;
  uint64_t cells_seen_ = 0;
  SimplexRows cells_, boundary_;
  std::optional<Box> met_;
  Box box_;
  double volume_kept_ = 0, boundary_area_ = 0, area_in_part_ = 0;
  FaceLabels face_labels_;
  std::vector<bool> is_finite_;  // of the columns that are kept
  std::vector<double> low_, high_, row_, positions_;
  std::vector<std::vector<double>> columns_;  // of one batch
  std::vector<std::vector<int64_t>> labels_;  // of one batch
};

}  // namespace tetstream
