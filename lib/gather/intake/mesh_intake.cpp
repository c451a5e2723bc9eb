#include "mesh_intake.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "kept_corners.h"
#include "label_names.h"
#include "point_set.h"
#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kMaxData = 1 << 14;  // as they are compared by name

std::string plural(uint64_t count, const std::string& things) {
  return std::to_string(count) + " " + things;
}

}  // namespace

MeshIntake::MeshIntake(const FileScan& file, const ReadOptions& options, ScalarType position_type)
    : file_(file),
      options_(options),
      name_(file.name()),
      mesh_(std::make_unique<MeshSpool>(position_type, options.temp_dir, options.threads.tasks)),
      held_cells_(4 * kRowsAtOnce) {}

void MeshIntake::addLabels(const char* name, bool wide, bool sure) {
  const ScalarType type = wide ? ScalarType::kInt64 : ScalarType::kInt32;
  labels_.push_back({mesh_->addCellData({name, 1, type}), false, wide, sure});
}

void MeshIntake::addPointLabels(const char* name, bool wide) {
  const ScalarType type = wide ? ScalarType::kInt64 : ScalarType::kInt32;
  point_labels_.push_back({mesh_->addField({name, 1, type}), true, wide, false});
}

void MeshIntake::takeLabel(Labels& labels, int64_t label, size_t count, int64_t number) {
  if (takeZeros(labels, count, label != 0)) return;
  if (!labels.wide && static_cast<int32_t>(label) != label)
    file_.failHere(Status::kUnsupported, "label " + std::to_string(label) + " of " +
                                             (labels.of_points ? "point " : "cell ") +
                                             std::to_string(number) + " has more than 32 bits");
  labels.held.insert(labels.held.end(), count, label);
  if (labels.held.size() >= kRowsAtOnce) writeLabels(labels);
}

// True: so many were counted, as there is none that is not 0 yet. If there is `any`, those before
// it are rows now.
bool MeshIntake::takeZeros(Labels& labels, uint64_t count, bool any) {
  if (!any && !labels.any)
    labels.zeros += count;
  else if (!labels.any)
    countZeros(labels);
  return !any && !labels.any;
}

void MeshIntake::countZeros(Labels& labels) {
  constexpr int64_t none[kRowsAtOnce] = {};
  labels.any = true;
  for (; labels.zeros > 0; labels.zeros -= std::min<uint64_t>(labels.zeros, kRowsAtOnce))
    appendLabels(labels, none, static_cast<size_t>(std::min<uint64_t>(labels.zeros, kRowsAtOnce)));
}

void MeshIntake::writeLabels(Labels& labels) {
  appendLabels(labels, labels.held.data(), labels.held.size());
  labels.held.clear();
}

void MeshIntake::appendLabels(Labels& labels, const int64_t* rows, size_t count) {
  const auto append = [&](const void* stored, size_t n) {
    if (labels.of_points)
      mesh_->appendField(labels.column, stored, n);
    else
      mesh_->appendCellData(labels.column, stored, n);
  };
  if (labels.wide) return append(rows, count);
  int32_t narrow[kRowsAtOnce];
  for (size_t n; count > 0; rows += n, count -= n) {
    n = std::min(count, kRowsAtOnce);
    for (size_t i = 0; i < n; ++i) narrow[i] = static_cast<int32_t>(rows[i]);
    append(narrow, n);
  }
}

void MeshIntake::placeLabels(Labels& labels, uint64_t count, std::shared_ptr<RowReader> rows) {
  writeLabels(labels);
  if (labels.of_points)
    mesh_->placeField(labels.column, count, std::move(rows));
  else
    mesh_->placeCellData(labels.column, count, std::move(rows));
}

void MeshIntake::placeLabels(Labels& labels, const RowsPlace& rows, const NumbersOfRow& label) {
  const bool any = labels.any || anyNonZero(rows, label, options_.threads.tasks);
  if (takeZeros(labels, rows.rows, any)) return;
  const auto& window = labels.of_points ? points_window_ : cells_window_;
  placeLabels(labels, rows.rows, placeNumbers(window, rows, label, typeOf(labels)));
}

void MeshIntake::placePointLabels(const RowsPlace& rows, const NumbersOfRow& label) {
  placeLabels(point_labels_.front(), rows, label);
}

void MeshIntake::placeCellLabels(size_t labels, const RowsPlace& rows, const NumbersOfRow& label) {
  placeLabels(labels_[labels], rows, label);
}

void MeshIntake::placeCellLabels(size_t labels, uint64_t count, int64_t label) {
  Labels& all = labels_[labels];
  if (!takeZeros(all, count, label != 0))
    placeLabels(all, count, placeConstant(label, typeOf(all)));
}

