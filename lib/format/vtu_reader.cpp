// Reads .vtu files (VTK XML unstructured grids) of linear tetrahedra by range, in memory that does
// not depend on the file's size; triangles among them are labelled faces. Several pieces are read
// as one mesh, end to end.
#include <algorithm>
#include <memory>

#include "registry.h"
#include "status.h"
#include "vtu_cells.h"
#include "vtu_face_label.h"

namespace tetstream {

namespace {

using PieceArrays = std::vector<VtuArray> VtuPiece::*;

const VtuArray* findArray(const std::vector<VtuArray>& arrays, const std::string& name) {
  for (const VtuArray& array : arrays)
    if (array.name == name) return &array;
  return nullptr;
}

ScalarType columnType(VtuType type) {
  switch (type) {
    case VtuType::kFloat32:
      return ScalarType::kFloat32;
    case VtuType::kFloat64:
      return ScalarType::kFloat64;
    case VtuType::kUInt32:
    case VtuType::kInt64:
    case VtuType::kUInt64:
      return ScalarType::kInt64;
    default:
      return ScalarType::kInt32;
  }
}

// The wider of two; both are floats or both integers.
ScalarType wider(ScalarType a, ScalarType b) {
  return sizeOf(a) < sizeOf(b) ? b : a;
}

// A column that every piece with such rows has alike; false and a note otherwise.
bool planData(VtuFile& file, PieceArrays list, VtuRows rows, const VtuArray& model,
              VtuColumnPlan* plan) {
  plan->rows = rows;
  plan->components = model.components;
  plan->type = columnType(model.type);
  for (const VtuPiece& piece : file.pieces) {
    const VtuArray* array = hasRows(piece, rows) ? findArray(piece.*list, model.name) : nullptr;
    plan->arrays.push_back(array);
    if (!hasRows(piece, rows)) continue;
    if (!array || array->components != model.components ||
        isFloat(array->type) != isFloat(model.type)) {
      file.addNote("array \"" + model.name + "\" is left out: not every piece has it alike");
      return false;
    }
    plan->type = wider(plan->type, columnType(array->type));
  }
  return true;
}

// Float32 only if all pieces are; integers are widened to Float64.
ScalarType positionType(const VtuFile& file) {
  ScalarType type = ScalarType::kFloat32;
  for (const VtuPiece& piece : file.pieces)
    if (piece.points && piece.points->type != VtuType::kFloat32) type = ScalarType::kFloat64;
  return type;
}

class VtuReader final : public IndexedSource {
 public:
  VtuReader(std::unique_ptr<ByteSource> bytes, const ReadOptions& options)
      : bytes_(std::move(bytes)), file_(parseVtuHeader(*bytes_)) {
    planPoints();
    cells_ = std::make_unique<VtuCells>(*bytes_, file_);
    planColumns(&VtuPiece::point_data, VtuRows::kPoints, schema_.fields, fields_);
    planColumns(&VtuPiece::cell_data, VtuRows::kCells, schema_.cell_data, cell_data_);
    schema_.vertex_count = static_cast<int64_t>(file_.point_count);
    schema_.cell_count = static_cast<int64_t>(cells_->count(VtuKind::kTetrahedron));
    schema_.face_count = 0;
    if (cells_->count(VtuKind::kTriangle) > 0) labelFaces();
    checkSchema(schema_);
    checkPieces();
    if (options.note)
      for (const std::string& note : file_.notes) options.note(bytes_->name() + ": " + note);
  }

