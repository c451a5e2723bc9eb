#include "cells_to_points.h"

#include "point_means.h"
#include "rows_at_once.h"
#include "wrapped_mesh.h"

namespace tetstream {

namespace {

class CellsToPoints final : public WrappedMesh {
 public:
  CellsToPoints(std::unique_ptr<IndexedSource> mesh, const std::string& temp_dir)
      : WrappedMesh(*mesh), mesh_(std::move(mesh)), temp_dir_(temp_dir), schema_(mesh_->schema()) {
    own_fields_ = schema_.fields.size();
    for (size_t i = 0; i < schema_.cell_data.size(); ++i) {
      const Column& column = schema_.cell_data[i];
      if (!isFloat(column.type) || findColumn(schema_.fields, column.name) >= 0) continue;
      schema_.fields.push_back(column);
      arrays_.push_back(i);
    }
    schema_.box_min.clear();  // those of the new fields are not known
    schema_.box_max.clear();
    means_.resize(arrays_.size());
  }

  const Schema& schema() const override { return schema_; }
  bool randomAccess() const override { return mesh_->randomAccess() && arrays_.empty(); }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    if (column < own_fields_) return mesh_->readField(column, first, count, out);
    meansOf(column - own_fields_).read(first, count, out);
  }

 private:
  // They are made when they are asked for.
  PointMeans& meansOf(size_t field) {
    std::unique_ptr<PointMeans>& means = means_[field];
    if (means) return *means;
    means = std::make_unique<PointMeans>(
        schema_.fields[own_fields_ + field], static_cast<uint64_t>(schema_.vertex_count), temp_dir_,
        [&](size_t component, auto add) { forCorners(arrays_[field], component, add); });
    return *means;
  }

  // add(point, the cell's value) for each corner of each cell.
  template <class Add>
  void forCorners(size_t array, size_t component, Add add) {
    const Column& column = schema_.cell_data[array];
    const auto width = static_cast<size_t>(column.components);
    std::vector<unsigned char> rows(kRowsAtOnce * column.bytesPerRow());
    std::vector<int64_t> corners(4 * kRowsAtOnce);
    const auto cells = static_cast<uint64_t>(schema_.cell_count);
    for (uint64_t at = 0; at < cells; at += kRowsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, cells - at));
      mesh_->readCells(at, n, corners.data());
      mesh_->readCellData(array, at, n, rows.data());
      for (size_t i = 0; i < n; ++i) {
        double value;
        convertScalars(rows.data() + (i * width + component) * sizeOf(column.type), column.type,
                       &value, ScalarType::kFloat64, 1);
        for (size_t j = 0; j < 4; ++j) add(static_cast<uint64_t>(corners[4 * i + j]), value);
      }
    }
  }

  std::unique_ptr<IndexedSource> mesh_;
  std::string temp_dir_;
  Schema schema_;
  size_t own_fields_;
  std::vector<size_t> arrays_;                      // that have become fields
  std::vector<std::unique_ptr<PointMeans>> means_;  // of those
};

}  // namespace

std::unique_ptr<IndexedSource> cellsToPoints(std::unique_ptr<IndexedSource> mesh,
                                             const std::string& temp_dir) {
  return std::make_unique<CellsToPoints>(std::move(mesh), temp_dir);
}

}  // namespace tetstream
