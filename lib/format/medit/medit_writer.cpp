// Writes MEDIT's meshes, text (.mesh, version 2) or binary (.meshb, versions 1 to 4 as the numbers
// need), and fields as solutions in a file beside.
#include <algorithm>
#include <array>
#include <limits>

#include "label_column.h"
#include "medit_format.h"
#include "medit_keywords.h"
#include "medit_sol.h"
#include "mesh_collector.h"
#include "number_sink.h"
#include "status.h"

namespace tetstream {

namespace {

// A file of sections: text, or binary with the place of the next section at the head of each.
class MeditOut {
 public:
  MeditOut(ByteSink& bytes, bool binary, int version) : out_(bytes, binary), version_(version) {
    if (!binary) {
      out_.text("MeshVersionFormatted " + std::to_string(version) + "\n\nDimension 3\n");
      return;
    }
    out_.integer<int32_t>(1);
    out_.integer<int32_t>(version);
    out_.integer<int32_t>(kMeditDimension);
    place(out_.written() + placeBytes() + 4);
    out_.integer<int32_t>(3);
  }

  // `row_bytes` is that of a row in binary, `more` what stands between the count and the rows.
  void begin(int keyword, uint64_t rows, uint64_t row_bytes, uint64_t more = 0) {
    if (out_.binary()) {
      out_.integer<int32_t>(keyword);
      place(out_.written() + placeBytes() + integerBytes() + more + rows * row_bytes);
    } else {
      out_.text("\n");
      out_.text(meditKeyword(int64_t{keyword})->name);
      out_.text("\n");
    }
    integer(static_cast<int64_t>(rows));
    out_.endRow();
  }
  void integer(int64_t value) {
    version_ == 4 ? out_.integer<int64_t>(value) : out_.integer<int32_t>(value);
  }
  void small(int64_t value) { out_.integer<int32_t>(value); }
  void real(const unsigned char* value, ScalarType type) {
    if (version_ == 1 && out_.binary()) {
      float narrow;
      convertScalars(value, type, &narrow, ScalarType::kFloat32, 1);
      return out_.real(narrow);
    }
    out_.real(value, type);
  }
  void endRow() { out_.endRow(); }
  void end() {
    if (out_.binary()) {
      out_.integer<int32_t>(kMeditEnd);
      place(0);
    } else {
      out_.text("\nEnd\n");
    }
    out_.flush();
  }
  uint64_t integerBytes() const { return version_ == 4 ? 8 : 4; }
  uint64_t realBytes() const { return version_ == 1 ? 4 : 8; }

 private:
  uint64_t placeBytes() const { return version_ >= 3 ? 8 : 4; }
  void place(uint64_t place) {
    const auto value = static_cast<int64_t>(place);
    version_ >= 3 ? out_.integer<int64_t>(value) : out_.integer<int32_t>(value);
  }

  NumberSink out_;
  int version_;
};

// The component at each place of a symmetric matrix in the file.
constexpr auto kSymmetricOf = [] {
  std::array<int, 6> components{};
  for (int k = 0; k < 6; ++k) components[static_cast<size_t>(kMeditSymmetric[k])] = k;
  return components;
}();

// A part of a column as MEDIT has it: scalars, vectors, symmetric and full matrices.
struct Solution {
  size_t column;
  int first, components, type;
};

class MeditWriter final : public MeshCollector {
 public:
  MeditWriter(std::unique_ptr<ByteSink> bytes, const WriteOptions& options, bool binary)
      : MeshCollector(std::move(bytes), options, binary ? ".meshb" : ".mesh"), binary_(binary) {}

 protected:
  bool holdsLocks() const override { return true; }

  void write(MeshSpool& mesh) override {
    mesh_ = &mesh;
    cell_reference_ = cellReference(mesh);
    point_reference_ = pointReference(mesh.schema().fields);
    version_ = versionOf(mesh);
    MeditOut out(bytes(), binary_, version_);
    writeVertices(out);
    writeTetrahedra(out);
    writeFaces(out);
    writeRequired(out);
    out.end();
    writeSolutions();
  }

 private:
  // The column of integers that becomes the references of points: that of the name, or the first.
  static int pointReference(const std::vector<Column>& fields) {
    const auto fits = [](const Column& c) { return c.components == 1 && !isFloat(c.type); };
    const int named = findColumn(fields, kMeditReference);
    if (named >= 0) return fits(fields[static_cast<size_t>(named)]) ? named : -1;
    const auto first = std::find_if(fields.begin(), fields.end(), fits);
    return first == fields.end() ? -1 : static_cast<int>(first - fields.begin());
  }

  static int cellReference(MeshSpool& mesh) {
    const auto found = labelColumn(mesh, kMeditReference, [](size_t) { return true; });
    return found ? static_cast<int>(*found) : -1;
  }