void MeshIntake::labelPoint(int64_t label) {
  takeLabel(point_labels_.front(), label, 1, static_cast<int64_t>(mesh_->pointCount()));
}

void MeshIntake::note(const std::string& text) {
  if (options_.note) options_.note(name_ + ": " + text);
}

void MeshIntake::nameLabels(std::vector<LabelName> names) {
  settleLabelNames(names);
  mesh_->nameLabels(std::move(names));
}

// ------------------------------------------------------------------------------ points and cells

void MeshIntake::addPoint(const double position[3]) {
  if (!std::isfinite(position[0]) || !std::isfinite(position[1]) || !std::isfinite(position[2]))
    file_.failBad("a position is not a finite number");
  if (mesh_->schema().position_type == ScalarType::kFloat64)
    return mesh_->appendPositions(position, 1);
  float narrow[3];
  for (int k = 0; k < 3; ++k) narrow[k] = static_cast<float>(position[k]);
  mesh_->appendPositions(narrow, 1);
}

static std::shared_ptr<FileWindow> windowOf(std::shared_ptr<FileWindow>& window,
                                            const RowsPlace& rows) {
  if (!window) window = std::make_shared<FileWindow>(rows.file);
  return window;
}

void MeshIntake::placePoints(const RowsPlace& rows, const NumbersOfRow& reals) {
  NumbersOfRow position = reals;
  position.finite = true;
  mesh_->placePositions(rows.rows, placeNumbers(windowOf(points_window_, rows), rows, position,
                                                mesh_->schema().position_type));
}

void MeshIntake::placeCells(CellKind kind, PlacedCellsPlan plan) {
  writeHeld();
  const uint64_t count = plan.place.rows;
  if (kind.nodes > cornersOf(kind.shape)) quadratic_ += count;
  std::shared_ptr<FileWindow> window = windowOf(cells_window_, plan.place);
  mesh_->placeCells(count, tetstream::placeCells(std::move(window), std::move(plan)));
}

size_t MeshIntake::addOtherCell(CellKind kind, const int64_t* corners, const int64_t* labels,
                                int64_t number) {
  if (kind.shape != CellShape::kTetra && !options_.split)
    file_.failHere(Status::kUnsupported, "cell " + std::to_string(number) + " is a " +
                                             nameOf(kind.shape) + "; " + kOnlyTetrahedra);
  size_t count = 1;
  if (kind.shape == CellShape::kTetra) {
    holdCell(corners);
  } else {
    int64_t made[kMostSplit][4];
    count = splitCell(kind.shape, corners, made);
    for (size_t i = 0; i < count; ++i) holdCell(made[i]);
    ++split_;
  }
  quadratic_ += kind.nodes > cornersOf(kind.shape);
  for (int c = 0; c < cornersOf(kind.shape); ++c)
    largest_corner_ = std::max(largest_corner_, corners[c]);
  takeLabels(labels, count, number);
  return count;
}

void MeshIntake::writeHeld() {
  if (held_ == 0) return;
  mesh_->appendCells(held_cells_.data(), held_);
  held_ = 0;
}

void MeshIntake::addFace(CellKind kind, const int64_t* corners, int64_t label) {
  int64_t made[2][3];
  const size_t count = splitFace(kind.shape, corners, made);
  for (int c = 0; c < cornersOf(kind.shape); ++c)
    largest_corner_ = std::max(largest_corner_, corners[c]);
  for (size_t i = 0; i < count; ++i) mesh_->appendFace(made[i], label);
}

void MeshIntake::leaveOutFaces(const std::string& things) {
  if (mesh_->faceCount() > 0) leaveOut(things, mesh_->faceCount());
  mesh_->forgetFaces();
}

// ------------------------------------------------------------------------------------------ data

size_t MeshIntake::addData(const Column& column, bool of_cells) {
  if (data_.size() == kMaxData)
    fail(Status::kUnsupported, "%s: there are more than %zu arrays", name_.c_str(), kMaxData);
  data_.push_back(std::make_unique<Data>(column, of_cells));
  return data_.size() - 1;
}

size_t MeshIntake::addCellNumbers(const std::string& name) {
  const size_t data = addData({name, 1, ScalarType::kFloat64}, true);
  data_[data]->maybe_integers = true;
  return data;
}

void MeshIntake::placeData(size_t data, const RowsPlace& rows, const NumbersOfRow& reals,
                           std::shared_ptr<FileWindow> window) {
  Data& d = *data_[data];
  d.placed = placeNumbers(std::move(window), rows, reals, d.column.type);
  d.placed_rows = rows.rows;
}

