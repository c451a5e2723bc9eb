#include "structs.h"

#include <cmath>
#include <limits>

#include "label_names.h"

namespace tetstream {

static_assert(static_cast<int32_t>(ScalarType::kFloat32) == TETSTREAM_TYPE_FLOAT32);
static_assert(static_cast<int32_t>(ScalarType::kFloat64) == TETSTREAM_TYPE_FLOAT64);
static_assert(static_cast<int32_t>(ScalarType::kInt32) == TETSTREAM_TYPE_INT32);
static_assert(static_cast<int32_t>(ScalarType::kInt64) == TETSTREAM_TYPE_INT64);

// More columns than this are a struct that was not filled in.
static constexpr int32_t kMaxColumns = 65535;
static constexpr int64_t kMaxLabelNames = 1 << 24;

void failStruct(const char* argument, size_t size, size_t needed) {
  fail(Status::kBadArgument, "%s: its struct_size is %zu, at least %zu is needed", argument, size,
       needed);
}

// ------------------------------------------------------------------------------------- schemas

// note: lengths of names are bounded, one without an end is not followed to it.
static std::string boundedName(const char* name) {
  return {name, strnlen(name, kMostNameBytes + 1)};
}

static std::vector<Column> columnsOf(const tetstream_column* columns, int32_t count,
                                     const char* kind) {
  if (count < 0 || count > kMaxColumns)
    fail(Status::kBadArgument, "info: %d is no possible number of %ss", count, kind);
  if (count > 0 && !columns) fail(Status::kBadArgument, "info: the %ss are NULL", kind);
  std::vector<Column> out;
  for (int32_t i = 0; i < count; ++i) {
    if (!columns[i].name) fail(Status::kBadArgument, "info: %s %d: its name is NULL", kind, i);
    out.push_back({boundedName(columns[i].name), columns[i].components,
                   static_cast<ScalarType>(columns[i].type)});
  }
  return out;
}

static std::vector<LabelName> labelNamesOf(const tetstream_stream_info& info) {
  const int64_t count = info.label_name_count;
  if (count < 0 || count > kMaxLabelNames)
    fail(Status::kBadArgument, "info: %lld is no possible number of names of labels",
         static_cast<long long>(count));
  if (count > 0 && !info.label_names)
    fail(Status::kBadArgument, "info: the names of labels are NULL");
  std::vector<LabelName> out;
  for (int64_t i = 0; i < count; ++i) {
    const tetstream_label_name& name = info.label_names[i];
    if (!name.name)
      fail(Status::kBadArgument, "info: name %lld of labels is NULL", static_cast<long long>(i));
    out.push_back(
        {name.cell_array ? boundedName(name.cell_array) : "", name.label, boundedName(name.name)});
  }
  sortLabelNames(out);
  return out;
}

static int64_t knownOrMinusOne(int64_t count) {
  return count > 0 ? count : -1;
}

// A component of a field may have no value that is finite.
static bool isBound(double low, double high, bool may_be_none) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (may_be_none && low == kInfinity && high == -kInfinity) return true;
  return std::isfinite(low) && std::isfinite(high) && low <= high;
}

static void takeBox(const tetstream_stream_info& info, Schema& schema) {
  if (!info.box_min && !info.box_max) return;
  if (!info.box_min || !info.box_max)
    fail(Status::kBadArgument, "info: of box_min and box_max one is NULL");
  const size_t size = schema.boxSize();
  for (size_t i = 0; i < size; ++i)
    if (!isBound(info.box_min[i], info.box_max[i], i >= 3))
      fail(Status::kBadArgument, "info: entry %zu of the box is not finite or upside down", i);
  schema.box_min.assign(info.box_min, info.box_min + size);
  schema.box_max.assign(info.box_max, info.box_max + size);
}

static bool hasPlaceOfTime(const tetstream_stream_info& info) {
  return info.struct_size >= offsetof(tetstream_stream_info, time) + sizeof info.time;
}