  static bool anyWideFaceLabel(MeshSpool& mesh) {
    int64_t corners[3], label;
    for (uint64_t i = 0; i < mesh.faceCount(); ++i) {
      mesh.readFaces(i, 1, corners, &label);
      if (label != static_cast<int32_t>(label)) return true;
    }
    return false;
  }

  // Text has no sizes: its version says float64. Binary has the smallest that holds everything.
  int versionOf(MeshSpool& mesh) const {
    const Schema& schema = mesh.schema();
    bool wide = mesh.pointCount() > INT32_MAX || mesh.cellCount() > INT32_MAX ||
                mesh.faceCount() > INT32_MAX;
    const auto isWide = [](const std::vector<Column>& columns, int column) {
      return column >= 0 && columns[static_cast<size_t>(column)].type == ScalarType::kInt64;
    };
    wide = wide || isWide(schema.cell_data, cell_reference_) ||
           isWide(schema.fields, point_reference_) || anyWideFaceLabel(mesh);
    if (wide) return 4;
    if (!binary_) return 2;
    if (meditNeedsWidePlaces(schema, mesh.pointCount(), mesh.cellCount(), mesh.faceCount()))
      return 3;
    return allSingle() ? 1 : 2;
  }
  bool allSingle() const {
    const auto single = [](const std::vector<Column>& columns, int reference) {
      for (size_t c = 0; c < columns.size(); ++c)
        if (static_cast<int>(c) != reference && columns[c].type != ScalarType::kFloat32)
          return false;
      return true;
    };
    return mesh_->schema().position_type == ScalarType::kFloat32 &&
           single(mesh_->schema().fields, point_reference_) &&
           single(mesh_->schema().cell_data, cell_reference_);
  }

  int64_t label(const unsigned char* value, ScalarType type) const {
    int64_t wide;
    convertScalars(value, type, &wide, ScalarType::kInt64, 1);
    return wide;
  }

  void writeVertices(MeditOut& out) {
    const ScalarType type = mesh_->schema().position_type;
    out.begin(kMeditVertices, mesh_->pointCount(), 3 * out.realBytes() + out.integerBytes());
    const auto column = static_cast<size_t>(point_reference_);
    forEachRow(
        mesh_->pointCount(), 3 * sizeOf(type),
        [&](uint64_t first, size_t n, void* rows) { mesh_->readPositions(first, n, rows); },
        [&](uint64_t point, const unsigned char* position) {
          for (size_t k = 0; k < 3; ++k) out.real(position + k * sizeOf(type), type);
          out.integer(point_reference_ < 0 ? 0 : pointLabel(column, point));
          out.endRow();
        });
  }

  int64_t pointLabel(size_t column, uint64_t point) {
    unsigned char value[8];
    mesh_->readField(column, point, 1, value);
    return label(value, mesh_->schema().fields[column].type);
  }

  int64_t cellLabel(size_t column, uint64_t cell) {
    unsigned char value[8];
    mesh_->readCellData(column, cell, 1, value);
    return label(value, mesh_->schema().cell_data[column].type);
  }

  void writeTetrahedra(MeditOut& out) {
    out.begin(kMeditTetrahedra, mesh_->cellCount(), 5 * out.integerBytes());
    forEachRow(
        mesh_->cellCount(), 4 * sizeof(int64_t),
        [&](uint64_t first, size_t n, void* rows) {
          mesh_->readCells(first, n, static_cast<int64_t*>(rows));
        },
        [&](uint64_t cell, const unsigned char* row) {
          putCorners(out, row, 4);
          out.integer(cell_reference_ < 0 ? 0
                                          : cellLabel(static_cast<size_t>(cell_reference_), cell));
          out.endRow();
        });
  }

  static void putCorners(MeditOut& out, const unsigned char* row, size_t count) {
    for (size_t k = 0; k < count; ++k) {
      int64_t corner;
      std::memcpy(&corner, row + k * sizeof corner, sizeof corner);
      out.integer(corner + 1);
    }
  }

  void writeFaces(MeditOut& out) {
    if (mesh_->faceCount() == 0) return;
    out.begin(kMeditTriangles, mesh_->faceCount(), 4 * out.integerBytes());
    for (uint64_t i = 0; i < mesh_->faceCount(); ++i) {
      int64_t corners[3], face_label;
      mesh_->readFaces(i, 1, corners, &face_label);
      for (int64_t corner : corners) out.integer(corner + 1);
      out.integer(face_label);
      out.endRow();
    }
  }

  void writeRequired(MeditOut& out) {
    const uint8_t* locked = mesh_->locked();
    if (!locked) return;
    const auto points = static_cast<size_t>(mesh_->pointCount());
    uint64_t count = 0;
    for (size_t i = 0; i < points; ++i) count += locked[i] != 0;
    out.begin(kMeditRequiredVertices, count, out.integerBytes());
    for (size_t i = 0; i < points; ++i) {
      if (!locked[i]) continue;
      out.integer(static_cast<int64_t>(i + 1));
      out.endRow();
    }
  }

  // ------------------------------------------------------------------------------- solutions