// What was said before of where the rows lie gives way to copies of them.
ScatteredRows& MeshIntake::scattered(Data& data) {
  if (data.rows) return *data.rows;
  data.rows.emplace(data.column.bytesPerRow(), options_.temp_dir);
  std::vector<unsigned char> row(data.column.bytesPerRow());
  for (uint64_t i = 0; i < data.placed_rows; ++i) {
    data.placed->read(i, 1, row.data());
    data.rows->put(i, row.data());
  }
  data.placed.reset();
  data.placed_rows = 0;
  return *data.rows;
}

void MeshIntake::putData(size_t data, uint64_t row, const double* values) {
  Data& d = *data_[data];
  const auto count = static_cast<size_t>(d.column.components);
  d.maybe_integers = d.maybe_integers && *values >= INT32_MIN && *values <= INT32_MAX &&
                     *values == std::trunc(*values);
  if (d.column.type == ScalarType::kFloat64) return scattered(d).put(row, values);
  int64_t rounded[kMaxComponents];  // room for any type
  if (d.column.type == ScalarType::kFloat32) {
    convertScalars(values, ScalarType::kFloat64, rounded, ScalarType::kFloat32, count);
  } else {
    for (size_t k = 0; k < count; ++k) {
      const bool is_narrow = d.column.type == ScalarType::kInt32;
      const double limit = is_narrow ? 0x1p31 : 0x1p63;
      const bool is_rounded = !is_narrow && values[k] == limit;  // from the largest ones
      if (!(values[k] >= -limit && values[k] < limit && values[k] == std::trunc(values[k])) &&
          !is_rounded)
        file_.failBad("\"" + d.column.name + "\" is said to hold integers, and here is none");
      const int64_t value = is_rounded ? INT64_MAX : static_cast<int64_t>(values[k]);
      const auto narrow = static_cast<int32_t>(value);
      auto* to = reinterpret_cast<unsigned char*>(rounded) + k * sizeOf(d.column.type);
      if (is_narrow)
        std::memcpy(to, &narrow, sizeof narrow);
      else
        std::memcpy(to, &value, sizeof value);
    }
  }
  scattered(d).put(row, rounded);
}

// In place: each is read before it is written over.
static void toIntegers(std::vector<unsigned char>& rows, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    double value;
    std::memcpy(&value, rows.data() + i * sizeof value, sizeof value);
    const auto integer = static_cast<int32_t>(value);
    std::memcpy(rows.data() + i * sizeof integer, &integer, sizeof integer);
  }
}

void MeshIntake::appendData(const Data& data, size_t column, const void* rows, size_t count) {
  if (data.of_cells)
    mesh_->appendCellData(column, rows, count);
  else
    mesh_->appendField(column, rows, count);
}

void MeshIntake::copyRows(Data& data, size_t column, uint64_t count) {
  ScatteredRows& from = scattered(data);
  from.finish(count);
  if (from.given() < count)
    note("\"" + data.column.name + "\" has no value at " +
         plural(count - from.given(), data.of_cells ? "tetrahedra" : "points") +
         ", where it is taken as 0");
  std::vector<unsigned char> rows(kRowsAtOnce * from.rowBytes());
  for (uint64_t at = 0; at < count; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - at));
    from.read(at, n, rows.data());
    if (data.maybe_integers) toIntegers(rows, n);
    appendData(data, column, rows.data(), n);
  }
}

void MeshIntake::copyData() {
  for (auto& d : data_) {
    const uint64_t count = d->of_cells ? mesh_->cellCount() : mesh_->pointCount();
    const bool is_placed = d->placed && d->placed_rows == count;
    if (!is_placed) scattered(*d);
    if (d->maybe_integers) d->column.type = ScalarType::kInt32;
    const size_t column = d->of_cells ? mesh_->addCellData(d->column) : mesh_->addField(d->column);
    if (!is_placed)
      copyRows(*d, column, count);
    else if (d->of_cells)
      mesh_->placeCellData(column, count, d->placed);
    else
      mesh_->placeField(column, count, d->placed);
    d.reset();  // and its file
  }
}

// ---------------------------------------------------------------------------------------- the end

