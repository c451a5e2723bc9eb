// A mesh whose points were joined: rows of those that are left, and means.
#include <algorithm>
#include <optional>

#include "joined_points.h"
#include "memory.h"
#include "point_means.h"
#include "point_set.h"
#include "side_faces.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kRowsOfMesh = 2048;  // at once

class JoinedPoints final : public IndexedSource {
 public:
  JoinedPoints(std::unique_ptr<IndexedSource> mesh, std::shared_ptr<PointJoin> points)
      : mesh_(std::move(mesh)),
        points_(std::move(points)),
        schema_(mesh_->schema()),
        means_(schema_.fields.size()) {
    schema_.vertex_count = static_cast<int64_t>(points_->count());
    if (mesh_->locked()) lock();
    if (points_->plan().everywhere && schema_.face_count > 0) joinFaces();
  }

  const Schema& schema() const override { return schema_; }
  uint64_t firstNumber() const override { return mesh_->firstNumber(); }
  const uint8_t* locked() const override { return locked_.size() > 0 ? locked_.data() : nullptr; }
  // A point is named as the file has it, the pieces' one after the other.
  bool hasOrigins() const override { return true; }
  void readOrigins(uint64_t first, size_t count, int64_t* out) override {
    for (size_t i = 0; i < count; ++i) out[i] = static_cast<int64_t>(points_->oldOf(first + i));
  }
  void readPositions(uint64_t first, size_t count, void* out) override {
    forRuns(first, count, 3 * sizeOf(schema_.position_type), out,
            [&](uint64_t point, size_t n, void* to) { mesh_->readPositions(point, n, to); });
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    if (points_->plan().everywhere && isFloat(schema_.fields[column].type))
      return meansOf(column).read(first, count, out);
    forRuns(first, count, schema_.fields[column].bytesPerRow(), out,
            [&](uint64_t point, size_t n, void* to) { mesh_->readField(column, point, n, to); });
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    mesh_->readCells(first, count, out);
    for (size_t i = 0; i < 4 * count; ++i) out[i] = points_->newOf(static_cast<uint64_t>(out[i]));
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    mesh_->readCellData(column, first, count, out);
  }
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override {
    if (faces_)
      faces_->read(first, count, corners, labels);
    else
      readAllFaces(first, count, corners, labels);
  }

 private:
  template <class Read>
  void forRuns(uint64_t first, size_t count, size_t row_bytes, void* out, Read read) {
    for (size_t at = 0; at < count;) {
      const uint64_t point = points_->oldOf(first + at);
      size_t n = 1;
      while (at + n < count && points_->oldOf(first + at + n) == point + n) ++n;
      read(point, n, static_cast<unsigned char*>(out) + at * row_bytes);
      at += n;
    }
  }

  void readAllFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) {
    mesh_->readFaces(first, count, corners, labels);
    for (size_t i = 0; i < 3 * count; ++i)
      corners[i] = points_->newOf(static_cast<uint64_t>(corners[i]));
  }

  // Both cells beside a face may have labelled it.
  void joinFaces() {
    std::vector<int64_t> corners(3 * kRowsOfMesh), labels(kRowsOfMesh);
    faces_ = std::make_unique<SideFaces>(points_->plan().temp_dir);
    const auto count = static_cast<uint64_t>(schema_.face_count);
    for (uint64_t at = 0; at < count; at += kRowsOfMesh) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsOfMesh, count - at));
      readAllFaces(at, n, corners.data(), labels.data());
      for (size_t i = 0; i < n; ++i) faces_->add(&corners[3 * i], labels[i]);
    }
    const uint64_t again = faces_->finish();
    schema_.face_count = static_cast<int64_t>(faces_->count());
    if (again > 0 && points_->plan().note)
      points_->plan().note(
          textOf("%llu labelled faces have become one with others, since points were joined: the "
                 "first one labels them",
                 static_cast<unsigned long long>(again)));
  }

  void lock() {
    locked_.resize(static_cast<size_t>(points_->count()));
    std::fill_n(locked_.data(), locked_.size(), uint8_t{0});
    for (uint64_t old = 0; old < static_cast<uint64_t>(mesh_->schema().vertex_count); ++old)
      if (mesh_->locked()[old]) locked_[static_cast<size_t>(points_->newOf(old))] = 1;
  }

  PointMeans& meansOf(size_t column) {
    std::unique_ptr<PointMeans>& means = means_[column];
    if (!means)
      means = std::make_unique<PointMeans>(
          schema_.fields[column], points_->count(), points_->plan().temp_dir,
          [&](size_t component, auto add) { forValues(column, component, add); });
    return *means;
  }

  // Those of cells that are left out, ghosts for example, do not count.
  void findUsed() {
    std::vector<int64_t> corners(4 * kRowsOfMesh);
    used_.emplace(account_, static_cast<uint64_t>(mesh_->schema().vertex_count));
    const auto cells = static_cast<uint64_t>(schema_.cell_count);
    for (uint64_t at = 0; at < cells; at += kRowsOfMesh) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsOfMesh, cells - at));
      mesh_->readCells(at, n, corners.data());
      for (size_t i = 0; i < 4 * n; ++i) used_->add(static_cast<uint64_t>(corners[i]));
    }
  }

  // add(point as it is now, value) for each point of cells that there was.
  template <class Add>
  void forValues(size_t column, size_t component, Add add) {
    const Column& field = schema_.fields[column];
    const auto width = static_cast<size_t>(field.components);
    const auto old_points = static_cast<uint64_t>(mesh_->schema().vertex_count);
    if (!used_) findUsed();
    std::vector<unsigned char> rows(kRowsOfMesh * field.bytesPerRow());
    for (uint64_t at = 0; at < old_points; at += kRowsOfMesh) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsOfMesh, old_points - at));
      mesh_->readField(column, at, n, rows.data());
      for (size_t i = 0; i < n; ++i) {
        if (!used_->has(at + i)) continue;
        double value;
        convertScalars(rows.data() + (i * width + component) * sizeOf(field.type), field.type,
                       &value, ScalarType::kFloat64, 1);
        add(static_cast<uint64_t>(points_->newOf(at + i)), value);
      }
    }
  }

  std::unique_ptr<IndexedSource> mesh_;
  std::shared_ptr<PointJoin> points_;
  Schema schema_;
  Account account_;
  Array<uint8_t> locked_{account_};  // per point, if any is
  std::optional<PointSet> used_;  // by cells, of the points that there were, once it is asked for
  std::unique_ptr<SideFaces> faces_;                // that are left, if several have become one
  std::vector<std::unique_ptr<PointMeans>> means_;  // of fields that were read
};

}  // namespace

std::unique_ptr<IndexedSource> joinPoints(std::unique_ptr<IndexedSource> mesh,
                                          std::shared_ptr<PointJoin> points) {
  return std::make_unique<JoinedPoints>(std::move(mesh), std::move(points));
}

}  // namespace tetstream
