// Writes legacy VTK files, binary, which is big-endian. Version 4.2, which readers old and new
// understand, has cells of 32 bits; where they do not suffice it is version 5.1. The counts that
// stand in front are known only at the end, so the arrays go through temporary files. Labelled
// faces are triangles after the tetrahedra.
#include "vtk_writer.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

#include "column_spool.h"
#include "dropped_marks.h"
#include "field_time.h"
#include "status.h"
#include "trailing_faces.h"
#include "vtk_cells.h"
#include "vtk_format.h"

namespace tetstream {

namespace {

constexpr size_t kVtkCellsAtOnce = 1024;  // cells
constexpr bool kSwap = std::endian::native == std::endian::little;

const char* vtkNameOf(ScalarType type) {
  switch (type) {
    case ScalarType::kFloat32:
      return "float";
    case ScalarType::kFloat64:
      return "double";
    case ScalarType::kInt32:
      return "int";
    case ScalarType::kInt64:
      return "long";
  }
  return "";
}

// One word, as version 3 and later spell names.
std::string encoded(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (byte <= 0x20 || byte >= 0x7F || c == '%' || c == '"')
      word += textOf("%%%02X", byte);
    else
      word += c;
  }
  return word;
}

// Numbers made on the way, big-endian.
template <class T>
class NumberRun {
 public:
  explicit NumberRun(BufferedSink& sink) : sink_(sink) {}
  void add(uint64_t value) {
    held_[filled_++] = static_cast<T>(value);
    if (filled_ == kVtkCellsAtOnce) flush();
  }
  void flush() {
    if (kSwap) swapBytes(reinterpret_cast<unsigned char*>(held_), sizeof(T), filled_);
    sink_.write(held_, filled_ * sizeof(T));
    filled_ = 0;
  }

 private:
  BufferedSink& sink_;
  T held_[kVtkCellsAtOnce];
  size_t filled_ = 0;
};

class VtkWriter final : public Sink {
 public:
  VtkWriter(std::unique_ptr<ByteSink> bytes, const WriteOptions& options, uint64_t most_int32)
      : bytes_(std::move(bytes)),
        options_(options),
        dropped_(*bytes_, options, ".vtk"),
        faces_(*bytes_, options),
        most_int32_(most_int32) {}

  void begin(const Schema& schema) override {
    checkSchema(schema);
    schema_ = schema;
    points_ = makeSpool();
    cells_ = makeSpool();
    for (size_t i = 0; i < schema.fields.size(); ++i) fields_.push_back(makeSpool());
    for (size_t i = 0; i < schema.cell_data.size(); ++i) cell_data_.push_back(makeSpool());
  }

  void put(const BatchView& batch) override {
    const size_t vertices = batch.vertex_count, cells = batch.cell_count;
    if (vertices > 0) append(*points_, batch.positions, schema_.position_type, 3 * vertices);
    for (size_t i = 0; vertices > 0 && i < fields_.size(); ++i)
      append(*fields_[i], batch.fields[i], schema_.fields[i], vertices);
    if (cells > 0) cells_->append(batch.cells, cells * 4 * sizeof(int64_t));
    for (size_t i = 0; cells > 0 && i < cell_data_.size(); ++i)
      append(*cell_data_[i], batch.cell_data[i], schema_.cell_data[i], cells);
    vertex_count_ += vertices;
    cell_count_ += cells;
    faces_.put(batch, vertex_count_, schema_.cell_data);
    dropped_.lookAtLocks(batch);
  }