  const Schema& schema() const override { return schema_; }
  void readPositions(uint64_t first, size_t count, void* out) override {
    points_->read(first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    fields_[column].read(first, count, out);
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    cells_->readPoints(VtuKind::kTetrahedron, first, count, out);
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    const size_t bytes = schema_.cell_data[column].bytesPerRow();
    auto* to = static_cast<unsigned char*>(out);
    cells_->visitRuns(VtuKind::kTetrahedron, first, count, [&](uint64_t cell, size_t cells) {
      cell_data_[column].read(cell, cells, to);
      to += cells * bytes;
    });
  }
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override {
    cells_->readPoints(VtuKind::kTriangle, first, count, corners);
    cells_->visitRuns(VtuKind::kTriangle, first, count, [&](uint64_t cell, size_t cells) {
      face_labels_->read(cell, cells, labels);
      labels += cells;
    });
  }

 private:
  void planPoints() {
    schema_.position_type = positionType(file_);
    VtuColumnPlan plan =
        planNeeded(file_, *bytes_, &VtuPiece::points, VtuRows::kPoints, "points", 3);
    plan.type = schema_.position_type;
    points_ = std::make_unique<VtuColumn>(*bytes_, file_, std::move(plan));
  }

  // The arrays of the first piece that has such rows, in its order; of the first one if none has.
  void planColumns(PieceArrays list, VtuRows rows, std::vector<Column>& schema,
                   std::vector<VtuColumn>& columns) {
    size_t first = 0;
    while (first + 1 < file_.pieces.size() && !hasRows(file_.pieces[first], rows)) ++first;
    if (!hasRows(file_.pieces[first], rows)) first = 0;
    for (const VtuArray& model : file_.pieces[first].*list) {
      VtuColumnPlan plan;
      if (!planData(file_, list, rows, model, &plan)) continue;
      schema.push_back({model.name, plan.components, plan.type});
      columns.emplace_back(*bytes_, file_, std::move(plan));
    }
    for (const VtuPiece& piece : file_.pieces)
      for (const VtuArray& array : piece.*list)
        if (hasRows(piece, rows) && !findArray(file_.pieces[first].*list, array.name))
          file_.addNote("array \"" + array.name + "\" is left out: not every piece has it alike");
  }

  // That every array has the size that the counts need, so that nobody allocates for a lie.
  void checkPieces() {
    for (size_t i = 0; i < file_.pieces.size(); ++i) {
      points_->check(i);
      for (VtuColumn& column : fields_) column.check(i);
      for (VtuColumn& column : cell_data_) column.check(i);
    }
  }

  // By one cell array, which is nothing else if only faces have it.
  void labelFaces() {
    const long long faces = static_cast<long long>(cells_->count(VtuKind::kTriangle));
    const int by = faceLabelColumn(schema_.cell_data);
    if (by < 0) {
      file_.addNote(
          textOf("%lld triangles are left out: there is no cell array of integers, one to "
                 "a cell, that could label them as faces",
                 faces));
      return;
    }
    const std::string name = schema_.cell_data[static_cast<size_t>(by)].name;
    const VtuColumnPlan& plan = cell_data_[static_cast<size_t>(by)].plan();
    face_labels_ = std::make_unique<VtuColumn>(*bytes_, file_, plan);
    face_labels_->giveAs(ScalarType::kInt64);
    file_.addNote(
        textOf("%lld triangles are labelled faces, by the cell array \"%s\"", faces, name.c_str()));
    schema_.face_count = faces;
    if (name == kFaceLabelName) dropCellData(by);
  }

  void dropCellData(int column) {
    schema_.cell_data.erase(schema_.cell_data.begin() + column);
    std::vector<VtuColumn> kept;
    for (int i = 0; i < static_cast<int>(cell_data_.size()); ++i)
      if (i != column) kept.push_back(std::move(cell_data_[static_cast<size_t>(i)]));
    cell_data_.swap(kept);
  }

  std::unique_ptr<ByteSource> bytes_;
  VtuFile file_;
  Schema schema_;
  std::unique_ptr<VtuColumn> points_, face_labels_;
  std::unique_ptr<VtuCells> cells_;
  std::vector<VtuColumn> fields_, cell_data_;
};

}  // namespace

Input openVtu(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  Input input;
  input.indexed =
      std::make_unique<VtuReader>(makeSeekable(std::move(bytes), options.temp_dir), options);
  return input;
}

}  // namespace tetstream
