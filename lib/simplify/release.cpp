#include "release.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "error_sample.h"
#include "settled.h"
#include "vector3.h"

namespace tetstream {

template <class To, class From>
static void storeAs(const From* values, int count, void* row) {
  for (int i = 0; i < count; ++i) {
    const To value = static_cast<To>(values[i]);
    std::memcpy(static_cast<char*>(row) + sizeof(To) * static_cast<size_t>(i), &value,
                sizeof value);
  }
}

template <class From>
static void storeRow(const From* values, ScalarType type, int count, void* row) {
  switch (type) {
    case ScalarType::kFloat32:
      return storeAs<float>(values, count, row);
    case ScalarType::kFloat64:
      return storeAs<double>(values, count, row);
    case ScalarType::kInt32:
      return storeAs<int32_t>(values, count, row);
    case ScalarType::kInt64:
      return storeAs<int64_t>(values, count, row);
  }
}

template <class S>
bool Release<S>::mayGo(uint32_t cell) const {
  const Topology& mesh = core_.window.mesh;
  const uint32_t* v = mesh.corners(cell);
  return mesh.vertexFlags(v[0]) & mesh.vertexFlags(v[1]) & mesh.vertexFlags(v[2]) &
         mesh.vertexFlags(v[3]) & kFinal;
}

template <class S>
bool Release<S>::mustGo(const Staying& most) const {
  return core_.window.mesh.liveCells() > most.cells ||
         (core_.tracer && core_.tracer->pointCount() > most.points);
}

template <class S>
void Release<S>::countUses() {
  const Topology& mesh = core_.window.mesh;
  const size_t vertices = mesh.vertexEnd(), parts = core_.parts();
  std::vector<uint32_t*> uses_of = {core_.window.scratch()};
  for (size_t other = 0; other + 1 < parts; ++other) {
    if (other_uses_[other].size() < vertices) other_uses_[other].resize(mesh.vertexCapacity());
    uses_of.push_back(other_uses_[other].data());
  }
  std::vector<int64_t> front(parts);
  core_.forPartsOfCells([&](uint32_t first, uint32_t end, size_t part) {
    uint32_t* const uses = uses_of[part];
    std::memset(uses, 0, vertices * sizeof(uint32_t));
    int64_t touching = 0;  // a vertex not yet final
    for (uint32_t c = first; c < end; ++c) {
      if (!mesh.isLive(c)) continue;
      for (int j = 0; j < 4; ++j) ++uses[mesh.corners(c)[j]];
      touching += !mayGo(c);
    }
    front[part] = touching;
  });
  front_ = 0;
  for (int64_t touching : front) front_ += touching;
  core_.forPartsOf(parts > 1 ? vertices : 0, [&](uint32_t first, uint32_t end, size_t) {
    for (size_t other = 1; other < parts; ++other)
      for (uint32_t v = first; v < end; ++v) uses_of[0][v] += uses_of[other][v];
  });
}

template <class S>
void Release<S>::writeVertex(uint32_t v) {
  const Plan& plan = core_.plan;
  const size_t row = batch_.addVertices(1);
  const S* values = core_.window.values(v);
  storeRow(values, plan.schema.position_type, 3, batch_.position(row));
  for (size_t i = 0; i < plan.fields.size(); ++i) {
    const Column& c = plan.schema.fields[i];
    const ColumnPlan& place = plan.fields[i];
    if (place.treatment == Treatment::kPicked)
      storeRow(core_.window.picks(v) + place.offset, c.type, c.components, batch_.field(i, row));
    else
      storeRow(values + place.offset, c.type, c.components, batch_.field(i, row));
  }
  if (core_.window.mesh.vertexFlags(v) & kCallerLocked) batch_.lock(row);
  core_.window.outRank(v) = vertices_++;
  core_.window.mesh.flagVertex(v, kWritten);
}

template <class S>
void Release<S>::writeCellData(uint32_t cell, size_t row) {
  const Plan& plan = core_.plan;
  for (size_t i = 0; i < plan.cell_data.size(); ++i) {
    const Column& c = plan.schema.cell_data[i];
    const int offset = plan.cell_data[i].offset;
    if (plan.cell_data[i].treatment == Treatment::kPicked)
      storeRow(core_.window.cellPicks(cell) + offset, c.type, c.components,
               batch_.cellData(i, row));
    else
      storeRow(core_.window.cellMeans(cell) + 1 + offset, c.type, c.components,
               batch_.cellData(i, row));
  }
}

template <class S>
void Release<S>::writeCell(uint32_t cell) {
  Topology& mesh = core_.window.mesh;
  const uint32_t* v = mesh.corners(cell);
  for (int j = 0; j < 4; ++j)
    if (!(mesh.vertexFlags(v[j]) & kWritten)) {
      writeVertex(v[j]);
      if (core_.tracer) core_.tracer->writeVertex(v[j], j, cells_);
    }
  if (core_.tracer) core_.tracer->writeCell(cell, cells_);
  const size_t row = batch_.addCells(1);
  for (int j = 0; j < 4; ++j) {
    batch_.cell(row)[j] = static_cast<int64_t>(core_.window.outRank(v[j]));
    if (--core_.window.scratch()[v[j]] == 0) batch_.lastUses(row) |= static_cast<uint8_t>(1 << j);
  }
  writeCellData(cell, row);
  double corners[4][3];
  cornersIn(core_.window, cell, corners);
  const double volume = std::fabs(sixVolume(corners)) / 6;
  volume_ += volume;
  if (core_.error_sample) core_.error_sample->leave(cell);
  if (!core_.region_picks.empty())
    core_.label_volumes.add(core_.cellLabels(), cell, volume, LabelVolumes::kOutput);
  if (core_.window.faces.anyPlaced()) writeFaces(cell);
  mesh.kill(cell);
  ++cells_;
  if (batch_.cellCount() == kBatchCells) flush();
}

template <class S>
void Release<S>::writeFaces(uint32_t cell) {
  for (uint32_t j = 0; j < 4; ++j) {
    const int64_t* label = core_.window.faces.labelOf(4 * cell + j);
    if (!label) continue;
    const StarCell outwards = core_.window.mesh.starCell(4 * cell + j);
    int64_t corners[3];
    for (int k = 0; k < 3; ++k)
      corners[k] = static_cast<int64_t>(core_.window.outRank(outwards.t[k]));
    batch_.addFace(corners, *label);
  }
  core_.window.faces.forgetCell(cell);
}

template <class S>
void Release<S>::flush() {
  if (!batch_.empty()) out_.put(batch_.view());
  batch_.clear(vertices_);
}

// The error at which the dearest of its edges would be collapsed; infinite if none of them may be.
template <class S>
float Release<S>::errorOf(uint32_t cell) const {
  const Window<S>& window = core_.window;
  const VertexTable<S> table = core_.tableOf(window);
  const uint32_t* v = window.mesh.corners(cell);
  uint32_t free[4];
  int count = 0;
  for (int j = 0; j < 4; ++j)
    if (window.isFree(v[j])) free[count++] = v[j];
  S dearest = 0, errors[kEdgeLanes];
  for (int j = 0; j + 1 < count; ++j) {
    const int others = count - j - 1;
    core_.kernels.edgeErrors(table, free[j], free + j + 1, others, core_.scale.data(),
                             core_.plan.dimension, errors);
    for (int k = 0; k < others; ++k) dearest = std::max(dearest, errors[k]);
  }
  // note: written so that NaN counts as infinite.
  const S most = std::numeric_limits<float>::max();
  return count > 1 && dearest <= most ? static_cast<float>(dearest)
                                      : std::numeric_limits<float>::infinity();
}

template <class S>
void Release<S>::writeDearest(const Staying& most) {
  const Topology& mesh = core_.window.mesh;
  if (ranked_.size() < mesh.cellEnd()) ranked_.resize(mesh.cellCapacity());
  RankedCell* end = ranked_.data();
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c)
    if (mesh.isLive(c) && mayGo(c)) *end++ = {errorOf(c), c};
  std::sort(ranked_.data(), end);
  for (const RankedCell* r = ranked_.data(); r != end && mustGo(most); ++r) writeCell(r->cell);
}

