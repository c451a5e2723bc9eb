#include "intake.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

#include "float_labels.h"
#include "status.h"

namespace tetstream {

// Values of one row of a column, converted.
template <class From, class To>
static void copyAs(const void* row, int count, To* out) {
  for (int i = 0; i < count; ++i) {
    From value;
    std::memcpy(&value, static_cast<const char*>(row) + sizeof(From) * static_cast<size_t>(i),
                sizeof value);
    out[i] = static_cast<To>(value);
  }
}

template <class To>
static void readFloats(const void* rows, ScalarType type, size_t row, int count, To* out) {
  const char* at = static_cast<const char*>(rows) + row * static_cast<size_t>(count) * sizeOf(type);
  type == ScalarType::kFloat32 ? copyAs<float>(at, count, out) : copyAs<double>(at, count, out);
}

static void readIntegers(const void* rows, ScalarType type, size_t row, int count, int64_t* out) {
  const char* at = static_cast<const char*>(rows) + row * static_cast<size_t>(count) * sizeOf(type);
  type == ScalarType::kInt32 ? copyAs<int32_t>(at, count, out) : copyAs<int64_t>(at, count, out);
}

template <class T>
static bool allFinite(const T* values, int count) {
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

template <class S>
void Intake<S>::startBatch(const BatchView& batch) {
  if (batch.first_vertex != declared_)
    fail(Status::kBadData, "a batch starts with vertex %llu, vertex %llu is next",
         static_cast<unsigned long long>(batch.first_vertex),
         static_cast<unsigned long long>(declared_));
  batch_ = batch;
  declared_ += batch.vertex_count;
  core_.window.expect(batch.cell_count, batch.vertex_count);
  if (batch.face_count > 0) startFaces();
  if (batch.edge_count > 0) takeLocks();
}

// A vertex of a labelled face or locked edge has to be known before the vertex is final.
template <class S>
void Intake<S>::checkEarly(const char* what, int64_t number, int64_t vertex) const {
  if (vertex < 0 || static_cast<uint64_t>(vertex) >= declared_)
    fail(Status::kBadData, "%s %lld: vertex %lld is not declared before it", what,
         static_cast<long long>(number), static_cast<long long>(vertex));
  const auto v = static_cast<uint64_t>(vertex);
  if (v >= core_.front.introduced() || core_.front.find(v) != kNoSlot) return;
  // Of a mesh that was put into an order the face comes while its cell is there.
  if (batch_.face_origins)
    fail(Status::kBadData, "%s %lld is the face of no cell", what, static_cast<long long>(number));
  fail(Status::kBadData,
       "%s %lld: vertex %lld was finalized in a batch before: it is no part of a cell, or comes "
       "later than with the batch in which the first of its vertices gets its last use",
       what, static_cast<long long>(number), static_cast<long long>(vertex));
}

template <class S>
int64_t Intake<S>::lastVertexOf(size_t face) const {
  const int64_t* v = batch_.faces + 3 * face;
  return std::max({v[0], v[1], v[2]});
}

template <class S>
int64_t Intake<S>::numberOf(size_t face) const {
  if (batch_.face_origins) return batch_.face_origins[face];
  return static_cast<int64_t>(faces_read_ - batch_.face_count + face);
}

// Each is taken with the last of its vertices, so that these need not come before their cells.
template <class S>
void Intake<S>::startFaces() {
  const size_t count = batch_.face_count;
  faces_read_ += count;
  for (size_t row = 0; row < count; ++row)
    for (size_t j = 0; j < 3; ++j)
      checkEarly("labelled face", numberOf(row), batch_.faces[3 * row + j]);
  if (face_order_.size() < count) face_order_.resize(count);
  std::iota(face_order_.data(), face_order_.data() + count, size_t{0});
  std::sort(face_order_.data(), face_order_.data() + count, [this](size_t a, size_t b) {
    return std::pair(lastVertexOf(a), a) < std::pair(lastVertexOf(b), b);
  });
  faces_taken_ = 0;
  takeFaces();
}

template <class S>
void Intake<S>::takeFaces() {
  const auto introduced = static_cast<int64_t>(core_.front.introduced());
  for (; faces_taken_ < batch_.face_count; ++faces_taken_) {
    if (lastVertexOf(face_order_[faces_taken_]) >= introduced) return;
    takeFace(face_order_[faces_taken_]);
  }
}

// It waits for its cell to be looked at: when the first of its vertices is resolved.
template <class S>
void Intake<S>::takeFace(size_t row) {
  const int64_t number = numberOf(row);
  uint32_t slots[3];
  for (size_t j = 0; j < 3; ++j) {
    slots[j] = core_.front.find(static_cast<uint64_t>(batch_.faces[3 * row + j]));
    // One was final before the others came: no cell has them all.
    if (slots[j] == kNoSlot) return core_.window.faces.addOfNoCell(number);
  }
  for (const uint32_t slot : slots) {
    core_.window.mesh.flagVertex(slot, kInterface);
    if (batch_.face_locks && batch_.face_locks[row]) lock(slot);
  }
  if (const int64_t* before =
          core_.window.faces.expect(slots[0], slots[1], slots[2], batch_.face_labels[row], number))
    fail(Status::kBadData, "labelled faces %lld and %lld have the same vertices",
         static_cast<long long>(std::min(*before, number)),
         static_cast<long long>(std::max(*before, number)));
}

static void refuse(const LabelledFaces::Strange& faces, const char* what) {
  if (faces.count == 0) return;
  const auto first = static_cast<long long>(faces.first);
  if (faces.count == 1) fail(Status::kBadData, "labelled face %lld %s", first, what);
  fail(Status::kBadData, "labelled face %lld %s, the first of %zu such faces", first, what,
       faces.count);
}

template <class S>
void Intake<S>::checkFaces() const {
  refuse(core_.window.faces.ofNoCell(), "is the face of no cell");
  refuse(core_.window.faces.again(), "came before");
}

// note: locked ends are enough: an edge stays as it is while neither is merged or moved.
template <class S>
void Intake<S>::takeLocks() {
  for (size_t row = 0; row < batch_.edge_count; ++row, ++edges_read_)
    for (size_t j = 0; j < 2; ++j) {
      const int64_t vertex = batch_.locked_edges[2 * row + j];
      checkEarly("locked edge", static_cast<int64_t>(edges_read_), vertex);
      introduceUpTo(static_cast<uint64_t>(vertex));
      lock(core_.front.find(static_cast<uint64_t>(vertex)));
    }
}

template <class S>
void Intake<S>::lock(uint32_t slot) {
  Topology& mesh = core_.window.mesh;
  core_.locked.by_caller += !(mesh.vertexFlags(slot) & kCallerLocked);
  mesh.flagVertex(slot, kLocked | kCallerLocked);
}

template <class S>
void Intake<S>::readColumn(size_t column, size_t row, uint32_t slot) {
  const Column& c = core_.plan.schema.fields[column];
  const ColumnPlan& place = core_.plan.fields[column];
  if (place.treatment == Treatment::kPicked) {
    readIntegers(batch_.fields[column], c.type, row, c.components,
                 core_.window.picks(slot) + place.offset);
    return;
  }
  S* out = core_.window.values(slot) + place.offset;
  readFloats(batch_.fields[column], c.type, row, c.components, out);
  if (place.treatment == Treatment::kMeasured && !allFinite(out, c.components))
    failNotFinite("vertex " + std::to_string(batch_.first_vertex + row), c);
}

template <class S>
void Intake<S>::growVertices() {
  const size_t capacity = core_.window.mesh.vertexCapacity();
  growArray(capacity, capacity / 4 + 64, [this](size_t n) { core_.window.growVertices(n); });
}

template <class S>
void Intake<S>::takeVertex(size_t row) {
  Window<S>& window = core_.window;
  if (window.mesh.vertexEnd() == window.mesh.vertexCapacity()) growVertices();
  const bool locked = batch_.locked && batch_.locked[row];
  const uint32_t slot = window.mesh.addVertex(locked ? kLocked | kCallerLocked : 0);
  core_.locked.by_caller += locked;
  readFloats(batch_.positions, core_.plan.schema.position_type, row, 3, window.values(slot));
  if (!allFinite(window.values(slot), 3))
    fail(Status::kBadData, "vertex %llu: its position is not finite",
         static_cast<unsigned long long>(batch_.first_vertex + row));
  for (size_t i = 0; i < core_.plan.fields.size(); ++i) readColumn(i, row, slot);
  lone_values_.add(window.values(slot));
  std::fill_n(window.quadric(slot), window.shape().quadric, S(0));
  if (window.shape().errors) window.error(slot) = 0;
  if (window.shape().origins)
    window.origin(slot) =
        batch_.origins ? batch_.origins[row] : static_cast<int64_t>(batch_.first_vertex + row);
  core_.front.introduce(slot);
}

template <class S>
void Intake<S>::introduceUpTo(uint64_t vertex) {
  while (core_.front.introduced() <= vertex)
    takeVertex(static_cast<size_t>(core_.front.introduced() - batch_.first_vertex));
  if (faces_taken_ < batch_.face_count) takeFaces();
}

// Most are known and active: that they are was checked then.
template <class S>
inline uint32_t Intake<S>::slotOf(int64_t vertex) {
  if (static_cast<uint64_t>(vertex) < core_.front.introduced()) {
    const uint32_t slot = core_.front.find(static_cast<uint64_t>(vertex));
    if (slot != kNoSlot) return slot;
  }
  return newSlotOf(vertex);
}

template <class S>
[[gnu::noinline]] uint32_t Intake<S>::newSlotOf(int64_t vertex) {
  if (vertex < 0 || static_cast<uint64_t>(vertex) >= declared_)
    fail(Status::kBadData, "cell %llu: vertex %lld is not declared before it",
         static_cast<unsigned long long>(cells_read_), static_cast<long long>(vertex));
  introduceUpTo(static_cast<uint64_t>(vertex));
  const uint32_t slot = core_.front.find(static_cast<uint64_t>(vertex));
  if (slot == kNoSlot)
    fail(Status::kBadData, "cell %llu: vertex %lld was finalized before it",
         static_cast<unsigned long long>(cells_read_), static_cast<long long>(vertex));
  return slot;
}

template <class S>
void Intake<S>::takeCellData(size_t row, uint32_t cell) {
  const Plan& plan = core_.plan;
  for (size_t i = 0; i < plan.cell_data.size(); ++i) {
    const Column& c = plan.schema.cell_data[i];
    const int offset = plan.cell_data[i].offset;
    if (plan.cell_data[i].treatment == Treatment::kPicked) {
      int64_t* const picks = core_.window.cellPicks(cell) + offset;
      if (isFloat(c.type))
        readFloatLabels(c, batch_.cell_data[i], row, 1, cells_read_ - row, picks);
      else
        readIntegers(batch_.cell_data[i], c.type, row, c.components, picks);
      continue;
    }
    readFloats(batch_.cell_data[i], c.type, row, c.components,
               core_.window.cellMeans(cell) + 1 + offset);
  }
}

template <class S>
[[gnu::noinline]] void Intake<S>::failTwice(const int64_t ids[4]) {
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < j; ++i)
      if (ids[i] == ids[j])
        fail(Status::kBadData, "cell %llu: vertex %lld is there twice",
             static_cast<unsigned long long>(cells_read_), static_cast<long long>(ids[j]));
}

template <class S>
void Intake<S>::takeCell(size_t row) {
  const int64_t* ids = batch_.cells + 4 * row;
  uint32_t v[4];
  if (!core_.front.findFour(ids, v))
    for (int j = 0; j < 4; ++j) v[j] = slotOf(ids[j]);
  if ((v[0] == v[1]) | (v[0] == v[2]) | (v[0] == v[3]) | (v[1] == v[2]) | (v[1] == v[3]) |
      (v[2] == v[3]))
    failTwice(ids);
  const int64_t last_id = std::max(std::max(ids[0], ids[1]), std::max(ids[2], ids[3]));
  core_.reached = std::max(core_.reached, static_cast<uint64_t>(last_id) + 1);
  const uint32_t cell = core_.window.mesh.addCell(v, 0);
  if (!core_.plan.cell_data.empty()) takeCellData(row, cell);
  if (core_.window.shape().points) core_.window.firstPoints()[cell] = kNone;
  const unsigned last = batch_.last_uses ? batch_.last_uses[row] & 15u : 0;
  for (unsigned j = 0; last >> j; ++j)
    if (last >> j & 1) finalize(ids[j]);
  ++cells_read_;
}

template <class S>
void Intake<S>::finalize(int64_t vertex) {
  if (vertex < 0 || static_cast<uint64_t>(vertex) >= declared_)
    fail(Status::kBadData, "finalized vertex %lld is not declared", static_cast<long long>(vertex));
  introduceUpTo(static_cast<uint64_t>(vertex));
  const uint32_t slot = core_.front.find(static_cast<uint64_t>(vertex));
  if (slot == kNoSlot)
    fail(Status::kBadData, "vertex %lld is finalized twice", static_cast<long long>(vertex));
  core_.front.finalize(static_cast<uint64_t>(vertex));
  queueFinal(slot);
}

template <class S>
void Intake<S>::queueFinal(uint32_t slot) {
  core_.window.mesh.flagVertex(slot, kFinal);
  if (finalized_count_ == finalized_.size()) finalized_.resize(2 * finalized_.size());
  finalized_[finalized_count_++] = slot;
}

template <class S>
void Intake<S>::finishBatch() {
  if (declared_ > 0) introduceUpTo(declared_ - 1);
  for (size_t i = 0; i < batch_.finalized_count; ++i) finalize(batch_.finalized[i]);
  batch_ = {};
  batch_.first_vertex = declared_;
}

template <class S>
void Intake<S>::finalizeAll() {
  for (uint32_t v = 0; v < core_.window.mesh.vertexEnd(); ++v)
    if (!(core_.window.mesh.vertexFlags(v) & kFinal)) queueFinal(v);
}

template class Intake<float>;
template class Intake<double>;

}  // namespace tetstream
