#include "vtu_cells.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

constexpr size_t kCheckedAtOnce = 2048;  // cells

// By kind: VTK's number, and the points of a cell.
constexpr int64_t kTypes[] = {10, 5};
constexpr size_t kPoints[] = {4, 3};

VtuCells::VtuCells(ByteSource& bytes, const VtuFile& file)
    : bytes_(bytes),
      file_(file),
      offsets_(bytes, file,
               planNeeded(file, bytes, &VtuPiece::offsets, VtuRows::kCells, "offsets", 1)),
      types_(bytes, file, planNeeded(file, bytes, &VtuPiece::types, VtuRows::kCells, "types", 1)),
      connectivity_plan_(
          planNeeded(file, bytes, &VtuPiece::connectivity, VtuRows::kCells, "connectivity", 4)),
      runs_{Array<Run>(account_), Array<Run>(account_)},
      values_(file.pieces.size()) {
  for (size_t i = 0; i < file.pieces.size(); ++i)
    if (hasRows(file.pieces[i], VtuRows::kCells)) addPiece(i);
  if (counts_[0] == 0 && counts_[1] > 0)
    failType(runsOf(VtuKind::kTriangle)[0].first_cell, kTypes[1]);
}

void VtuCells::addPiece(size_t piece) {
  const VtuPiece& p = file_.pieces[piece];
  types_.check(piece);
  offsets_.check(piece);
  if (holdsOnlyTetrahedra(piece))
    add(VtuKind::kTetrahedron, piece, p.first_cell, p.cell_count, 0);
  else
    readTypes(piece);
  openConnectivity(piece);
}

// As far as the size of the connectivity tells, which of text it does not.
bool VtuCells::holdsOnlyTetrahedra(size_t piece) {
  const VtuArray& array = *connectivity_plan_.arrays[piece];
  if (array.format == VtuFormat::kAscii) return false;
  try {
    openVtuValues(bytes_, file_, array, 4 * file_.pieces[piece].cell_count);
    return true;
  } catch (const Error& error) {
    if (error.status() != Status::kBadData) throw;
    return false;
  }
}

void VtuCells::readTypes(size_t piece) {
  const VtuPiece& p = file_.pieces[piece];
  int64_t types[kCheckedAtOnce];
  uint64_t value = 0;
  for (uint64_t at = 0; at < p.cell_count; at += kCheckedAtOnce) {
    const auto count = static_cast<size_t>(std::min<uint64_t>(kCheckedAtOnce, p.cell_count - at));
    types_.read(p.first_cell + at, count, types);
    for (size_t i = 0, j; i < count; i = j) {
      for (j = i + 1; j < count && types[j] == types[i];) ++j;
      const uint64_t cell = p.first_cell + at + i;
      const auto* kind = std::find(std::begin(kTypes), std::end(kTypes), types[i]);
      if (kind == std::end(kTypes)) failType(cell, types[i]);
      add(static_cast<VtuKind>(kind - kTypes), piece, cell, j - i, value);
      value += kPoints[kind - kTypes] * (j - i);
    }
  }
}

void VtuCells::add(VtuKind kind, size_t piece, uint64_t cell, uint64_t count, uint64_t value) {
  const auto k = static_cast<size_t>(kind);
  Array<Run>& runs = runs_[k];
  size_t& known = run_counts_[k];
  Run* const last = known > 0 ? &runs[known - 1] : nullptr;
  if (last && last->piece == piece && last->first_cell + last->count == cell) {
    last->count += count;
  } else {
    if (known == runs.size()) runs.resize(std::max<size_t>(8, 2 * known));
    runs[known++] = {counts_[k], count, cell, value, piece};
  }
  counts_[k] += count;
  values_[piece] += kPoints[k] * count;
}

void VtuCells::openConnectivity(size_t piece) {
  if (piece == piece_) return;
  piece_ = SIZE_MAX;
  connectivity_.reset();
  connectivity_ = openVtuValues(bytes_, file_, *connectivity_plan_.arrays[piece], values_[piece]);
  piece_ = piece;
}

// ------------------------------------------------------------------------------------ reading