void MeshIntake::checkCorners() {
  const auto points = static_cast<int64_t>(mesh_->pointCount());
  if (largest_corner_ < points) return;
  std::vector<int64_t> rows(4 * kRowsAtOnce);
  for (uint64_t at = 0; at < mesh_->cellCount(); at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh_->cellCount() - at));
    mesh_->readCells(at, n, rows.data());
    for (size_t i = 0; i < 4 * n; ++i)
      if (rows[i] >= points)
        fail(Status::kBadData,
             "%s: tetrahedron %llu uses point %lld, counted from 0; there are %lld", name_.c_str(),
             static_cast<unsigned long long>(at + i / 4), static_cast<long long>(rows[i]),
             static_cast<long long>(points));
  }
  fail(Status::kBadData, "%s: a cell or face uses point %lld, counted from 0; there are %lld",
       name_.c_str(), static_cast<long long>(largest_corner_), static_cast<long long>(points));
}

// visit(its three points) for all faces.
template <class Visit>
void MeshIntake::forFaces(Visit visit) {
  std::vector<int64_t> corners(3 * kRowsAtOnce), labels(kRowsAtOnce);
  for (uint64_t at = 0; at < mesh_->faceCount(); at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh_->faceCount() - at));
    mesh_->readFaces(at, n, corners.data(), labels.data());
    for (size_t i = 0; i < n; ++i) visit(&corners[3 * i]);
  }
}

// Of faces that no cell has, most have points that no cell has either.
void MeshIntake::dropStrayFaces(PointJoin* joined) {
  if (mesh_->faceCount() == 0) return;
  mesh_->finishFaces();
  Account account;
  PointSet unused(account, mesh_->pointCount());  // of the faces' points
  const auto pointOf = [joined](int64_t p) {
    return static_cast<uint64_t>(joined ? joined->firstOf(p) : p);
  };
  uint64_t left = 0;
  forFaces([&](const int64_t* face) {
    for (int k = 0; k < 3; ++k) left += unused.add(pointOf(face[k]));
  });
  constexpr size_t kCells = 4 * kRowsAtOnce;  // each time
  std::vector<int64_t> rows(4 * kCells);
  for (uint64_t at = 0; at < mesh_->cellCount() && left > 0; at += kCells) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kCells, mesh_->cellCount() - at));
    mesh_->readCells(at, n, rows.data());
    for (size_t i = 0; i < 4 * n; ++i) left -= unused.remove(pointOf(rows[i]));
  }
  if (left == 0) return;
  const auto isUsed = [&](int64_t p) { return !unused.has(pointOf(p)); };
  const uint64_t gone = mesh_->keepFaces(
      [&](const int64_t* face) { return isUsed(face[0]) && isUsed(face[1]) && isUsed(face[2]); });
  leaveOut("triangles that are no faces of cells", gone);
}

std::unique_ptr<IndexedSource> MeshIntake::finish() {
  writeHeld();
  for (Labels& labels : labels_) writeLabels(labels);
  for (Labels& labels : point_labels_) writeLabels(labels);
  copyData();
  for (size_t k = labels_.size(); k-- > 0;)  // a label that nobody has
    if (!labels_[k].any) mesh_->removeCellData(labels_[k].column);
  for (const Labels& labels : point_labels_)
    if (!labels.any) mesh_->removeField(labels.column);
  mesh_->finish();
  checkCorners();
  const std::shared_ptr<PointJoin> joined = joinPoints();
  dropStrayFaces(joined.get());
  if (mesh_->cellCount() == 0 && mesh_->pointCount() > 0)
    fail(Status::kUnsupported, "%s: there are points, but no tetrahedron", name_.c_str());
  if (quadratic_ > 0) note(plural(quadratic_, kHigherOrderNote));
  if (split_ > 0) note(plural(split_, kSplitNote));
  for (const auto& [things, count] : left_out_) note(plural(count, things + " are left out"));
  if (!joined) return std::move(mesh_);
  return tetstream::joinPoints(std::move(mesh_), joined);
}

std::shared_ptr<PointJoin> MeshIntake::joinPoints() {
  if (options_.join != PointJoining::kYes) return nullptr;
  if (split_ > 0)
    fail(Status::kUnsupported,
         "%s: points are joined after cells were split, which then do not agree (options "
         "join-points and split)",
         name_.c_str());
  JoinPlan plan;
  plan.temp_dir = options_.temp_dir;
  plan.note = [this](const std::string& text) { note(text); };
  uint64_t cell = 0;
  const auto find = [this](PointJoin& points) { return cellThatLosesACorner(*mesh_, points); };
  auto points = joinKeepingCorners(*mesh_, plan, find, &cell);
  if (!points)
    fail(Status::kBadData,
         "%s: points cannot be joined: tetrahedron %llu has two points at the same place (option "
         "join-points, --join-points)",
         name_.c_str(), static_cast<unsigned long long>(cell));
  return points->changed() ? points : nullptr;
}

}  // namespace tetstream
