#include "pieced_mesh.h"

#include <algorithm>

#include "cell_points.h"
#include "face_label_column.h"
#include "interleaved_cells.h"
#include "joined_points.h"
#include "label_names.h"
#include "mixed_cells.h"
#include "piece_column.h"
#include "repeated_cells.h"
#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kCheckedAtOnce = 2048;  // cells

using PieceArrays = std::vector<MeshArray> MeshPiece::*;
using PieceArray = std::optional<MeshArray> MeshPiece::*;

bool hasRows(const MeshPiece& piece, PieceRows rows) {
  return (rows == PieceRows::kPoints ? piece.point_count : piece.cell_count) > 0;
}

const MeshArray* findArray(const std::vector<MeshArray>& arrays, const std::string& name) {
  for (const MeshArray& array : arrays)
    if (array.name == name) return &array;
  return nullptr;
}

// The wider of two; both are floats or both integers.
ScalarType wider(ScalarType a, ScalarType b) {
  return sizeOf(a) < sizeOf(b) ? b : a;
}

void noteUnlike(MeshPieces& mesh, const std::string& name) {
  mesh.addNote("array \"" + name + "\" is left out: not every piece has it alike");
}

// A column that every piece with such rows has alike; false and a note otherwise.
bool planData(MeshPieces& mesh, PieceArrays list, PieceRows rows, const MeshArray& model,
              PieceColumnPlan* plan) {
  plan->rows = rows;
  plan->components = model.components;
  plan->type = scalarOf(model.type);
  for (const MeshPiece& piece : mesh.pieces) {
    const MeshArray* array = hasRows(piece, rows) ? findArray(piece.*list, model.name) : nullptr;
    plan->arrays.push_back(array);
    if (!hasRows(piece, rows)) continue;
    if (!array || array->components != model.components ||
        isFloat(array->type) != isFloat(model.type)) {
      noteUnlike(mesh, model.name);
      return false;
    }
    plan->type = wider(plan->type, scalarOf(array->type));
  }
  return true;
}

// An array that every piece with such rows must have.
PieceColumnPlan planNeeded(const MeshPieces& mesh, PieceArray which, PieceRows rows,
                           const char* name, int components) {
  PieceColumnPlan plan;
  plan.rows = rows;
  plan.components = components;
  plan.type = ScalarType::kInt64;
  for (size_t i = 0; i < mesh.pieces.size(); ++i) {
    const MeshPiece& piece = mesh.pieces[i];
    const std::optional<MeshArray>& array = piece.*which;
    plan.arrays.push_back(array ? &*array : nullptr);
    if (!hasRows(piece, rows)) continue;
    if (!array) fail(Status::kBadData, "%s: piece %zu has no %s", mesh.name.c_str(), i, name);
    if (rows == PieceRows::kCells && isFloat(array->type))
      fail(Status::kBadData, "%s: the %s of piece %zu are no integers", mesh.name.c_str(), name, i);
  }
  return plan;
}

// Float32 only if all pieces are; integers are widened to Float64.
ScalarType positionType(const MeshPieces& mesh) {
  ScalarType type = ScalarType::kFloat32;
  for (const MeshPiece& piece : mesh.pieces)
    if (piece.points && piece.points->type != ValueType::kFloat32) type = ScalarType::kFloat64;
  return type;
}

class PiecedMesh final : public IndexedSource {
 public:
  // Takes the points and the fields.
  PiecedMesh(MeshPieces mesh, const ReadOptions& options)
      : mesh_(std::move(mesh)), options_(options) {
    schema_.position_type = positionType(mesh_);
    PieceColumnPlan plan = planNeeded(mesh_, &MeshPiece::points, PieceRows::kPoints, "points", 3);
    plan.type = schema_.position_type;
    points_ = std::make_unique<PieceColumn>(mesh_, std::move(plan));
    planColumns(&MeshPiece::point_data, PieceRows::kPoints, schema_.fields, fields_);
    schema_.vertex_count = static_cast<int64_t>(mesh_.point_count);
    for (size_t i = 0; i < mesh_.pieces.size(); ++i) {
      points_->check(i);
      for (PieceColumn& column : fields_) column.check(i);
    }
  }