void writeStruct(tetstream_stream_info* out, tetstream_stream_info value) {
  if (!hasPlaceOfTime(*out)) value.flags &= ~static_cast<uint32_t>(TETSTREAM_STREAM_TIMED);
  writeStruct<tetstream_stream_info>(out, value);
}

Schema schemaOf(const tetstream_stream_info& info) {
  if (info.flags & ~static_cast<uint32_t>(TETSTREAM_STREAM_INDEXED | TETSTREAM_STREAM_TIMED))
    fail(Status::kBadArgument, "info: the flags 0x%x are not all known", info.flags);
  Schema schema;
  schema.position_type = static_cast<ScalarType>(info.position_type);
  schema.fields = columnsOf(info.fields, info.field_count, "field");
  schema.cell_data = columnsOf(info.cell_data, info.cell_data_count, "cell array");
  schema.label_names = labelNamesOf(info);
  if ((info.flags & TETSTREAM_STREAM_TIMED) && hasPlaceOfTime(info)) schema.time = info.time;
  checkSchema(schema);
  schema.vertex_count = knownOrMinusOne(info.vertex_count);
  schema.cell_count = knownOrMinusOne(info.cell_count);
  schema.face_count = knownOrMinusOne(info.face_count);
  schema.front_width = knownOrMinusOne(info.front_width);
  schema.front_span = knownOrMinusOne(info.front_span);
  schema.front_cells = knownOrMinusOne(info.front_cells);
  takeBox(info, schema);
  return schema;
}

static std::vector<tetstream_column> publicColumns(const std::vector<Column>& columns) {
  std::vector<tetstream_column> out;
  out.reserve(columns.size());
  for (const Column& c : columns)
    out.push_back({c.name.c_str(), c.components, static_cast<int32_t>(c.type)});
  return out;
}

static std::vector<tetstream_label_name> publicLabelNames(const std::vector<LabelName>& names) {
  std::vector<tetstream_label_name> out;
  out.reserve(names.size());
  for (const LabelName& name : names)
    out.push_back(
        {name.name.c_str(), name.array.empty() ? nullptr : name.array.c_str(), name.label});
  return out;
}

PublicSchema::PublicSchema(const Schema& schema, bool indexed)
    : schema_(schema),
      fields_(publicColumns(schema_.fields)),
      cell_data_(publicColumns(schema_.cell_data)),
      label_names_(publicLabelNames(schema_.label_names)) {
  info_.struct_size = sizeof info_;
  info_.position_type = static_cast<int32_t>(schema_.position_type);
  if (indexed) info_.flags |= TETSTREAM_STREAM_INDEXED;
  if (schema_.time) info_.flags |= TETSTREAM_STREAM_TIMED;
  info_.time = schema_.time.value_or(0);
  info_.field_count = static_cast<int32_t>(fields_.size());
  info_.cell_data_count = static_cast<int32_t>(cell_data_.size());
  info_.fields = fields_.empty() ? nullptr : fields_.data();
  info_.cell_data = cell_data_.empty() ? nullptr : cell_data_.data();
  info_.vertex_count = schema_.vertex_count;
  info_.cell_count = schema_.cell_count;
  info_.front_width = schema_.front_width;
  info_.front_span = schema_.front_span;
  info_.front_cells = schema_.front_cells;
  info_.box_min = schema_.hasBox() ? schema_.box_min.data() : nullptr;
  info_.box_max = schema_.hasBox() ? schema_.box_max.data() : nullptr;
  info_.face_count = schema_.face_count;
  info_.label_name_count = static_cast<int64_t>(label_names_.size());
  info_.label_names = label_names_.empty() ? nullptr : label_names_.data();
}

// ------------------------------------------------------------------------------------- batches

namespace {

// The parts of a sentence about one batch.
struct Place {
  unsigned long long batch;
  [[noreturn]] void failNull(const char* what, size_t column) const {
    fail(Status::kBadData, "batch %llu: the pointer to %s %zu is NULL", batch, what, column);
  }
  void need(const void* pointer, const char* what, int64_t count) const {
    if (count > 0 && !pointer)
      fail(Status::kBadData, "batch %llu: %lld %s are announced, their pointer is NULL", batch,
           static_cast<long long>(count), what);
  }
  size_t count(int64_t count, const char* what) const {
    if (count < 0)
      fail(Status::kBadData, "batch %llu: the number of %s is %lld", batch, what,
           static_cast<long long>(count));
    return static_cast<size_t>(count);
  }
};

}  // namespace

