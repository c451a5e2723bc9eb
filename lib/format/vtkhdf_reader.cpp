// Reads VTKHDF files of unstructured grids: HDF5 with datasets over all partitions, which are read
// as pieces. Points that partitions share are one each.
#ifdef TETSTREAM_WITH_HDF5
#include <algorithm>

#include "hdf5_file.h"
#include "pieced_mesh.h"
#include "registry.h"
#include "status.h"

namespace tetstream {

namespace {

using SharedFile = std::shared_ptr<Hdf5File>;

class SourceStorage final : public Hdf5Storage {
 public:
  explicit SourceStorage(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {}
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return bytes_->readAt(offset, out, size);
  }
  void writeAt(uint64_t, const void*, size_t) override {
    fail(Status::kInternal, "%s: HDF5 writes to a file that is read", bytes_->name().c_str());
  }
  void resize(uint64_t) override {}
  uint64_t size() const override { return bytes_->size(); }

 private:
  std::unique_ptr<ByteSource> bytes_;
};

// First rows of a partition in the datasets.
struct Place {
  uint64_t point = 0, cell = 0, id = 0, offset = 0;
};

class VtkHdf {
 public:
  VtkHdf(std::unique_ptr<ByteSource> bytes, MeshPieces& mesh) : mesh_(mesh) {
    mesh_.name = bytes->name();
    mesh_.join = true;
    file_ = std::make_shared<Hdf5File>(std::make_unique<SourceStorage>(std::move(bytes)),
                                       mesh_.name, false);
  }

  void read() {
    const Hdf5Turn turn;
    checkKind();
    points_ = file_->integers("VTKHDF/NumberOfPoints", kMaxMeshPieces);
    cells_ = file_->integers("VTKHDF/NumberOfCells", kMaxMeshPieces);
    ids_ = file_->integers("VTKHDF/NumberOfConnectivityIds", kMaxMeshPieces);
    const size_t parts = countParts();
    Place place;
    for (size_t i = 0; i < parts; ++i) addPart(i, place);
    addData("VTKHDF/PointData", place.point, &MeshPiece::point_data);
    addData("VTKHDF/CellData", place.cell, &MeshPiece::cell_data);
  }

 private:
  [[noreturn]] void failFile(Status status, const std::string& text) const {
    fail(status, "%s: %s", mesh_.name.c_str(), text.c_str());
  }

  void checkKind() {
    if (!file_->has("VTKHDF")) failFile(Status::kBadData, "there is no group VTKHDF");
    const std::string kind = file_->textAttribute("VTKHDF", "Type");
    if (kind != "UnstructuredGrid")
      failFile(Status::kUnsupported, "the file holds \"" + kind + "\", no UnstructuredGrid");
  }

  // Of several time steps, whose partitions follow each other, those of the first.
  size_t countParts() {
    if (points_.size() != cells_.size() || points_.size() != ids_.size())
      failFile(Status::kBadData,
               "the numbers of points, cells and ids are of different partitions");
    if (!file_->has("VTKHDF/Steps")) return points_.size();
    mesh_.addNote("of several time steps the first one is read");
    if (!file_->has("VTKHDF/Steps/NumberOfParts")) return points_.size() > 0;
    const std::vector<int64_t> parts =
        file_->integers("VTKHDF/Steps/NumberOfParts", size_t{1} << 20);
    if (parts.empty() || parts[0] < 0 || static_cast<uint64_t>(parts[0]) > points_.size())
      failFile(Status::kBadData, "the first time step has partitions that are not there");
    return static_cast<size_t>(parts[0]);
  }

  static uint64_t countOf(const std::vector<int64_t>& counts, size_t part) {
    return counts[part] < 0 ? kMaxMeshCount + 1 : static_cast<uint64_t>(counts[part]);
  }