  // After the points: they tell how cells are split. To be called once; `joined` may be null.
  void takeCells(PointJoin* joined) {
    planCells(joined);
    planColumns(&MeshPiece::cell_data, PieceRows::kCells, schema_.cell_data, cell_data_);
    schema_.cell_count =
        static_cast<int64_t>(mixed_ ? mixed_->count(MixedCells::kTetrahedra) : mesh_.cell_count);
    schema_.face_count = 0;
    checkCells();
    if (mixed_ && mixed_->count(MixedCells::kTriangles) > 0) labelFaces();
    mixed_faces_ = static_cast<uint64_t>(schema_.face_count);
    if (mesh_.faces) schema_.face_count += static_cast<int64_t>(mesh_.faces->count());
    schema_.label_names = std::move(mesh_.label_names);
    settleLabelNames(schema_.label_names);
    schema_.time = mesh_.time;
    checkSchema(schema_);
    if (options_.note)
      for (const std::string& note : mesh_.notes) options_.note(mesh_.name + ": " + note);
  }

  const MeshPieces& pieces() const { return mesh_; }
  const Schema& schema() const override { return schema_; }
  void readPositions(uint64_t first, size_t count, void* out) override {
    points_->read(first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    fields_[column].read(first, count, out);
  }

  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    if (!mixed_) return cell_data_[column].read(first, count, out);
    mixed_->readRows(
        MixedCells::kTetrahedra, first, count, schema_.cell_data[column].bytesPerRow(), out,
        [&](uint64_t cell, size_t n, void* to) { cell_data_[column].read(cell, n, to); });
  }

  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override {
    const auto mixed = static_cast<size_t>(
        std::min<uint64_t>(count, first < mixed_faces_ ? mixed_faces_ - first : 0));
    if (mixed > 0) readMixedFaces(first, mixed, corners, labels);
    if (mixed < count)
      mesh_.faces->read(first + mixed - mixed_faces_, count - mixed, corners + 3 * mixed,
                        labels + mixed);
  }

  void readCells(uint64_t first, size_t count, int64_t* out) override {
    if (mixed_) return mixed_->readPoints(MixedCells::kTetrahedra, first, count, out);
    checkOffsets(first, count);
    connectivity_->read(first, count, out);
    size_t piece = 0;
    for (size_t i = 0; i < count;) {
      piece = pieceOfCell(first + i, piece);
      const MeshPiece& p = mesh_.pieces[piece];
      const size_t n = static_cast<size_t>(
          std::min<uint64_t>(count - i, p.first_cell + p.cell_count - first - i));
      checkIds(p, first + i, n, out + 4 * i);
      i += n;
    }
  }

