// Reads .vtu files (VTK XML unstructured grids) of linear tetrahedra by range, in memory that does
// not depend on the file's size. Several pieces are read as one mesh, end to end.
#include <algorithm>
#include <memory>

#include "registry.h"
#include "status.h"
#include "vtu_column.h"
#include "vtu_file.h"

namespace tetstream {

namespace {

constexpr size_t kCheckedAtOnce = 2048;  // cells

using PieceArrays = std::vector<VtuArray> VtuPiece::*;
using PieceArray = std::optional<VtuArray> VtuPiece::*;

bool hasRows(const VtuPiece& piece, VtuRows rows) {
  return (rows == VtuRows::kPoints ? piece.point_count : piece.cell_count) > 0;
}

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

// An array that every piece with such rows must have.
VtuColumnPlan planNeeded(const VtuFile& file, const ByteSource& bytes, PieceArray which,
                         VtuRows rows, const char* name, int components) {
  VtuColumnPlan plan;
  plan.rows = rows;
  plan.components = components;
  plan.type = ScalarType::kInt64;
  for (size_t i = 0; i < file.pieces.size(); ++i) {
    const VtuPiece& piece = file.pieces[i];
    const std::optional<VtuArray>& array = piece.*which;
    plan.arrays.push_back(array ? &*array : nullptr);
    if (!hasRows(piece, rows)) continue;
    if (!array) fail(Status::kBadData, "%s: piece %zu has no %s", bytes.name().c_str(), i, name);
    if (rows == VtuRows::kCells && isFloat(array->type))
      fail(Status::kBadData, "%s: the %s of piece %zu are no integers", bytes.name().c_str(), name,
           i);
  }
  return plan;
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
    planCells();
    planColumns(&VtuPiece::point_data, VtuRows::kPoints, schema_.fields, fields_);
    planColumns(&VtuPiece::cell_data, VtuRows::kCells, schema_.cell_data, cell_data_);
    schema_.vertex_count = static_cast<int64_t>(file_.point_count);
    schema_.cell_count = static_cast<int64_t>(file_.cell_count);
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
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    cell_data_[column].read(first, count, out);
  }

  void readCells(uint64_t first, size_t count, int64_t* out) override {
    checkKinds(first, count);
    connectivity_->read(first, count, out);
    size_t piece = 0;
    for (size_t i = 0; i < count;) {
      piece = pieceOfCell(first + i, piece);
      const VtuPiece& p = file_.pieces[piece];
      const size_t n = static_cast<size_t>(
          std::min<uint64_t>(count - i, p.first_cell + p.cell_count - first - i));
      checkIds(p, first + i, n, out + 4 * i);
      i += n;
    }
  }

 private:
  void planPoints() {
    schema_.position_type = positionType(file_);
    VtuColumnPlan plan =
        planNeeded(file_, *bytes_, &VtuPiece::points, VtuRows::kPoints, "points", 3);
    plan.type = schema_.position_type;
    points_ = std::make_unique<VtuColumn>(*bytes_, file_, std::move(plan));
  }

  std::unique_ptr<VtuColumn> cellColumn(PieceArray which, const char* name, int components) {
    return std::make_unique<VtuColumn>(
        *bytes_, file_, planNeeded(file_, *bytes_, which, VtuRows::kCells, name, components));
  }

  void planCells() {
    connectivity_ = cellColumn(&VtuPiece::connectivity, "connectivity", 4);
    offsets_ = cellColumn(&VtuPiece::offsets, "offsets", 1);
    types_ = cellColumn(&VtuPiece::types, "types", 1);
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
      types_->check(i);
      offsets_->check(i);
      checkConnectivity(i);
      for (VtuColumn& column : fields_) column.check(i);
      for (VtuColumn& column : cell_data_) column.check(i);
    }
  }

  // A wrong size usually means other cells, and saying so helps more.
  void checkConnectivity(size_t piece) {
    try {
      connectivity_->check(piece);
    } catch (const Error& error) {
      if (error.status() != Status::kBadData) throw;
      const VtuPiece& p = file_.pieces[piece];
      for (uint64_t at = 0; at < p.cell_count; at += kCheckedAtOnce)
        checkTypes(p.first_cell + at,
                   static_cast<size_t>(std::min<uint64_t>(kCheckedAtOnce, p.cell_count - at)));
      throw;
    }
  }

  // Types and offsets of cells [first, first + count). Those before checked_ are known to be good.
  void checkKinds(uint64_t first, size_t count) {
    const uint64_t end = first + count;
    const bool sequential = first <= checked_;
    uint64_t at = sequential ? std::max(first, checked_) : first;
    while (at < end) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(kCheckedAtOnce, end - at));
      checkTypes(at, n);
      checkOffsets(at, n);
      at += n;
    }
    if (sequential) checked_ = std::max(checked_, end);
  }

  void checkTypes(uint64_t first, size_t count) {
    int64_t types[kCheckedAtOnce];
    types_->read(first, count, types);
    for (size_t i = 0; i < count; ++i)
      if (types[i] != kTetra)
        fail(Status::kUnsupported,
             "%s: cell %llu has VTK's type %lld; only linear tetrahedra (type 10) are read",
             bytes_->name().c_str(), static_cast<unsigned long long>(first + i),
             static_cast<long long>(types[i]));
  }

  void checkOffsets(uint64_t first, size_t count) {
    int64_t offsets[kCheckedAtOnce];
    offsets_->read(first, count, offsets);
    size_t piece = 0;
    for (size_t i = 0; i < count; ++i) {
      piece = pieceOfCell(first + i, piece);
      const uint64_t expected = 4 * (first + i - file_.pieces[piece].first_cell + 1);
      if (static_cast<uint64_t>(offsets[i]) != expected)
        fail(Status::kBadData, "%s: the offset of cell %llu is %lld, of tetrahedra it is %llu",
             bytes_->name().c_str(), static_cast<unsigned long long>(first + i),
             static_cast<long long>(offsets[i]), static_cast<unsigned long long>(expected));
    }
  }

  // At or after `from`.
  size_t pieceOfCell(uint64_t cell, size_t from) const {
    while (cell - file_.pieces[from].first_cell >= file_.pieces[from].cell_count) ++from;
    return from;
  }

  void checkIds(const VtuPiece& piece, uint64_t first, size_t count, int64_t* ids) const {
    for (size_t i = 0; i < 4 * count; ++i) {
      if (static_cast<uint64_t>(ids[i]) >= piece.point_count)
        fail(Status::kBadData, "%s: cell %llu uses point %lld, there are %llu",
             bytes_->name().c_str(), static_cast<unsigned long long>(first + i / 4),
             static_cast<long long>(ids[i]), static_cast<unsigned long long>(piece.point_count));
      ids[i] += static_cast<int64_t>(piece.first_point);
    }
  }

  std::unique_ptr<ByteSource> bytes_;
  VtuFile file_;
  Schema schema_;
  std::unique_ptr<VtuColumn> points_, connectivity_, offsets_, types_;
  std::vector<VtuColumn> fields_, cell_data_;
  uint64_t checked_ = 0;
};

}  // namespace

Input openVtu(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  Input input;
  input.indexed =
      std::make_unique<VtuReader>(makeSeekable(std::move(bytes), options.temp_dir), options);
  return input;
}

}  // namespace tetstream