// The run that has the cell of the kind.
size_t VtuCells::runAt(VtuKind kind, uint64_t first) const {
  const Run* const runs = runsOf(kind);
  const Run* const end = runs + run_counts_[static_cast<size_t>(kind)];
  const Run* const after = std::upper_bound(
      runs, end, first, [](uint64_t cell, const Run& run) { return cell < run.first; });
  return static_cast<size_t>(after - runs) - 1;
}

void VtuCells::checkRange(VtuKind kind, uint64_t first, size_t count) const {
  if (first > this->count(kind) || count > this->count(kind) - first)
    fail(Status::kBadArgument, "%s: cells %llu to %llu were asked for, there are %llu",
         bytes_.name().c_str(), static_cast<unsigned long long>(first),
         static_cast<unsigned long long>(first + count),
         static_cast<unsigned long long>(this->count(kind)));
}

void VtuCells::readPoints(VtuKind kind, uint64_t first, size_t count, int64_t* out) {
  checkRange(kind, first, count);
  uint64_t& checked = checked_[static_cast<size_t>(kind)];
  const uint64_t end = first + count;
  for (size_t at = count > 0 ? runAt(kind, first) : 0; first < end; ++at) {
    const Run& run = runsOf(kind)[at];
    const auto cells = static_cast<size_t>(std::min(run.first + run.count, end) - first);
    readRun(kind, run, first - run.first, cells, out);
    out += kPoints[static_cast<size_t>(kind)] * cells;
    first += cells;
    if (first - cells <= checked) checked = std::max(checked, first);
  }
}

void VtuCells::readRun(VtuKind kind, const Run& run, uint64_t before, size_t count, int64_t* out) {
  const size_t width = kPoints[static_cast<size_t>(kind)];
  const uint64_t checked = checked_[static_cast<size_t>(kind)];
  const uint64_t first = run.first + before;
  const bool in_sequence = first <= checked;
  for (uint64_t at = in_sequence ? std::max(first, checked) : first; at < first + count;) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kCheckedAtOnce, first + count - at));
    checkTypes(kind, run.first_cell + at - run.first, n);
    checkOffsets(kind, run, at - run.first, n);
    at += n;
  }
  openConnectivity(run.piece);
  connectivity_->read(run.first_value + width * before, width * count, out, ScalarType::kInt64);
  const VtuPiece& piece = file_.pieces[run.piece];
  for (size_t i = 0; i < width * count; ++i) {
    if (static_cast<uint64_t>(out[i]) >= piece.point_count)
      fail(Status::kBadData, "%s: cell %llu uses point %lld, there are %llu", bytes_.name().c_str(),
           static_cast<unsigned long long>(run.first_cell + before + i / width),
           static_cast<long long>(out[i]), static_cast<unsigned long long>(piece.point_count));
    out[i] += static_cast<int64_t>(piece.first_point);
  }
}

void VtuCells::failType(uint64_t cell, int64_t type) const {
  fail(
      Status::kUnsupported,
      "%s: cell %llu has VTK's type %lld; only linear tetrahedra (type 10) are read, and triangles "
      "(type 5) as faces of theirs",
      bytes_.name().c_str(), static_cast<unsigned long long>(cell), static_cast<long long>(type));
}

void VtuCells::checkTypes(VtuKind kind, uint64_t first, size_t count) {
  int64_t types[kCheckedAtOnce];
  types_.read(first, count, types);
  for (size_t i = 0; i < count; ++i)
    if (types[i] != kTypes[static_cast<size_t>(kind)]) failType(first + i, types[i]);
}

void VtuCells::checkOffsets(VtuKind kind, const Run& run, uint64_t before, size_t count) {
  int64_t offsets[kCheckedAtOnce];
  const size_t width = kPoints[static_cast<size_t>(kind)];
  const uint64_t first = run.first_cell + before;
  offsets_.read(first, count, offsets);
  for (size_t i = 0; i < count; ++i) {
    const uint64_t expected = run.first_value + width * (before + i + 1);
    if (static_cast<uint64_t>(offsets[i]) != expected)
      fail(Status::kBadData, "%s: the offset of cell %llu is %lld, where it should be %llu",
           bytes_.name().c_str(), static_cast<unsigned long long>(first + i),
           static_cast<long long>(offsets[i]), static_cast<unsigned long long>(expected));
  }
}

}  // namespace tetstream