 private:
  void readMixedFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) {
    mixed_->readPoints(MixedCells::kTriangles, first, count, corners);
    mixed_->readRows(MixedCells::kTriangles, first, count, sizeof *labels, labels,
                     [&](uint64_t cell, size_t n, void* to) { face_labels_->read(cell, n, to); });
  }

  std::unique_ptr<PieceColumn> cellColumn(PieceArray which, const char* name, int components) {
    return std::make_unique<PieceColumn>(
        mesh_, planNeeded(mesh_, which, PieceRows::kCells, name, components));
  }

  void planCells(PointJoin* joined) {
    connectivity_ = cellColumn(&MeshPiece::connectivity, "connectivity", 4);
    if (mesh_.form == CellForm::kTetrahedra) return;
    if (mesh_.form == CellForm::kOffsets) offsets_ = cellColumn(&MeshPiece::offsets, "offsets", 1);
    types_ = cellColumn(&MeshPiece::types, "types", 1);
    if (onlyTetrahedra() && !hasGhosts()) return takeTetrahedra();
    MixedCellsPlan plan{options_.temp_dir, options_.split, {}};
    if (joined) plan.first_of = [joined](int64_t point) { return joined->firstOf(point); };
    mixed_ = std::make_unique<MixedCells>(mesh_, plan);
  }

  bool onlyTetrahedra() {
    int64_t types[kCheckedAtOnce];
    for (uint64_t at = 0; at < mesh_.cell_count; at += kCheckedAtOnce) {
      const size_t n =
          static_cast<size_t>(std::min<uint64_t>(kCheckedAtOnce, mesh_.cell_count - at));
      types_->read(at, n, types);
      if (std::any_of(types, types + n, [](int64_t type) { return type != kVtkTetra; }))
        return false;
    }
    return true;
  }

  bool hasGhosts() const {
    return std::any_of(mesh_.pieces.begin(), mesh_.pieces.end(),
                       [](const MeshPiece& piece) { return ghostMarks(piece) != nullptr; });
  }

  void takeTetrahedra() {
    if (mesh_.form != CellForm::kInterleaved) return;
    for (MeshPiece& piece : mesh_.pieces)
      if (piece.cell_count > 0) dropCounts(mesh_.name, piece);
  }

  // The arrays of the first piece that has such rows, in its order; of the first one if none has.
  void planColumns(PieceArrays list, PieceRows rows, std::vector<Column>& schema,
                   std::vector<PieceColumn>& columns) {
    if (mesh_.pieces.empty()) return;
    size_t first = 0;
    while (first + 1 < mesh_.pieces.size() && !hasRows(mesh_.pieces[first], rows)) ++first;
    if (!hasRows(mesh_.pieces[first], rows)) first = 0;
    for (const MeshArray& model : mesh_.pieces[first].*list) {
      if (isGhostMarks(model)) {
        mesh_.addNote("array \"" + model.name +
                      "\" is left out: it tells of pieces, which are one mesh here");
        continue;
      }
      PieceColumnPlan plan;
      if (!planData(mesh_, list, rows, model, &plan)) continue;
      schema.push_back({model.name, plan.components, plan.type});
      columns.emplace_back(mesh_, std::move(plan));
    }
    for (const MeshPiece& piece : mesh_.pieces)
      for (const MeshArray& array : piece.*list)
        if (hasRows(piece, rows) && !isGhostMarks(array) &&
            !findArray(mesh_.pieces[first].*list, array.name))
          noteUnlike(mesh_, array.name);
  }

  // Whether one of them is not 0.
  bool countTriangleLabels(size_t column, IdCensus& census) {
    PieceColumnPlan plan = cell_data_[column].plan();
    plan.type = ScalarType::kInt64;
    PieceColumn wide(mesh_, std::move(plan));
    int64_t rows[kRowsAtOnce];
    bool any = false;
    const uint64_t count = mixed_->count(MixedCells::kTriangles);
    for (uint64_t first = 0; first < count; first += kRowsAtOnce) {
      const auto some = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - first));
      mixed_->readRows(MixedCells::kTriangles, first, some, sizeof rows[0], rows,
                       [&](uint64_t cell, size_t n, void* to) { wide.read(cell, n, to); });
      for (size_t i = 0; i < some; ++i) {
        census.add(&rows[i], 1);
        any = any || rows[i] != 0;
      }
    }
    return any;
  }

  // By one cell array, which is nothing else if only faces have it.
  void labelFaces() {
    const auto faces = static_cast<long long>(mixed_->count(MixedCells::kTriangles));
    const int by = faceLabelColumn(
        schema_.cell_data, mixed_->count(MixedCells::kTriangles),
        [this](size_t column, IdCensus& census) { return countTriangleLabels(column, census); });
    if (by < 0)
      return mesh_.addNote(
          textOf("%lld triangles are left out: there is no cell array of integers, one to "
                 "a cell, that could label them as faces, but for ids and ranks of processes",
                 faces));
    const auto place = static_cast<std::ptrdiff_t>(by);
    const std::string name = schema_.cell_data[static_cast<size_t>(by)].name;
    PieceColumnPlan plan = cell_data_[static_cast<size_t>(by)].plan();
    plan.type = ScalarType::kInt64;
    face_labels_ = std::make_unique<PieceColumn>(mesh_, std::move(plan));
    mesh_.addNote(
        textOf("%lld triangles are labelled faces, by the cell array \"%s\"", faces, name.c_str()));
    schema_.face_count = faces;
    if (name != kFaceLabelName) return;
    schema_.cell_data.erase(schema_.cell_data.begin() + place);
    std::vector<PieceColumn> kept;
    for (int i = 0; i < static_cast<int>(cell_data_.size()); ++i)
      if (i != by) kept.push_back(std::move(cell_data_[static_cast<size_t>(i)]));
    cell_data_.swap(kept);
  }

  // That every array has the size that the counts need, so that nobody allocates for a lie.
  void checkCells() {
    for (size_t i = 0; i < mesh_.pieces.size(); ++i) {
      if (!mixed_) connectivity_->check(i);
      if (!mixed_ && offsets_) offsets_->check(i);
      for (PieceColumn& column : cell_data_) column.check(i);
    }
  }

  // Those before checked_ are known to be good.
  void checkOffsets(uint64_t first, size_t count) {
    if (!offsets_) return;
    const uint64_t end = first + count;
    const bool sequential = first <= checked_;
    uint64_t at = sequential ? std::max(first, checked_) : first;
    while (at < end) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(kCheckedAtOnce, end - at));
      checkSomeOffsets(at, n);
      at += n;
    }
    if (sequential) checked_ = std::max(checked_, end);
  }

  void checkSomeOffsets(uint64_t first, size_t count) {
    int64_t offsets[kCheckedAtOnce];
    offsets_->read(first, count, offsets);
    size_t piece = 0;
    for (size_t i = 0; i < count; ++i) {
      piece = pieceOfCell(first + i, piece);
      const uint64_t expected = 4 * (first + i - mesh_.pieces[piece].first_cell + 1);
      if (static_cast<uint64_t>(offsets[i]) != expected)
        fail(Status::kBadData, "%s: the offset of cell %llu is %lld, of tetrahedra it is %llu",
             mesh_.name.c_str(), static_cast<unsigned long long>(first + i),
             static_cast<long long>(offsets[i]), static_cast<unsigned long long>(expected));
    }
  }

  // At or after `from`.
  size_t pieceOfCell(uint64_t cell, size_t from) const {
    while (cell - mesh_.pieces[from].first_cell >= mesh_.pieces[from].cell_count) ++from;
    return from;
  }

  // note: of a number that is no point, itself or the number of points behind it is negative; a
  // comparison would keep the compiler from working on several at once.
  void checkIds(const MeshPiece& piece, uint64_t first, size_t count, int64_t* ids) const {
    const uint64_t last = piece.point_count - 1;
    uint64_t outside = 0;
    for (size_t i = 0; i < 4 * count; ++i) {
      const auto id = static_cast<uint64_t>(ids[i]);
      outside |= id | (last - id);
      ids[i] = static_cast<int64_t>(id + piece.first_point);
    }
    if (outside >> 63) failId(piece, first, count, ids);
  }

  [[noreturn]] void failId(const MeshPiece& piece, uint64_t first, size_t count,
                           const int64_t* ids) const {
    size_t i = 0;
    const auto id = [&] { return static_cast<uint64_t>(ids[i]) - piece.first_point; };
    while (i + 1 < 4 * count && id() < piece.point_count) ++i;
    fail(Status::kBadData, "%s: cell %llu uses point %lld, there are %llu", mesh_.name.c_str(),
         static_cast<unsigned long long>(first + i / 4), static_cast<long long>(id()),
         static_cast<unsigned long long>(piece.point_count));
  }

  MeshPieces mesh_;
  ReadOptions options_;
  Schema schema_;
  std::unique_ptr<PieceColumn> points_, connectivity_, offsets_, types_, face_labels_;
  std::unique_ptr<MixedCells> mixed_;  // where the cells are not all that stay
  std::vector<PieceColumn> fields_, cell_data_;
  uint64_t mixed_faces_ = 0;  // of those, which come first
  uint64_t checked_ = 0;
};

}  // namespace