  std::vector<Solution> solutionsOf(const std::vector<Column>& columns, int reference) {
    std::vector<Solution> solutions;
    for (size_t c = 0; c < columns.size(); ++c) {
      if (static_cast<int>(c) == reference) continue;
      const int n = columns[c].components;
      const int type = n == 3 ? 2 : n == 6 ? 3 : n == 9 ? 4 : 1;
      const int width = type == 1 ? 1 : n;
      for (int first = 0; first < n; first += width) solutions.push_back({c, first, width, type});
    }
    return solutions;
  }

  void noteNames(const std::vector<Column>& columns, int reference, const char* what) {
    std::string names;
    for (size_t c = 0; c < columns.size(); ++c)
      if (static_cast<int>(c) != reference)
        names += (names.empty() ? "\"" : ", \"") + columns[c].name + "\"";
    if (!names.empty())
      note(std::string("the format has no names for ") + what + ", which are, in order: " + names);
  }

  void writeSolutions() {
    const Schema& schema = mesh_->schema();
    const std::vector<Solution> fields = solutionsOf(schema.fields, point_reference_);
    const std::vector<Solution> cell_data = solutionsOf(schema.cell_data, cell_reference_);
    if (fields.empty() && cell_data.empty()) return noteOldSolution();
    noteNames(schema.fields, point_reference_, "fields");
    noteNames(schema.cell_data, cell_reference_, "cell data");
    if (options().path.empty())
      return note(
          "fields and cell data are left out: they go to a .sol file beside the mesh, and "
          "it is not written to a file");
    const std::string path = withExtension(options().path, binary_ ? ".solb" : ".sol");
    const std::unique_ptr<ByteSink> beside =
        watched(createFile(path, options().joint), options().tell);
    MeditOut out(*beside, binary_, version_);
    writeSection(out, kMeditSolAtVertices, schema.fields, fields, mesh_->pointCount(),
                 [&](size_t c, uint64_t row, void* to) { mesh_->readField(c, row, 1, to); });
    writeSection(out, kMeditSolAtTetrahedra, schema.cell_data, cell_data, mesh_->cellCount(),
                 [&](size_t c, uint64_t row, void* to) { mesh_->readCellData(c, row, 1, to); });
    out.end();
    beside->commit();
    note("fields and cell data are written to " + path);
  }

  void noteOldSolution() {
    if (options().path.empty()) return;
    if (const auto old = openMeditSolution(options().path))
      note(old->name() + " lies beside it and is of another mesh");
  }

  template <class Read>
  void writeSection(MeditOut& out, int keyword, const std::vector<Column>& columns,
                    const std::vector<Solution>& solutions, uint64_t rows, Read read) {
    if (solutions.empty()) return;
    uint64_t width = 0;
    for (const Solution& s : solutions) width += static_cast<uint64_t>(s.components);
    out.begin(keyword, rows, width * out.realBytes(), 4 * (1 + solutions.size()));
    out.small(static_cast<int64_t>(solutions.size()));
    for (const Solution& s : solutions) out.small(s.type);
    out.endRow();
    unsigned char values[8 * kMaxComponents];
    std::vector<bool> rounded(columns.size());
    for (uint64_t row = 0; row < rows; ++row) {
      for (const Solution& s : solutions) {
        const ScalarType type = columns[s.column].type;
        if (s.first == 0) read(s.column, row, values);
        for (int k = 0; k < s.components; ++k) {
          const int component =
              s.components == 6 ? kSymmetricOf[static_cast<size_t>(k)] : s.first + k;
          const unsigned char* const value = values + static_cast<size_t>(component) * sizeOf(type);
          out.real(value, type);
          if (!isExactAsDouble(value, type)) rounded[s.column] = true;
        }
      }
      out.endRow();
    }
    for (size_t c = 0; c < columns.size(); ++c)
      if (rounded[c] && binary_) noteRounded(columns[c].name);
  }

  bool binary_;
  int version_ = 2;
  MeshSpool* mesh_ = nullptr;
  int cell_reference_ = -1, point_reference_ = -1;
};

}  // namespace

bool meditNeedsWidePlaces(const Schema& schema, uint64_t points, uint64_t cells, uint64_t faces) {
  constexpr uint64_t kRowBytes = 28, kRealBytes = 8, kMostBytes = 0x7fff0000;
  uint64_t of_cell = 0;
  for (const Column& column : schema.cell_data) of_cell += static_cast<uint64_t>(column.components);
  const uint64_t reals = schema.fieldComponents() * points + of_cell * cells;
  return kRowBytes * (points + cells + faces) + kRealBytes * reals >= kMostBytes;
}

std::unique_ptr<Sink> createMesh(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return std::make_unique<MeditWriter>(std::move(bytes), options, false);
}

std::unique_ptr<Sink> createMeshb(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return std::make_unique<MeditWriter>(std::move(bytes), options, true);
}

}  // namespace tetstream