template <class S>
void Release<S>::write(const Staying& most) {
  const Topology& mesh = core_.window.mesh;
  countUses();
  if (core_.tracer && mustGo(most)) core_.tracer->bringHome(core_.window.scratch());
  if (core_.error_sample) core_.error_sample->startLeaving(most.cells == 0);
  if (core_.options.release == ReleaseOrder::kError) writeDearest(most);
  for (uint32_t c = 0; c < mesh.cellEnd() && mustGo(most); ++c)
    if (mesh.isLive(c) && mayGo(c)) writeCell(c);
  if (core_.error_sample) core_.error_sample->endLeaving();
  pack();
}

template <class S>
void Release<S>::pack() {
  core_.report.unused_vertices +=
      static_cast<int64_t>(core_.window.pack(core_.front, core_.tasks()));
}

template <class S>
void Release<S>::parkCell(uint32_t cell) {
  Topology& mesh = core_.window.mesh;
  for (int j = 0; j < 4; ++j) {
    const uint32_t v = mesh.corners(cell)[j];
    mesh.flagVertex(v, kWritten);
    --core_.window.scratch()[v];
  }
  mesh.park(cell);
}

// What is between parked cells and others: these may change from now on, and nothing tells it. The
// others stay as they were settled, with the cells round them.
template <class S>
void Release<S>::outdateSeam() {
  for (uint32_t v = 0; v < core_.window.mesh.vertexEnd(); ++v)
    if ((core_.window.mesh.vertexFlags(v) & kWritten) && core_.window.scratch()[v] > 0)
      startUnsettled(core_.window, v, core_.options.renews);
}

template <class S>
void Release<S>::park(uint32_t most) {
  const Topology& mesh = core_.window.mesh;
  countUses();
  for (uint32_t c = 0; c < mesh.cellEnd() && mesh.liveCells() > most; ++c)
    if (mesh.isLive(c) && mayGo(c)) parkCell(c);
  outdateSeam();
  pack();
}

template <class S>
void Release<S>::takeBack() {
  core_.window.mesh.takeBack(kWritten);
}

template class Release<float>;
template class Release<double>;

}  // namespace tetstream
