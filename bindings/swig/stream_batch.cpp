#include "stream_batch.h"

#include "failure.h"

namespace tetstream::swig {

// ---------------------------------------------------------------------------- from the library

namespace {

template <class T>
constexpr int32_t kTypeOf = 0;
template <>
constexpr int32_t kTypeOf<int64_t> = TETSTREAM_TYPE_INT64;
template <>
constexpr int32_t kTypeOf<uint8_t> = kBytes;

template <class T>
ArrayView viewOf(const T* data, int64_t rows, int32_t columns = 1) {
  return {data, kTypeOf<T>, rows, columns};
}

}  // namespace

StreamBatch::StreamBatch(const tetstream_batch& batch, const StreamInfo& info)
    : positions_{batch.positions, info.position_type, batch.vertex_count, 3},
      locked_(viewOf(batch.locked, batch.vertex_count)),
      cells_(viewOf(batch.cells, batch.cell_count, 4)),
      last_uses_(viewOf(batch.last_uses, batch.cell_count)),
      finalized_(viewOf(batch.finalized, batch.finalized_count)),
      faces_(viewOf(batch.faces, batch.face_count, 3)),
      face_labels_(viewOf(batch.face_labels, batch.face_count)),
      locked_faces_(viewOf(batch.locked_faces, batch.face_count)),
      locked_edges_(viewOf(batch.locked_edges, batch.locked_edge_count, 2)) {
  for (int32_t i = 0; i < info.fieldCount(); ++i)
    fields_.push_back({batch.fields ? batch.fields[i] : nullptr, info.fieldType(i),
                       batch.vertex_count, info.fieldComponents(i)});
  for (int32_t i = 0; i < info.cellDataCount(); ++i)
    cell_data_.push_back({batch.cell_data ? batch.cell_data[i] : nullptr, info.cellDataType(i),
                          batch.cell_count, info.cellDataComponents(i)});
}

static ArrayView viewAt(const std::vector<ArrayView>& views, int32_t index) {
  if (index < 0 || static_cast<size_t>(index) >= views.size())
    failArgument("a batch has no array " + std::to_string(index));
  return views[static_cast<size_t>(index)];
}

ArrayView StreamBatch::field(int32_t index) const {
  return viewAt(fields_, index);
}

ArrayView StreamBatch::cellData(int32_t index) const {
  return viewAt(cell_data_, index);
}

// ------------------------------------------------------------------------------ to the library

void StreamBatch::clear() {
  *this = StreamBatch();
}

static const char* nameOfType(int32_t type) {
  switch (type) {
    case TETSTREAM_TYPE_FLOAT32:
      return "float32";
    case TETSTREAM_TYPE_FLOAT64:
      return "float64";
    case TETSTREAM_TYPE_INT32:
      return "int32";
    case TETSTREAM_TYPE_INT64:
      return "int64";
    case kBytes:
      return "uint8";
    default:
      return "no type that is known";
  }
}

// The array that is wanted; `rows` below 0: any number. Missing arrays have no rows.
static const void* need(const ArrayView& view, const std::string& what, int32_t type, int64_t rows,
                        int32_t columns) {
  if (!view.data) {
    if (rows > 0) failArgument(what + ": missing, " + std::to_string(rows) + " rows are wanted");
    return nullptr;
  }
  if (view.type != type)
    failArgument(what + ": its numbers are " + nameOfType(view.type) + ", " + nameOfType(type) +
                 " was announced");
  if (view.columns != columns)
    failArgument(what + ": " + std::to_string(view.columns) + " numbers in a row, " +
                 std::to_string(columns) + " are wanted");
  if (rows >= 0 && view.rows != rows)
    failArgument(what + ": " + std::to_string(view.rows) + " rows, " + std::to_string(rows) +
                 " are wanted");
  return view.data;
}

// One pointer for each announced array.
static const void* const* needColumns(const std::vector<ArrayView>& views,
                                      std::vector<const void*>& pointers, int64_t rows,
                                      int32_t count, const char* kind,
                                      const tetstream_column* columns) {
  const auto wanted = static_cast<size_t>(count);
  if (views.size() != wanted && (rows > 0 || !views.empty()))
    failArgument(std::to_string(views.size()) + " " + kind + "s in a batch, " +
                 std::to_string(count) + " were announced");
  pointers.clear();
  for (size_t i = 0; i < views.size(); ++i)
    pointers.push_back(need(views[i], std::string(kind) + " \"" + columns[i].name + "\"",
                            columns[i].type, rows, columns[i].components));
  return pointers.empty() ? nullptr : pointers.data();
}

static const uint8_t* needFlags(const ArrayView& view, const char* what, int64_t rows) {
  return view.data ? static_cast<const uint8_t*>(need(view, what, kBytes, rows, 1)) : nullptr;
}

static const int64_t* needIds(const ArrayView& view, const char* what, int64_t rows,
                              int32_t columns) {
  return static_cast<const int64_t*>(need(view, what, TETSTREAM_TYPE_INT64, rows, columns));
}

tetstream_batch StreamBatch::batch(const StreamInfo& info, int32_t cell_type) {
  const tetstream_stream_info announced = info.info();
  tetstream_batch out = {};
  out.struct_size = sizeof out;
  out.vertex_count = positions_.rows;
  out.positions = need(positions_, "points", info.position_type, -1, 3);
  out.fields = needColumns(fields_, field_pointers_, positions_.rows, info.fieldCount(), "field",
                           announced.fields);
  out.locked = needFlags(locked_, "locked", positions_.rows);
  out.cell_count = cells_.rows;
  const void* const cells = need(cells_, "cells", cell_type, -1, 4);
  if (cell_type == TETSTREAM_TYPE_INT32)
    out.cells32 = static_cast<const int32_t*>(cells);
  else
    out.cells = static_cast<const int64_t*>(cells);
  out.last_uses = needFlags(last_uses_, "last_uses", cells_.rows);
  out.cell_data = needColumns(cell_data_, cell_data_pointers_, cells_.rows, info.cellDataCount(),
                              "cell array", announced.cell_data);
  out.finalized_count = finalized_.rows;
  out.finalized = needIds(finalized_, "finalized", -1, 1);
  out.face_count = faces_.rows;
  out.faces = needIds(faces_, "faces", -1, 3);
  out.face_labels = needIds(face_labels_, "face_labels", faces_.rows, 1);
  out.locked_faces = needFlags(locked_faces_, "locked_faces", faces_.rows);
  out.locked_edge_count = locked_edges_.rows;
  out.locked_edges = needIds(locked_edges_, "locked_edges", -1, 2);
  return out;
}

}  // namespace tetstream::swig