static void checkColumns(const void* const* columns, size_t count, int64_t rows, const char* what,
                         const Place& place) {
  if (rows == 0 || count == 0) return;
  if (!columns) place.failNull(what, 0);
  for (size_t i = 0; i < count; ++i)
    if (!columns[i]) place.failNull(what, i);
}

static void checkLastUses(const uint8_t* last_uses, size_t count, const Place& place) {
  if (!last_uses) return;
  for (size_t i = 0; i < count; ++i)
    if (last_uses[i] > 15)
      fail(Status::kBadData, "batch %llu: last_uses of its cell %zu is %d, at most 15 is possible",
           place.batch, i, last_uses[i]);
}

BatchView BatchChecker::view(const tetstream_batch& batch) {
  if (batch.cells32)
    fail(Status::kBadData, "batch %llu: the cells of a stream are in cells, not in cells32",
         static_cast<unsigned long long>(batches_));
  return viewMesh(batch);
}

BatchView BatchChecker::viewMesh(const tetstream_batch& batch) {
  const Place place{batches_};
  BatchView v;
  v.first_vertex = vertices_;
  v.vertex_count = place.count(batch.vertex_count, "vertices");
  v.cell_count = place.count(batch.cell_count, "cells");
  v.finalized_count = place.count(batch.finalized_count, "finalized vertices");
  v.face_count = place.count(batch.face_count, "labelled faces");
  v.edge_count = place.count(batch.locked_edge_count, "locked edges");
  place.need(batch.faces, "labelled faces", batch.face_count);
  place.need(batch.face_labels, "labels of faces", batch.face_count);
  place.need(batch.locked_edges, "locked edges", batch.locked_edge_count);
  place.need(batch.positions, "positions", batch.vertex_count);
  if (!batch.cells32) place.need(batch.cells, "cells", batch.cell_count);
  place.need(batch.finalized, "finalized vertices", batch.finalized_count);
  checkColumns(batch.fields, fields_, batch.vertex_count, "field", place);
  checkColumns(batch.cell_data, cell_data_, batch.cell_count, "cell array", place);
  checkLastUses(batch.last_uses, v.cell_count, place);
  if (batch.vertex_count > INT64_MAX - static_cast<int64_t>(vertices_))
    fail(Status::kBadData, "batch %llu: more vertices than 64 bits can number", place.batch);
  v.positions = batch.positions;
  v.fields = batch.fields;
  v.locked = batch.locked;
  v.cells = batch.cells;
  v.last_uses = batch.last_uses;
  v.cell_data = batch.cell_data;
  v.finalized = batch.finalized;
  v.faces = batch.faces;
  v.face_labels = batch.face_labels;
  v.face_locks = batch.locked_faces;
  v.locked_edges = batch.locked_edges;
  vertices_ += v.vertex_count;
  ++batches_;
  return v;
}

tetstream_batch publicBatch(const BatchView& view) {
  tetstream_batch b = {};
  b.struct_size = sizeof b;
  b.vertex_count = static_cast<int64_t>(view.vertex_count);
  b.positions = view.positions;
  b.fields = view.fields;
  b.locked = view.locked;
  b.cell_count = static_cast<int64_t>(view.cell_count);
  b.cells = view.cells;
  b.last_uses = view.last_uses;
  b.cell_data = view.cell_data;
  b.finalized_count = static_cast<int64_t>(view.finalized_count);
  b.finalized = view.finalized;
  b.face_count = static_cast<int64_t>(view.face_count);
  b.faces = view.faces;
  b.face_labels = view.face_labels;
  b.locked_faces = view.face_locks;
  b.locked_edge_count = static_cast<int64_t>(view.edge_count);
  b.locked_edges = view.locked_edges;
  return b;
}

}  // namespace tetstream
