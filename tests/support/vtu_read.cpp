#include "vtu_read.h"

#include <algorithm>

#include "status.h"

namespace tetstream::test {

static bool same(const std::vector<Column>& a, const std::vector<Column>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Column& x, const Column& y) {
    return x.name == y.name && x.components == y.components && x.type == y.type;
  });
}

bool VtuMesh::operator==(const VtuMesh& other) const {
  return schema.position_type == other.schema.position_type && schema.time == other.schema.time &&
         same(schema.fields, other.schema.fields) &&
         same(schema.cell_data, other.schema.cell_data) && positions == other.positions &&
         cells == other.cells && fields == other.fields && cell_data == other.cell_data &&
         faces == other.faces && face_labels == other.face_labels;
}

template <class Read>
static std::string readRows(int64_t count, size_t row_bytes, size_t step, Read read) {
  std::string bytes;
  const uint64_t total = static_cast<uint64_t>(count);
  for (uint64_t at = 0; at < total; at += step) {
    const size_t n = static_cast<size_t>(std::min<uint64_t>(step, total - at));
    bytes.resize(bytes.size() + n * row_bytes);
    read(at, n, bytes.data() + bytes.size() - n * row_bytes);
  }
  return bytes;
}

VtuMesh readMesh(std::unique_ptr<ByteSource> bytes, const Format& format, size_t step,
                 ReadOptions options) {
  VtuMesh mesh;
  options.note = [&](const std::string& text) { mesh.notes.push_back(text); };
  const Input input = format.open(std::move(bytes), options);
  IndexedSource& source = *input.indexed;
  const Schema& s = mesh.schema = source.schema();
  mesh.positions =
      readRows(s.vertex_count, 3 * sizeOf(s.position_type), step,
               [&](uint64_t i, size_t n, void* to) { source.readPositions(i, n, to); });
  for (size_t c = 0; c < s.fields.size(); ++c)
    mesh.fields.push_back(
        readRows(s.vertex_count, s.fields[c].bytesPerRow(), step,
                 [&](uint64_t i, size_t n, void* to) { source.readField(c, i, n, to); }));
  mesh.cells =
      valuesAs<int64_t>(readRows(s.cell_count, 32, step, [&](uint64_t i, size_t n, char* to) {
        std::vector<int64_t> ids(4 * n);
        source.readCells(i, n, ids.data());
        std::copy_n(reinterpret_cast<const char*>(ids.data()), 32 * n, to);
      }));
  for (size_t c = 0; c < s.cell_data.size(); ++c)
    mesh.cell_data.push_back(
        readRows(s.cell_count, s.cell_data[c].bytesPerRow(), step,
                 [&](uint64_t i, size_t n, void* to) { source.readCellData(c, i, n, to); }));
  for (uint64_t at = 0, all = static_cast<uint64_t>(s.face_count); at < all; at += step) {
    const size_t n = static_cast<size_t>(std::min<uint64_t>(step, all - at));
    mesh.faces.resize(3 * (at + n));
    mesh.face_labels.resize(at + n);
    source.readFaces(at, n, mesh.faces.data() + 3 * at, mesh.face_labels.data() + at);
  }
  return mesh;
}

VtuMesh readAs(const char* format, const std::string& file, size_t step,
               const ReadOptions& options) {
  return readMesh(openMemory(file.data(), file.size(), std::string("test.") + format),
                  *findFormat(format), step, options);
}

VtuMesh readVtu(const std::string& file, size_t step, const ReadOptions& options) {
  return readAs("vtu", file, step, options);
}

std::string failureAs(const char* format, const std::string& file) {
  try {
    readAs(format, file);
  } catch (const Error& error) {
    return statusName(error.status()) + (": " + error.text());
  }
  return "";
}

std::string vtuFailure(const std::string& file) {
  return failureAs("vtu", file);
}

std::string writtenBy(Sink& sink, std::vector<unsigned char>& out, const VtuMesh& mesh) {
  sink.begin(mesh.schema);
  BatchView batch;
  batch.vertex_count = static_cast<size_t>(mesh.schema.vertex_count);
  batch.cell_count = static_cast<size_t>(mesh.schema.cell_count);
  batch.positions = mesh.positions.data();
  batch.cells = mesh.cells.data();
  std::vector<const void*> fields, cell_data;
  for (const std::string& column : mesh.fields) fields.push_back(column.data());
  for (const std::string& column : mesh.cell_data) cell_data.push_back(column.data());
  batch.fields = fields.data();
  batch.cell_data = cell_data.data();
  batch.face_count = mesh.face_labels.size();
  batch.faces = mesh.faces.data();
  batch.face_labels = mesh.face_labels.data();
  sink.put(batch);
  sink.finish();
  return std::string(out.begin(), out.end());
}

std::string writtenAs(const char* format, const VtuMesh& mesh, bool compress) {
  std::vector<unsigned char> out;
  WriteOptions options;
  options.compress = compress;
  return writtenBy(*findFormat(format)->create(createMemory(out), options), out, mesh);
}

}  // namespace tetstream::test
