// Reads legacy VTK files (versions 1 to 5, text and binary) of unstructured grids by range.
#include <memory>

#include "pieced_mesh.h"
#include "status.h"
#include "time_steps.h"
#include "vtk_file.h"
#include "vtk_format.h"

namespace tetstream {

namespace {

struct OpenVtk {
  std::unique_ptr<ByteSource> bytes;
  VtkFile file;
  Helpers helpers;
};
using SharedVtk = std::shared_ptr<OpenVtk>;

class FileBytes final : public ValueBytes {
 public:
  FileBytes(SharedVtk vtk, const VtkArray& array) : vtk_(std::move(vtk)), array_(array) {}
  void readAt(uint64_t offset, void* out, size_t size) override {
    const size_t got = vtk_->bytes->readAt(array_.begin + offset, out, size);
    if (got < size)
      fail(Status::kIo, "%s: byte %llu: the file has become shorter", vtk_->bytes->name().c_str(),
           static_cast<unsigned long long>(array_.begin + offset + got));
  }

 private:
  SharedVtk vtk_;
  const VtkArray& array_;
};

// Bits, each as a byte.
class BitBytes final : public ValueBytes {
 public:
  explicit BitBytes(std::unique_ptr<ValueBytes> packed) : packed_(std::move(packed)) {}
  void readAt(uint64_t offset, void* out, size_t size) override {
    unsigned char byte = 0;
    for (size_t i = 0; i < size; ++i) {
      const uint64_t bit = offset + i;
      if (i == 0 || bit % 8 == 0) packed_->readAt(bit / 8, &byte, 1);
      static_cast<unsigned char*>(out)[i] = byte >> (7 - bit % 8) & 1;
    }
  }

 private:
  std::unique_ptr<ValueBytes> packed_;
};

// Offsets without the first one, which is 0.
class EndOffsets final : public Values {
 public:
  explicit EndOffsets(std::unique_ptr<Values> offsets) : offsets_(std::move(offsets)) {}
  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    offsets_->read(first + 1, count, out, type);
  }

 private:
  std::unique_ptr<Values> offsets_;
};

std::unique_ptr<Values> openValues(const SharedVtk& vtk, const VtkArray& array, uint64_t count) {
  const std::string what = placeOf(*vtk->bytes, array.name);
  const uint64_t held = array.rows * static_cast<uint64_t>(array.components);
  if (count != held)
    fail(Status::kBadData, "%s has %llu values where the counts need %llu", what.c_str(),
         static_cast<unsigned long long>(held), static_cast<unsigned long long>(count));
  if (!vtk->file.binary)
    return openTextValues(*vtk->bytes, what, array.type, {array.begin, array.end, count},
                          vtk->helpers);
  std::unique_ptr<ValueBytes> bytes = std::make_unique<FileBytes>(vtk, array);
  if (array.bits) bytes = std::make_unique<BitBytes>(std::move(bytes));
  return openBinaryValues(std::move(bytes), what, array.type, true);
}

MeshArray arrayOf(const SharedVtk& vtk, const VtkArray& array) {
  return {array.name, array.type, array.components,
          [vtk, &array](uint64_t count) { return openValues(vtk, array, count); }};
}

std::optional<MeshArray> arrayOf(const SharedVtk& vtk, const std::optional<VtkArray>& array) {
  return array ? std::optional(arrayOf(vtk, *array)) : std::nullopt;
}

MeshPiece pieceOf(const SharedVtk& vtk) {
  const VtkFile& file = vtk->file;
  MeshPiece piece;
  piece.point_count = file.points->rows;
  piece.cell_count = file.cell_count;
  for (const VtkArray& array : file.point_data) piece.point_data.push_back(arrayOf(vtk, array));
  for (const VtkArray& array : file.cell_data) piece.cell_data.push_back(arrayOf(vtk, array));
  piece.points = arrayOf(vtk, file.points);
  piece.connectivity = arrayOf(vtk, file.cells);
  piece.types = arrayOf(vtk, file.types);
  if (file.cells) piece.connectivity_size = file.cells->rows;
  if (!file.cell_ends) return piece;
  piece.offsets = arrayOf(vtk, file.cell_ends);
  piece.offsets->open = [vtk](uint64_t count) -> std::unique_ptr<Values> {
    return std::make_unique<EndOffsets>(openValues(vtk, *vtk->file.cell_ends, count + 1));
  };
  return piece;
}

}  // namespace

Input openVtk(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  bytes = makeSeekable(std::move(bytes), options.temp_dir);
  VtkFile file = parseVtk(*bytes);
  const auto vtk = std::make_shared<OpenVtk>(
      OpenVtk{std::move(bytes), std::move(file), {options.threads, std::this_thread::get_id()}});
  MeshPieces mesh;
  mesh.name = vtk->bytes->name();
  mesh.form = vtk->file.offsets ? CellForm::kOffsets : CellForm::kInterleaved;
  mesh.notes = vtk->file.notes;
  if (vtk->file.time)
    takeTime(mesh, readTime(mesh, [&] { return timeIn(*openValues(vtk, *vtk->file.time, 1)); }));
  mesh.add(pieceOf(vtk));
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
