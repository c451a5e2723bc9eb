#include "mesh_collector.h"

#include <algorithm>

#include "failure.h"

namespace tetstream::swig {

// ------------------------------------------------------------------------------------- the mesh

MeshCollector::MeshCollector(int32_t cell_type)
    : cell_type_(cell_type),
      cells_(cell_type, 4),
      locked_(kBytes, 1),
      faces_(TETSTREAM_TYPE_INT64, 3),
      face_labels_(TETSTREAM_TYPE_INT64, 1),
      locked_faces_(kBytes, 1),
      locked_edges_(TETSTREAM_TYPE_INT64, 2) {
  if (cell_type != TETSTREAM_TYPE_INT32 && cell_type != TETSTREAM_TYPE_INT64)
    failArgument("cells: int32 or int64 is wanted");
}

void MeshCollector::needWhole() const {
  if (!info_) throw Failure(TETSTREAM_BAD_STATE, "no stream has been collected");
  if (!is_whole_)
    throw Failure(TETSTREAM_BAD_STATE,
                  "the stream is not complete: its run is not over, or has failed");
}

const StreamInfo& MeshCollector::info() const {
  needWhole();
  return *info_;
}

static OwnedArray& arrayAt(std::vector<OwnedArray>& arrays, int32_t index) {
  if (index < 0 || static_cast<size_t>(index) >= arrays.size())
    failArgument("there is no array " + std::to_string(index));
  return arrays[static_cast<size_t>(index)];
}

OwnedArray& MeshCollector::field(int32_t index) {
  return arrayAt(whole(fields_), index);
}

OwnedArray& MeshCollector::cellData(int32_t index) {
  return arrayAt(whole(cell_data_), index);
}

void MeshCollector::open(const tetstream_stream_info& info) {
  info_ = std::make_unique<StreamInfo>(info);
  positions_ = OwnedArray(info.position_type, 3);
  for (int32_t i = 0; i < info.field_count; ++i)
    fields_.emplace_back(info.fields[i].type, info.fields[i].components);
  for (int32_t i = 0; i < info.cell_data_count; ++i)
    cell_data_.emplace_back(info.cell_data[i].type, info.cell_data[i].components);
}

// Flags begin with the first row that has any; those before were 0.
static void appendFlags(OwnedArray& flags, const uint8_t* rows, int64_t count, int64_t before) {
  const bool any = rows && std::any_of(rows, rows + count, [](uint8_t flag) { return flag != 0; });
  if (!any && flags.rows() == 0) return;
  flags.appendZeros(before - flags.rows());
  if (rows)
    flags.append(rows, count);
  else
    flags.appendZeros(count);
}

void MeshCollector::putCells(const tetstream_batch& batch) {
  if (cell_type_ == TETSTREAM_TYPE_INT32 && positions_.rows() > INT32_MAX)
    failArgument("cells: int32 does not hold the numbers of more than 2147483647 points");
  if (cell_type_ == TETSTREAM_TYPE_INT32)
    cells_.appendNarrowed(batch.cells, batch.cell_count);
  else
    cells_.append(batch.cells, batch.cell_count);
}

void MeshCollector::put(const tetstream_batch& batch) {
  appendFlags(locked_, batch.locked, batch.vertex_count, positions_.rows());
  positions_.append(batch.positions, batch.vertex_count);
  for (size_t i = 0; i < fields_.size() && batch.vertex_count > 0; ++i)
    fields_[i].append(batch.fields[i], batch.vertex_count);
  putCells(batch);
  for (size_t i = 0; i < cell_data_.size() && batch.cell_count > 0; ++i)
    cell_data_[i].append(batch.cell_data[i], batch.cell_count);
  appendFlags(locked_faces_, batch.locked_faces, batch.face_count, faces_.rows());
  faces_.append(batch.faces, batch.face_count);
  face_labels_.append(batch.face_labels, batch.face_count);
  locked_edges_.append(batch.locked_edges, batch.locked_edge_count);
}

tetstream_writer_callbacks MeshCollector::callbacks() {
  tetstream_writer_callbacks out = {};
  out.struct_size = sizeof out;
  out.user = this;
  out.open = [](void* user, const tetstream_stream_info* info) {
    return inCallback([&] { static_cast<MeshCollector*>(user)->open(*info); });
  };
  out.put = [](void* user, const tetstream_batch* batch) {
    return inCallback([&] { static_cast<MeshCollector*>(user)->put(*batch); });
  };
  out.finish = [](void* user) {
    static_cast<MeshCollector*>(user)->is_whole_ = true;
    return 0;
  };
  return out;
}

// -------------------------------------------------------------------------------------- the map

MapCollector::MapCollector(int64_t vertices)
    : cells_(TETSTREAM_TYPE_INT64, 1), weights_(TETSTREAM_TYPE_FLOAT64, 4) {
  cells_.appendZeros(vertices);
  weights_.appendZeros(vertices);
  auto* const cells = static_cast<int64_t*>(cells_.data());
  std::fill(cells, cells + cells_.rows(), -1);
}

void MapCollector::put(const tetstream_map_rows& rows) {
  auto* const cells = static_cast<int64_t*>(cells_.data());
  auto* const weights = static_cast<double*>(weights_.data());
  for (int64_t i = 0; i < rows.count; ++i) {
    const int64_t vertex = rows.vertices[i];
    if (vertex < 0 || vertex >= cells_.rows())
      throw Failure(TETSTREAM_INTERNAL,
                    "the map tells of vertex " + std::to_string(vertex) + ", which is not there");
    cells[vertex] = rows.cells[i];
    std::copy(rows.weights + 4 * i, rows.weights + 4 * i + 4, weights + 4 * vertex);
  }
}

tetstream_map_callbacks MapCollector::callbacks() {
  tetstream_map_callbacks out = {};
  out.struct_size = sizeof out;
  out.user = this;
  out.put = [](void* user, const tetstream_map_rows* rows) {
    return inCallback([&] { static_cast<MapCollector*>(user)->put(*rows); });
  };
  return out;
}

}  // namespace tetstream::swig