  void finish() override {
    faces_.close();
    if (faces_.count() > 0) appendFaceData();
    BufferedSink sink(*bytes_);
    const bool wide = listedNumbers() > most_int32_ || vertex_count_ > most_int32_;
    writeText(sink, std::string("# vtk DataFile Version ") + (wide ? "5.1" : "4.2") +
                        "\ntetrahedra, written by tetstream\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
    writeText(sink, "POINTS " + std::to_string(vertex_count_) + " " +
                        vtkNameOf(schema_.position_type) + "\n");
    writeSpool(sink, *points_);
    cells_->close();
    wide ? writeOffsets(sink) : writeCells(sink);
    writeTypes(sink);
    if (schema_.time) writeTime(sink, *schema_.time);
    writeData(sink, "POINT_DATA ", vertex_count_, schema_.fields, fields_);
    writeData(sink, "CELL_DATA ", cellsOfBothKinds(), schema_.cell_data, cell_data_);
    sink.flush();
    bytes_->commit();
  }

 private:
  using Spool = std::unique_ptr<ColumnSpool>;

  Spool makeSpool() { return std::make_unique<ColumnSpool>(options_.temp_dir); }

  static void append(ColumnSpool& spool, const void* values, ScalarType type, size_t count) {
    if (kSwap)
      spool.appendSwapped(values, sizeOf(type), count);
    else
      spool.append(values, sizeOf(type) * count);
  }
  static void append(ColumnSpool& spool, const void* values, const Column& column, size_t rows) {
    append(spool, values, column.type, rows * static_cast<size_t>(column.components));
  }

  uint64_t cellsOfBothKinds() const { return cell_count_ + faces_.count(); }
  uint64_t connectivity() const { return 4 * cell_count_ + 3 * faces_.count(); }
  uint64_t listedNumbers() const { return cellsOfBothKinds() + connectivity(); }

  // What only cells of the other kind have is zero.
  void appendFaceData() {
    for (size_t i = 0; i < cell_data_.size(); ++i)
      appendZeros(*cell_data_[i], faces_.count() * schema_.cell_data[i].bytesPerRow());
    const Column column = TrailingFaces::labels();
    Spool labels = makeSpool();
    appendZeros(*labels, cell_count_ * column.bytesPerRow());
    faces_.forAll(
        [&](const TrailingFaces::Face& face) { append(*labels, &face.label, column, 1); });
    schema_.cell_data.push_back(column);
    cell_data_.push_back(std::move(labels));
  }

  static void writeText(BufferedSink& sink, const std::string& text) {
    sink.write(text.data(), text.size());
  }

  // note: VTK writes it before the points, where Gmsh does not read the file then.
  static void writeTime(BufferedSink& sink, double time) {
    writeText(sink, textOf("FIELD FieldData 1\n%s 1 1 double\n", kVtkTime));
    NumberRun<uint64_t> run(sink);
    run.add(std::bit_cast<uint64_t>(time));
    run.flush();
    writeText(sink, "\n");
  }

  static void writeSpool(BufferedSink& sink, ColumnSpool& spool) {
    spool.close();
    spool.write(sink);
    writeText(sink, "\n");
  }

  // Calls take(corners) for each cell.
  template <class Take>
  void forCells(Take take) {
    std::vector<int64_t> corners(4 * kVtkCellsAtOnce);
    for (uint64_t done = 0; done < cell_count_;) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(cell_count_ - done, kVtkCellsAtOnce));
      cells_->readAt(done * 4 * sizeof(int64_t), corners.data(), n * 4 * sizeof(int64_t));
      for (size_t i = 0; i < n; ++i) take(corners.data() + 4 * i);
      done += n;
    }
  }

  void writeCells(BufferedSink& sink) {
    writeText(sink, "CELLS " + std::to_string(cellsOfBothKinds()) + " " +
                        std::to_string(listedNumbers()) + "\n");
    NumberRun<int32_t> run(sink);
    forCells([&](const int64_t* corners) {
      run.add(4);
      for (int i = 0; i < 4; ++i) run.add(static_cast<uint64_t>(corners[i]));
    });
    faces_.forAll([&](const TrailingFaces::Face& face) {
      run.add(3);
      for (int64_t v : face.vertices) run.add(static_cast<uint64_t>(v));
    });
    run.flush();
    writeText(sink, "\n");
  }