  void addPart(size_t part, Place& place) {
    MeshPiece piece;
    piece.point_count = countOf(points_, part);
    piece.cell_count = countOf(cells_, part);
    const uint64_t ids = countOf(ids_, part);
    if (std::max({piece.point_count, piece.cell_count, ids}) > kMaxMeshCount)
      failFile(Status::kBadData, "partition " + std::to_string(part) +
                                     " has more points, cells or ids than any file can hold");
    piece.points = arrayOf("Points", 3, place.point, piece.point_count);
    piece.connectivity = arrayOf("Connectivity", 1, place.id, ids);
    // Of one offset more than there are cells, the first is 0.
    piece.offsets = arrayOf("Offsets", 1, place.offset + 1, piece.cell_count);
    piece.types = arrayOf("Types", 1, place.cell, piece.cell_count);
    place.point += piece.point_count;
    place.cell += piece.cell_count;
    place.id += ids;
    place.offset += piece.cell_count + 1;
    mesh_.add(std::move(piece));
  }

  MeshArray arrayOf(const char* name, uint64_t components, uint64_t first, uint64_t rows) {
    const std::string path = std::string("VTKHDF/") + name;
    if (!file_->has(path)) failFile(Status::kBadData, "there is no dataset \"" + path + "\"");
    const Hdf5Shape shape = file_->shapeOf(path);
    if (!shape.numbers || shape.components != components)
      failFile(Status::kBadData, "dataset \"" + path + "\" has not " + std::to_string(components) +
                                     " numbers in a row");
    return makeArray(name, path, shape, first, rows);
  }

  MeshArray makeArray(const std::string& name, const std::string& path, const Hdf5Shape& shape,
                      uint64_t first, uint64_t rows) {
    if (first > shape.rows || rows > shape.rows - first)
      fail(Status::kBadData, "%s: dataset \"%s\" has %llu rows where the counts need %llu",
           mesh_.name.c_str(), path.c_str(), static_cast<unsigned long long>(shape.rows),
           static_cast<unsigned long long>(first + rows));
    MeshArray array{cutMeshName(name), shape.type, static_cast<int>(shape.components), {}};
    array.open = [file = file_, path, first, held = rows * shape.components](uint64_t count) {
      if (count != held)
        fail(Status::kBadData, "%s: dataset \"%s\" has %llu values where %llu are needed",
             file->name().c_str(), path.c_str(), static_cast<unsigned long long>(held),
             static_cast<unsigned long long>(count));
      return openHdf5Values(file, path, first);
    };
    return array;
  }

  void addData(const std::string& group, uint64_t rows, std::vector<MeshArray> MeshPiece::*list) {
    for (const std::string& name : file_->datasetsOf(group)) {
      const std::string path = textOf("%s/%s", group.c_str(), name.c_str());
      const std::string shown = textOf("array \"%s\"", cutMeshName(name).c_str());
      const Hdf5Shape shape = file_->shapeOf(path);
      if (!shape.numbers) {
        mesh_.addNote(shown + " is left out: its values are no numbers");
      } else if (shape.components < 1 || shape.components > 9) {
        mesh_.addNote(shown + " is left out: it has " + std::to_string(shape.components) +
                      " components, 1 to 9 are possible");
      } else if (shape.rows < rows) {
        fail(Status::kBadData, "%s: dataset \"%s\" has %llu rows where the counts need %llu",
             mesh_.name.c_str(), path.c_str(), static_cast<unsigned long long>(shape.rows),
             static_cast<unsigned long long>(rows));
      } else {
        addToParts(name, path, shape, list);
      }
    }
    if (list == &MeshPiece::point_data && file_->has("VTKHDF/FieldData"))
      mesh_.addNote("the file's FieldData is left out: it belongs to no vertex or cell");
  }

  void addToParts(const std::string& name, const std::string& path, const Hdf5Shape& shape,
                  std::vector<MeshArray> MeshPiece::*list) {
    const bool of_points = list == &MeshPiece::point_data;
    for (MeshPiece& piece : mesh_.pieces)
      (piece.*list)
          .push_back(makeArray(name, path, shape, of_points ? piece.first_point : piece.first_cell,
                               of_points ? piece.point_count : piece.cell_count));
  }

  MeshPieces& mesh_;
  SharedFile file_;
  std::vector<int64_t> points_, cells_, ids_;
};

}  // namespace

Input openVtkHdf(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  MeshPieces mesh;
  VtkHdf(makeSeekable(std::move(bytes), options.temp_dir), mesh).read();
  Input input;
  input.indexed = openPiecedMesh(std::move(mesh), options);
  return input;
}

}  // namespace tetstream
#endif