// Names that writers give to arrays of global ids of points where no attribute tells.
static constexpr const char* kGlobalIds[] = {"GlobalPointIds", "vtkGlobalPointIds", "GlobalNodeIds",
                                             "GlobalNodeId", "GlobalIds"};

static int findGlobalIds(const Schema& schema, const std::string& named) {
  const auto usable = [&](int i) {
    return i >= 0 && !isFloat(schema.fields[static_cast<size_t>(i)].type) &&
           schema.fields[static_cast<size_t>(i)].components == 1;
  };
  int found = findColumn(schema.fields, named);
  for (const char* name : kGlobalIds)
    if (!usable(found)) found = findColumn(schema.fields, name);
  return usable(found) ? found : -1;
}

// Those at the same place of all pieces, or none where that would take a corner from a cell: then
// nothing is joined that has not to be.
static std::shared_ptr<PointJoin> joinEverywhere(PiecedMesh& mesh, const JoinPlan& plan,
                                                 bool asked_for) {
  uint64_t cell = 0;
  const auto find = [&](PointJoin& points) { return cellThatLosesACorner(mesh.pieces(), points); };
  if (auto points = joinKeepingCorners(mesh, plan, find, &cell)) return points;
  const std::string why =
      textOf("cell %llu has two points at the same place", static_cast<unsigned long long>(cell));
  if (asked_for)
    fail(Status::kBadData, "%s: points cannot be joined: %s (option join-points, --join-points)",
         mesh.pieces().name.c_str(), why.c_str());
  if (plan.note) plan.note("points at the same place are not joined: " + why);
  return nullptr;
}

