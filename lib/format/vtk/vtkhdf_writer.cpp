// Writes VTKHDF files, one partition, of version 1.0, which VTK 9.1 and later read. HDF5 goes back
// and forth in its file, so it works in a temporary one. Labelled faces are triangles after the
// tetrahedra.
#ifdef TETSTREAM_WITH_HDF5
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "dropped_marks.h"
#include "field_time.h"
#include "hdf5_column.h"
#include "held_names.h"
#include "io_error.h"
#include "status.h"
#include "trailing_faces.h"
#include "vtk_cells.h"
#include "vtk_format.h"
#include "write_signals.h"

namespace tetstream {

namespace {

constexpr size_t kKindsAtOnce = 1024;  // cells whose types and offsets are made
constexpr size_t kCopiedAtOnce = 1 << 16;

class SpoolStorage final : public Hdf5Storage {
 public:
  explicit SpoolStorage(const std::string& temp_dir) : spool_(temp_dir) {}

  size_t readAt(uint64_t offset, void* out, size_t size) override {
    const uint64_t left = size_ - std::min(size_, offset);
    const size_t n = static_cast<size_t>(std::min<uint64_t>(size, left));
    spool_.readAt(offset, out, n);
    return n;
  }

  void writeAt(uint64_t offset, const void* data, size_t size) override {
    spool_.writeAt(offset, data, size);
    size_ = std::max(size_, offset + size);
  }

  void resize(uint64_t size) override {
    const WriteSignalsHeld held;
    if (::ftruncate(spool_.descriptor(), static_cast<off_t>(size)) != 0)
      failIo(spool_.name(), "set the size");
    size_ = size;
  }
  uint64_t size() const override { return size_; }

 private:
  SpoolFile spool_;
  uint64_t size_ = 0;
};

ValueType valueType(ScalarType type) {
  switch (type) {
    case ScalarType::kFloat32:
      return ValueType::kFloat32;
    case ScalarType::kFloat64:
      return ValueType::kFloat64;
    case ScalarType::kInt32:
      return ValueType::kInt32;
    case ScalarType::kInt64:
      return ValueType::kInt64;
  }
  return ValueType::kFloat64;
}

class VtkHdfWriter final : public Sink {
 public:
  VtkHdfWriter(std::unique_ptr<ByteSink> bytes, const WriteOptions& options)
      : bytes_(std::move(bytes)),
        options_(options),
        dropped_(*bytes_, options, ".vtkhdf"),
        faces_(*bytes_, options) {}

  void begin(const Schema& schema) override {
    checkSchema(schema);
    schema_ = schema;
    file_ = std::make_unique<Hdf5File>(std::make_unique<SpoolStorage>(options_.temp_dir),
                                       bytes_->name(), true);
    const Hdf5Turn turn;
    const Hdf5Id group = file_->createGroup("VTKHDF");
    file_->addAttribute(group, "Version", std::vector<int64_t>{1, 0});
    file_->addAttribute(group, "Type", "UnstructuredGrid");
    points_ = makeColumn("Points", valueType(schema.position_type), 3);
    connectivity_ = makeColumn("Connectivity", ValueType::kInt64, 1);
    makeColumns("PointData", schema.fields, fields_);
    makeColumns("CellData", schema.cell_data, cell_data_);
  }

  void put(const BatchView& batch) override {
    const Hdf5Turn turn;
    const size_t vertices = batch.vertex_count, cells = batch.cell_count;
    points_->append(batch.positions, vertices);
    for (size_t i = 0; vertices > 0 && i < fields_.size(); ++i)
      fields_[i]->append(batch.fields[i], vertices);
    connectivity_->append(batch.cells, 4 * cells);
    for (size_t i = 0; cells > 0 && i < cell_data_.size(); ++i)
      cell_data_[i]->append(batch.cell_data[i], cells);
    vertex_count_ += vertices;
    cell_count_ += cells;
    faces_.put(batch, vertex_count_, schema_.cell_data);
    dropped_.lookAtLocks(batch);
  }

  void finish() override {
    {
      const Hdf5Turn turn;
      faces_.close();
      if (faces_.count() > 0) appendFaces();
      points_->finish();
      connectivity_->finish();
      for (const Place& column : fields_) column->finish();
      for (const Place& column : cell_data_) column->finish();
      makeKinds();
      makeCount("NumberOfPoints", vertex_count_);
      makeCount("NumberOfCells", cell_count_ + faces_.count());
      makeCount("NumberOfConnectivityIds", 4 * cell_count_ + 3 * faces_.count());
      if (schema_.time) makeTime(*schema_.time);
    }
    file_->close();
    copyOut();
    bytes_->commit();
  }

 private:
  using Place = std::unique_ptr<Hdf5Column>;

