#include "release.h"

#include <cstring>

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
void Release<S>::countUses() {
  const Topology& mesh = core_.window.mesh;
  uint32_t* const uses = core_.window.scratch();
  std::memset(uses, 0, mesh.vertexEnd() * sizeof(uint32_t));
  front_ = 0;
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c) {
    if (!mesh.isLive(c)) continue;
    for (int j = 0; j < 4; ++j) ++uses[mesh.corners(c)[j]];
    front_ += !mayGo(c);
  }
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
    if (!(mesh.vertexFlags(v[j]) & kWritten)) writeVertex(v[j]);
  const size_t row = batch_.addCells(1);
  for (int j = 0; j < 4; ++j) {
    batch_.cell(row)[j] = static_cast<int64_t>(core_.window.outRank(v[j]));
    if (--core_.window.scratch()[v[j]] == 0) batch_.lastUses(row) |= static_cast<uint8_t>(1 << j);
  }
  writeCellData(cell, row);
  if (core_.window.faces.anyPlaced()) writeFaces(cell);
  mesh.kill(cell);
  ++cells_;
  if (batch_.cellCount() == kBatchCells) flush();
}

template <class S>
void Release<S>::writeFaces(uint32_t cell) {
  const uint32_t* v = core_.window.mesh.corners(cell);
  for (uint32_t j = 0; j < 4; ++j) {
    const int64_t* label = core_.window.faces.labelOf(4 * cell + j);
    if (!label) continue;
    int64_t corners[3];
    for (int k = 0; k < 3; ++k)
      corners[k] = static_cast<int64_t>(core_.window.outRank(v[kOpposite[j][k]]));
    batch_.addFace(corners, *label);
  }
  core_.window.faces.forgetCell(cell);
}

template <class S>
void Release<S>::flush() {
  if (!batch_.empty()) out_.put(batch_.view());
  batch_.clear(vertices_);
}

template <class S>
void Release<S>::write(uint32_t keep) {
  const Topology& mesh = core_.window.mesh;
  countUses();
  for (uint32_t c = 0; c < mesh.cellEnd() && mesh.liveCells() > keep; ++c)
    if (mesh.isLive(c) && mayGo(c)) writeCell(c);
  core_.report.unused_vertices += static_cast<int64_t>(core_.window.pack(core_.front));
}

template class Release<float>;
template class Release<double>;

}  // namespace tetstream