// Whether all points at the same place are to be joined.
static bool joinsEverywhere(const MeshPieces& mesh, const ReadOptions& options) {
  const bool asked_for = options.join == PointJoining::kYes;
  if (!asked_for && (options.join == PointJoining::kNo || !cellsAreApart(mesh))) return false;
  // Their faces are cut by the points as they were.
  if (!mesh.faces || !options.split || mesh.form == CellForm::kTetrahedra) return true;
  const char* const why =
      "points are not joined where labelled faces stand apart from cells that are split (options "
      "join-points and split)";
  if (asked_for) fail(Status::kUnsupported, "%s: %s", mesh.name.c_str(), why);
  if (options.note) options.note(mesh.name + ": " + why);
  return false;
}

// Cells that several pieces have are those of the first.
static std::unique_ptr<IndexedSource> joinPieces(std::unique_ptr<IndexedSource> mesh,
                                                 std::shared_ptr<PointJoin> points) {
  const JoinPlan plan = points->plan();
  std::shared_ptr<const RepeatedCells> repeated;
  if (!plan.everywhere) repeated = std::make_shared<RepeatedCells>(*mesh, *points);
  mesh = joinPoints(std::move(mesh), std::move(points));
  if (!repeated || repeated->count() == 0) return mesh;
  if (plan.note)
    plan.note(
        textOf("%llu cells that an earlier piece has, too, are left out: no vtkGhostType "
               "tells of them",
               static_cast<unsigned long long>(repeated->count())));
  return withoutCells(std::move(mesh), std::move(repeated));
}

Input openPiecedMesh(MeshPieces mesh, const ReadOptions& options) {
  JoinPlan plan;
  plan.everywhere = joinsEverywhere(mesh, options);
  if (mesh.join)
    for (const MeshPiece& piece : mesh.pieces)
      if (piece.point_count > 0) plan.first_points.push_back(piece.first_point);
  const std::string name = mesh.name, global_ids = mesh.global_ids;
  Input input;
  input.has_steps = mesh.has_steps;
  auto opened = std::make_unique<PiecedMesh>(std::move(mesh), options);
  plan.temp_dir = options.temp_dir;
  if (options.note)
    plan.note = [name, note = options.note](const std::string& text) { note(name + ": " + text); };
  std::shared_ptr<PointJoin> joined;
  if (plan.everywhere) joined = joinEverywhere(*opened, plan, options.join == PointJoining::kYes);
  if (!joined && plan.first_points.size() > 1) {
    plan.everywhere = false;
    plan.global_ids = findGlobalIds(opened->schema(), global_ids);
    joined = std::make_shared<PointJoin>(*opened, plan);
    joined->tell();
  }
  if (joined && !joined->changed()) joined.reset();
  opened->takeCells(joined.get());
  input.indexed = std::move(opened);
  if (joined) input.indexed = joinPieces(std::move(input.indexed), std::move(joined));
  return input;
}

}  // namespace tetstream