  Place makeColumn(const std::string& name, ValueType type, int components) {
    return std::make_unique<Hdf5Column>(*file_, "VTKHDF/" + name, type, components,
                                        options_.compress);
  }

  void makeColumns(const std::string& group, const std::vector<Column>& columns,
                   std::vector<Place>& out) {
    file_->createGroup("VTKHDF/" + group);
    const std::vector<std::string> names =
        heldNames(columns, linkName, [this](const std::string& text) {
          if (options_.note) options_.note(bytes_->name() + ": " + text);
        });
    for (size_t i = 0; i < columns.size(); ++i)
      out.push_back(
          makeColumn(group + "/" + names[i], valueType(columns[i].type), columns[i].components));
  }

  // In HDF5, a '/' parts the names of groups, and "." is the group itself.
  static std::string linkName(const std::string& name) {
    std::string link = name == "." ? "_" : name;
    std::replace(link.begin(), link.end(), '/', '_');
    return link;
  }

  // What only cells of the other kind have is zero.
  void appendFaces() {
    for (size_t i = 0; i < cell_data_.size(); ++i)
      appendZeroRows(*cell_data_[i], schema_.cell_data[i], faces_.count());
    const Column column = TrailingFaces::labels();
    Place labels = makeColumn("CellData/" + column.name, valueType(column.type), column.components);
    appendZeroRows(*labels, column, cell_count_);
    faces_.forAll([&](const TrailingFaces::Face& face) {
      connectivity_->append(face.vertices, 3);
      labels->append(&face.label, 1);
    });
    cell_data_.push_back(std::move(labels));
  }

  static void appendZeroRows(Hdf5Column& out, const Column& column, uint64_t rows) {
    const std::vector<unsigned char> zeros(kKindsAtOnce * column.bytesPerRow(), 0);
    while (rows > 0) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(rows, kKindsAtOnce));
      out.append(zeros.data(), n);
      rows -= n;
    }
  }

  // Where each cell begins in the connectivity, and its end, which is the last one's.
  void makeKinds() {
    const Place offsets = makeColumn("Offsets", ValueType::kInt64, 1);
    const Place types = makeColumn("Types", ValueType::kUInt8, 1);
    appendKinds(*offsets, *types, kVtkTetra, 4, cell_count_, 0);
    const auto tetrahedra = static_cast<int64_t>(4 * cell_count_);
    appendKinds(*offsets, *types, kVtkTriangle, 3, faces_.count(), tetrahedra);
    const int64_t end = tetrahedra + static_cast<int64_t>(3 * faces_.count());
    offsets->append(&end, 1);
    offsets->finish();
    types->finish();
  }

  static void appendKinds(Hdf5Column& offsets, Hdf5Column& types, unsigned char type,
                          int64_t points, uint64_t count, int64_t begin) {
    const std::vector<unsigned char> same(kKindsAtOnce, type);
    int64_t made[kKindsAtOnce];
    for (uint64_t done = 0; done < count;) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(count - done, kKindsAtOnce));
      for (size_t i = 0; i < n; ++i) made[i] = begin + points * static_cast<int64_t>(done + i);
      offsets.append(made, n);
      types.append(same.data(), n);
      done += n;
    }
  }

  void makeCount(const char* name, uint64_t count) {
    const Place column = makeColumn(name, ValueType::kInt64, 1);
    const int64_t value = static_cast<int64_t>(count);
    column->append(&value, 1);
    column->finish();
  }

  // A step of version 2 would have it in a group that VTK before 9.3 does not read.
  void makeTime(double time) {
    file_->createGroup("VTKHDF/FieldData");
    const Place column = makeColumn(std::string("FieldData/") + kVtkTime, ValueType::kFloat64, 1);
    column->append(&time, 1);
    column->finish();
  }

  void copyOut() {
    std::vector<unsigned char> bytes(kCopiedAtOnce);
    Hdf5Storage& storage = file_->storage();
    for (uint64_t at = 0; at < storage.size();) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(kCopiedAtOnce, storage.size() - at));
      storage.readAt(at, bytes.data(), n);
      bytes_->write(bytes.data(), n);
      at += n;
    }
  }

  std::unique_ptr<ByteSink> bytes_;
  WriteOptions options_;
  DroppedMarks dropped_;
  TrailingFaces faces_;
  Schema schema_;
  std::unique_ptr<Hdf5File> file_;  // before the columns: it outlives them
  Place points_, connectivity_;
  std::vector<Place> fields_, cell_data_;
  uint64_t vertex_count_ = 0, cell_count_ = 0;
};

}  // namespace

std::unique_ptr<Sink> createVtkHdf(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return std::make_unique<VtkHdfWriter>(std::move(bytes), options);
}

}  // namespace tetstream
#endif