  void writeOffsets(BufferedSink& sink) {
    writeText(sink, "CELLS " + std::to_string(cellsOfBothKinds() + 1) + " " +
                        std::to_string(connectivity()) + "\nOFFSETS vtktypeint64\n");
    NumberRun<int64_t> run(sink);
    for (uint64_t i = 0; i <= cell_count_; ++i) run.add(4 * i);
    for (uint64_t i = 1; i <= faces_.count(); ++i) run.add(4 * cell_count_ + 3 * i);
    run.flush();
    writeText(sink, "\nCONNECTIVITY vtktypeint64\n");
    forCells([&](const int64_t* corners) {
      for (int i = 0; i < 4; ++i) run.add(static_cast<uint64_t>(corners[i]));
    });
    faces_.forAll([&](const TrailingFaces::Face& face) {
      for (int64_t v : face.vertices) run.add(static_cast<uint64_t>(v));
    });
    run.flush();
    writeText(sink, "\n");
  }

  void writeTypes(BufferedSink& sink) {
    writeText(sink, "CELL_TYPES " + std::to_string(cellsOfBothKinds()) + "\n");
    NumberRun<int32_t> run(sink);
    for (uint64_t i = 0; i < cell_count_; ++i) run.add(kVtkTetra);
    for (uint64_t i = 0; i < faces_.count(); ++i) run.add(kVtkTriangle);
    run.flush();
    writeText(sink, "\n");
  }

  // As VTK does: what viewers show at first, the first float scalar and the first float vector,
  // stands before the FIELD of all others.
  static void writeData(BufferedSink& sink, const char* keyword, uint64_t rows,
                        const std::vector<Column>& columns, const std::vector<Spool>& spools) {
    if (columns.empty()) return;
    writeText(sink, keyword + std::to_string(rows) + "\n");
    const size_t scalars = firstFloats(columns, 1), vectors = firstFloats(columns, 3);
    if (scalars < columns.size()) {
      writeText(sink, "SCALARS " + encoded(columns[scalars].name) + " " +
                          vtkNameOf(columns[scalars].type) + "\nLOOKUP_TABLE default\n");
      writeSpool(sink, *spools[scalars]);
    }
    if (vectors < columns.size()) {
      writeText(sink, "VECTORS " + encoded(columns[vectors].name) + " " +
                          vtkNameOf(columns[vectors].type) + "\n");
      writeSpool(sink, *spools[vectors]);
    }
    const size_t first = (scalars < columns.size()) + (vectors < columns.size());
    if (first == columns.size()) return;
    writeText(sink, "FIELD FieldData " + std::to_string(columns.size() - first) + "\n");
    for (size_t i = 0; i < columns.size(); ++i) {
      if (i == scalars || i == vectors) continue;
      writeText(sink, encoded(columns[i].name) + " " + std::to_string(columns[i].components) + " " +
                          std::to_string(rows) + " " + vtkNameOf(columns[i].type) + "\n");
      writeSpool(sink, *spools[i]);
    }
  }

  static size_t firstFloats(const std::vector<Column>& columns, int components) {
    size_t i = 0;
    while (i < columns.size() && !(isFloat(columns[i].type) && columns[i].components == components))
      ++i;
    return i;
  }

  std::unique_ptr<ByteSink> bytes_;
  WriteOptions options_;
  DroppedMarks dropped_;
  TrailingFaces faces_;
  uint64_t most_int32_;
  Schema schema_;
  Spool points_, cells_;
  std::vector<Spool> fields_, cell_data_;
  uint64_t vertex_count_ = 0, cell_count_ = 0;
};

}  // namespace

std::unique_ptr<Sink> createVtkWith(std::unique_ptr<ByteSink> bytes, const WriteOptions& options,
                                    uint64_t most_int32) {
  return std::make_unique<VtkWriter>(std::move(bytes), options, most_int32);
}

std::unique_ptr<Sink> createVtk(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return createVtkWith(std::move(bytes), options, kVtkMostInt32);
}

}  // namespace tetstream
