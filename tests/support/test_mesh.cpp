#include "test_mesh.h"

#include <algorithm>
#include <numeric>

#include "random.h"

namespace tetstream::test {

// ------------------------------------------------------------------------------------- values

static double valueAt(const Rows& rows, ScalarType type, size_t index) {
  double value;
  convertScalars(rows.bytes.data() + index * sizeOf(type), type, &value, ScalarType::kFloat64, 1);
  return value;
}

static int64_t integerAt(const Rows& rows, ScalarType type, size_t index) {
  int64_t value;
  convertScalars(rows.bytes.data() + index * sizeOf(type), type, &value, ScalarType::kInt64, 1);
  return value;
}

static void appendValue(Rows& rows, ScalarType type, double value) {
  unsigned char bytes[8];
  convertScalars(&value, ScalarType::kFloat64, bytes, type, 1);
  rows.append(bytes, 1, sizeOf(type));
}

static size_t indexOf(const Column& column, size_t row, int component) {
  return row * static_cast<size_t>(column.components) + static_cast<size_t>(component);
}

double TestMesh::position(size_t vertex, int axis) const {
  return valueAt(positions, schema.position_type, 3 * vertex + static_cast<size_t>(axis));
}

double TestMesh::field(size_t column, size_t vertex, int component) const {
  const Column& c = schema.fields[column];
  return valueAt(fields[column], c.type, indexOf(c, vertex, component));
}

double TestMesh::cellValue(size_t column, size_t cell, int component) const {
  const Column& c = schema.cell_data[column];
  return valueAt(cell_data[column], c.type, indexOf(c, cell, component));
}

int64_t TestMesh::fieldInteger(size_t column, size_t vertex) const {
  return integerAt(fields[column], schema.fields[column].type, vertex);
}

int64_t TestMesh::cellInteger(size_t column, size_t cell) const {
  return integerAt(cell_data[column], schema.cell_data[column].type, cell);
}

void TestMesh::setPosition(size_t vertex, int axis, double value) {
  const ScalarType type = schema.position_type;
  const size_t index = 3 * vertex + static_cast<size_t>(axis);
  convertScalars(&value, ScalarType::kFloat64, positions.bytes.data() + index * sizeOf(type), type,
                 1);
}

void TestMesh::setField(size_t column, size_t vertex, double value, int component) {
  const Column& c = schema.fields[column];
  convertScalars(&value, ScalarType::kFloat64,
                 fields[column].bytes.data() + indexOf(c, vertex, component) * sizeOf(c.type),
                 c.type, 1);
}

static Rows makeRows(const Column& column, size_t count, const TestMesh::Function& function) {
  Rows rows;
  for (size_t row = 0; row < count; ++row)
    for (int i = 0; i < column.components; ++i) appendValue(rows, column.type, function(row, i));
  return rows;
}

void TestMesh::addField(const Column& column, const Function& function) {
  schema.fields.push_back(column);
  fields.push_back(makeRows(column, vertexCount(), function));
}

void TestMesh::addCellData(const Column& column, const Function& function) {
  schema.cell_data.push_back(column);
  cell_data.push_back(makeRows(column, cellCount(), function));
}

void TestMesh::addIntegerField(const std::string& name,
                               const std::function<int64_t(size_t)>& function) {
  schema.fields.push_back({name, 1, ScalarType::kInt64});
  fields.emplace_back();
  for (size_t row = 0; row < vertexCount(); ++row) {
    const int64_t value = function(row);
    fields.back().append(&value, 1, sizeof value);
  }
}

void TestMesh::addIntegerCellData(const std::string& name,
                                  const std::function<int64_t(size_t)>& function) {
  schema.cell_data.push_back({name, 1, ScalarType::kInt64});
  cell_data.emplace_back();
  for (size_t row = 0; row < cellCount(); ++row) {
    const int64_t value = function(row);
    cell_data.back().append(&value, 1, sizeof value);
  }
}

BatchView TestMesh::view() {
  field_pointers_.clear();
  cell_pointers_.clear();
  for (const Rows& rows : fields) field_pointers_.push_back(rows.bytes.data());
  for (const Rows& rows : cell_data) cell_pointers_.push_back(rows.bytes.data());
  BatchView v;
  v.vertex_count = vertexCount();
  v.positions = positions.bytes.data();
  v.fields = field_pointers_.data();
  v.locked = locked.empty() ? nullptr : locked.data();
  v.cell_count = cellCount();
  v.cells = cells.data();
  v.cell_data = cell_pointers_.data();
  return v;
}

TestMesh makeMesh(ScalarType position_type, const std::vector<double>& positions,
                  const std::vector<int64_t>& cells) {
  TestMesh mesh;
  mesh.schema.position_type = position_type;
  for (double x : positions) appendValue(mesh.positions, position_type, x);
  mesh.cells = cells;
  return mesh;
}

// -------------------------------------------------------------------------------------- order

// The mesh of the given old vertices and old cells, in that order.
static TestMesh reordered(const TestMesh& mesh, const std::vector<size_t>& vertices,
                          const std::vector<size_t>& cells) {
  TestMesh out;
  out.schema = mesh.schema;
  out.fields.resize(mesh.fields.size());
  out.cell_data.resize(mesh.cell_data.size());
  std::vector<int64_t> new_id(mesh.vertexCount(), -1);
  const auto copy = [](const Rows& from, size_t row, size_t bytes, Rows& to) {
    to.append(from.bytes.data() + row * bytes, 1, bytes);
  };
  for (size_t v : vertices) {
    new_id[v] = static_cast<int64_t>(out.vertexCount());
    copy(mesh.positions, v, 3 * sizeOf(mesh.schema.position_type), out.positions);
    for (size_t f = 0; f < mesh.fields.size(); ++f)
      copy(mesh.fields[f], v, mesh.schema.fields[f].bytesPerRow(), out.fields[f]);
    if (!mesh.locked.empty()) out.locked.push_back(mesh.locked[v]);
  }
  for (size_t c : cells) {
    for (size_t j = 0; j < 4; ++j)
      out.cells.push_back(new_id[static_cast<size_t>(mesh.cells[4 * c + j])]);
    for (size_t k = 0; k < mesh.cell_data.size(); ++k)
      copy(mesh.cell_data[k], c, mesh.schema.cell_data[k].bytesPerRow(), out.cell_data[k]);
  }
  return out;
}

static std::vector<size_t> countUp(size_t count) {
  std::vector<size_t> all(count);
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

TestMesh inStreamOrder(const TestMesh& mesh, bool keep_unused) {
  std::vector<bool> seen(mesh.vertexCount(), false);
  std::vector<size_t> order;
  for (int64_t v : mesh.cells)
    if (!seen[static_cast<size_t>(v)]) {
      seen[static_cast<size_t>(v)] = true;
      order.push_back(static_cast<size_t>(v));
    }
  for (size_t v = 0; keep_unused && v < seen.size(); ++v)
    if (!seen[v]) order.push_back(v);
  return reordered(mesh, order, countUp(mesh.cellCount()));
}

TestMesh shuffled(const TestMesh& mesh, uint64_t seed) {
  Random random(seed);
  const auto shuffle = [&random](std::vector<size_t>& list) {
    for (size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[random.below(static_cast<uint32_t>(i))]);
  };
  std::vector<size_t> vertices = countUp(mesh.vertexCount()), cells = countUp(mesh.cellCount());
  shuffle(vertices);
  shuffle(cells);
  TestMesh out = reordered(mesh, vertices, cells);
  for (size_t c = 0; c < out.cellCount(); ++c) {
    const size_t turn = 1 + random.below(3);  // cycles of three corners are even
    std::rotate(&out.cells[4 * c], &out.cells[4 * c] + turn % 3, &out.cells[4 * c] + 3);
  }
  return out;
}

// ------------------------------------------------------------------------------------- stream

MeshStream::MeshStream(const TestMesh& mesh, const Cut& cut)
    : mesh_(mesh),
      cut_(cut),
      schema_(mesh.schema),
      batch_(schema_),
      last_use_(mesh.vertexCount(), 0) {
  for (size_t i = 0; i < mesh.cells.size(); ++i)
    last_use_[static_cast<size_t>(mesh.cells[i])] = i / 4;
  if (cut.say_counts) {
    schema_.vertex_count = static_cast<int64_t>(mesh.vertexCount());
    schema_.cell_count = static_cast<int64_t>(mesh.cellCount());
  }
  if (cut.say_front) schema_.front_cells = static_cast<int64_t>(mesh.cellCount() / 8 + 1);
  if (!cut.say_box || mesh.vertexCount() == 0) return;
  const auto grow = [&](double value, size_t vertex, size_t place) {
    if (vertex == 0) schema_.box_min.push_back(value), schema_.box_max.push_back(value);
    schema_.box_min[place] = std::min(schema_.box_min[place], value);
    schema_.box_max[place] = std::max(schema_.box_max[place], value);
  };
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    size_t place = 0;
    for (int i = 0; i < 3; ++i) grow(mesh.position(v, i), v, place++);
    for (size_t f = 0; f < mesh.fields.size(); ++f)
      for (int i = 0; i < mesh.schema.fields[f].components; ++i)
        grow(mesh.field(f, v, i), v, place++);
  }
}

void MeshStream::addVerticesUpTo(size_t end) {
  for (; vertex_ < end; ++vertex_) {
    const size_t row = batch_.addVertices(1), bytes = 3 * sizeOf(schema_.position_type);
    std::memcpy(batch_.position(row), mesh_.positions.bytes.data() + vertex_ * bytes, bytes);
    for (size_t f = 0; f < mesh_.fields.size(); ++f) {
      const size_t width = schema_.fields[f].bytesPerRow();
      std::memcpy(batch_.field(f, row), mesh_.fields[f].bytes.data() + vertex_ * width, width);
    }
    if (!mesh_.locked.empty() && mesh_.locked[vertex_]) batch_.lock(row);
  }
}

void MeshStream::addCell(size_t cell) {
  const int64_t* corners = &mesh_.cells[4 * cell];
  const size_t highest = static_cast<size_t>(*std::max_element(corners, corners + 4));
  addVerticesUpTo(std::max(vertex_, highest + 1));
  const size_t row = batch_.addCells(1);
  std::copy_n(corners, 4, batch_.cell(row));
  for (size_t j = 0; j < 4; ++j) {
    if (last_use_[static_cast<size_t>(corners[j])] != cell) continue;
    if (cut_.explicit_final)
      batch_.addFinalized(corners[j]);
    else
      batch_.lastUses(row) |= static_cast<uint8_t>(1u << j);
  }
  for (size_t k = 0; k < mesh_.cell_data.size(); ++k) {
    const size_t width = schema_.cell_data[k].bytesPerRow();
    std::memcpy(batch_.cellData(k, row), mesh_.cell_data[k].bytes.data() + cell * width, width);
  }
}

bool MeshStream::next(BatchView& batch) {
  // Poison what was given before: the arrays of a cleared batch keep their place.
  for (size_t i = 0; i < batch_.cellCount(); ++i) std::fill_n(batch_.cell(i), 4, int64_t{-77});
  for (size_t i = 0; i < batch_.vertexCount(); ++i)
    std::memset(batch_.position(i), 0xff, 3 * sizeOf(schema_.position_type));
  batch_.clear(vertex_);
  if (cut_.empty_batches && !gave_empty_) {
    gave_empty_ = true;
    batch = batch_.view();
    return true;
  }
  gave_empty_ = false;
  if (!started_ && cut_.all_vertices_first) {
    started_ = true;
    addVerticesUpTo(mesh_.vertexCount());
    batch = batch_.view();
    return true;
  }
  while (cell_ < mesh_.cellCount() && batch_.cellCount() < cut_.batch_cells) {
    addCell(cell_++);
    if (cut_.explicit_final && batch_.finalizedCount() > 0) break;
  }
  if (cell_ == mesh_.cellCount()) addVerticesUpTo(mesh_.vertexCount());
  batch = batch_.view();
  return !batch_.empty();
}

// ----------------------------------------------------------------------------------- recorder

void Recorder::begin(const Schema& schema) {
  mesh.schema = schema;
  mesh.fields.resize(schema.fields.size());
  mesh.cell_data.resize(schema.cell_data.size());
}

void Recorder::use(int64_t vertex) {
  const auto cell = static_cast<int64_t>(mesh.cellCount());
  if (vertex < 0 || static_cast<size_t>(vertex) >= mesh.vertexCount())
    return wrong("a cell uses a vertex that was not declared");
  const auto v = static_cast<size_t>(vertex);
  if (final_at_[v] >= 0) return wrong("a cell uses a vertex that is final");
  if (first_use_[v] < 0) first_use_[v] = cell;
  last_use_[v] = cell;
}

void Recorder::takeFaces(const BatchView& batch) {
  for (size_t i = 0; i < batch.face_count; ++i) {
    const int64_t* v = batch.faces + 3 * i;
    Face face = {v[0], v[1], v[2]};
    std::sort(face.begin(), face.end());
    if (face[0] < 0 || static_cast<size_t>(face[2]) >= mesh.vertexCount())
      return wrong("a labelled face has a vertex that was not declared");
    for (int64_t corner : face)
      if (final_at_[static_cast<size_t>(corner)] >= 0)
        wrong("a labelled face has a vertex that was final in a batch before");
    if (!faces.emplace(face, batch.face_labels[i]).second) wrong("a labelled face came twice");
  }
}

void Recorder::put(const BatchView& batch) {
  ++batches;
  if (finished) wrong("a batch came after the end");
  if (batch.first_vertex != mesh.vertexCount()) wrong("a batch does not follow the one before");
  const size_t first = mesh.vertexCount();
  mesh.positions.append(batch.positions, batch.vertex_count, 3 * sizeOf(mesh.schema.position_type));
  for (size_t f = 0; batch.vertex_count && f < mesh.fields.size(); ++f)
    mesh.fields[f].append(batch.fields[f], batch.vertex_count, mesh.schema.fields[f].bytesPerRow());
  for (size_t i = 0; i < batch.vertex_count; ++i)
    mesh.locked.push_back(batch.locked ? batch.locked[i] : 0);
  for (auto* list : {&first_use_, &last_use_, &final_at_}) list->resize(mesh.vertexCount(), -1);
  takeFaces(batch);
  const auto finalize = [this](int64_t v) {
    if (v < 0 || static_cast<size_t>(v) >= mesh.vertexCount())
      return wrong("a vertex is finalized that was not declared");
    if (final_at_[static_cast<size_t>(v)] >= 0) wrong("a vertex is finalized twice");
    final_at_[static_cast<size_t>(v)] = static_cast<int64_t>(mesh.cellCount()) - 1;
  };
  for (size_t i = 0; i < batch.cell_count; ++i) {
    const int64_t* corners = batch.cells + 4 * i;
    for (int j = 0; j < 4; ++j) use(corners[j]);
    mesh.cells.insert(mesh.cells.end(), corners, corners + 4);
    for (int j = 0; j < 4; ++j)
      if (batch.last_uses && batch.last_uses[i] >> j & 1) finalize(corners[j]);
  }
  for (size_t k = 0; batch.cell_count && k < mesh.cell_data.size(); ++k)
    mesh.cell_data[k].append(batch.cell_data[k], batch.cell_count,
                             mesh.schema.cell_data[k].bytesPerRow());
  for (size_t i = 0; i < batch.finalized_count; ++i) finalize(batch.finalized[i]);
  // A batch brings the vertices of its own cells.
  for (size_t v = first; v < mesh.vertexCount(); ++v)
    if (first_use_[v] < 0) compact = false;
}

void Recorder::finish() {
  if (finished) wrong("finished twice");
  finished = true;
  int64_t before = -1;
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    if (final_at_[v] != last_use_[v]) exact_finalization = false;
    if (first_use_[v] < before) compact = false;
    before = std::max(before, first_use_[v]);
  }
}

std::vector<unsigned char> Recorder::allBytes() const {
  std::vector<unsigned char> all;
  const auto add = [&all](const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    if (size) all.insert(all.end(), bytes, bytes + size);
  };
  add(mesh.positions.bytes.data(), mesh.positions.bytes.size());
  for (const Rows& rows : mesh.fields) add(rows.bytes.data(), rows.bytes.size());
  add(mesh.cells.data(), mesh.cells.size() * sizeof(int64_t));
  for (const Rows& rows : mesh.cell_data) add(rows.bytes.data(), rows.bytes.size());
  add(mesh.locked.data(), mesh.locked.size());
  for (const auto& [face, label] : faces) {
    add(face.data(), sizeof face);
    add(&label, sizeof label);
  }
  add(final_at_.data(), final_at_.size() * sizeof(int64_t));
  return all;
}

}  // namespace tetstream::test
