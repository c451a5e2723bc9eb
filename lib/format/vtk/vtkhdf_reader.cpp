// Reads VTKHDF files of unstructured grids: HDF5 with datasets over all partitions, which are read
// as pieces. Points that partitions share are one each.
#ifdef TETSTREAM_WITH_HDF5
#include <algorithm>

#include "field_time.h"
#include "hdf5_file.h"
#include "pieced_mesh.h"
#include "status.h"
#include "time_steps.h"
#include "vtk_format.h"

namespace tetstream {

namespace {

using SharedFile = std::shared_ptr<Hdf5File>;

// A partition and its first rows in the datasets.
struct Place {
  uint64_t part = 0, point = 0, cell = 0, id = 0, offset = 0;
};

class VtkHdf {
 public:
  VtkHdf(std::unique_ptr<ByteSource> bytes, const ReadOptions& options, MeshPieces& mesh)
      : options_(options), mesh_(mesh) {
    mesh_.name = bytes->name();
    mesh_.join = true;
    file_ = openHdf5(std::move(bytes));
  }

  void read() {
    const Hdf5Turn turn;
    checkKind();
    points_ = file_->integers("VTKHDF/NumberOfPoints", kMaxMeshPieces);
    cells_ = file_->integers("VTKHDF/NumberOfCells", kMaxMeshPieces);
    ids_ = file_->integers("VTKHDF/NumberOfConnectivityIds", kMaxMeshPieces);
    Place place;
    const size_t parts = findParts(place);
    const Place begin = place;
    for (size_t i = 0; i < parts; ++i) addPart(static_cast<size_t>(begin.part) + i, place);
    addData("PointData", begin.point, place.point - begin.point, &MeshPiece::point_data);
    addData("CellData", begin.cell, place.cell - begin.cell, &MeshPiece::cell_data);
    takeTime(mesh_, readTime(mesh_, [this] { return timeOfFieldData(); }));
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

  // The partitions, and their first rows: of several time steps those of one.
  size_t findParts(Place& place) {
    if (points_.size() != cells_.size() || points_.size() != ids_.size())
      failFile(Status::kBadData,
               "the numbers of points, cells and ids are of different partitions");
    if (!file_->has("VTKHDF/Steps")) return points_.size();
    const std::string times = "VTKHDF/Steps/Values";
    const uint64_t steps = stepCount(times);
    if (steps == 0) failFile(Status::kBadData, "there are no time steps");
    StepTimes time;
    if (file_->has(times) && file_->shapeOf(times).numbers)
      time = [this, &times](uint64_t step) { return timeIn(*openHdf5Values(file_, times, step)); };
    step_ = chooseStep(mesh_, steps, options_, time);
    place.part = numberOfStep("PartOffsets", 0);
    place.point = numberOfStep("PointOffsets", 0);
    place.cell = numberOfStep("CellOffsets", 0);
    place.id = numberOfStep("ConnectivityIdOffsets", 0);
    place.offset = place.cell + place.part;  // one more than there are cells per partition
    const uint64_t parts = numberOfStep("NumberOfParts", 1);
    if (place.part > points_.size() || parts > points_.size() - place.part)
      failFile(Status::kBadData, "the time step has partitions that are not there");
    return static_cast<size_t>(parts);
  }

  // As many as times are told, or else as there are rows of what tells each step's partitions.
  uint64_t stepCount(const std::string& times) const {
    for (const std::string& told : {times, std::string("VTKHDF/Steps/NumberOfParts"),
                                    std::string("VTKHDF/Steps/PartOffsets")})
      if (file_->has(told)) return file_->shapeOf(told).rows;
    return 1;
  }

  // What the step has in a list of one number each, or `otherwise` if the file has none.
  uint64_t numberOfStep(const std::string& name, uint64_t otherwise) {
    const std::string path = "VTKHDF/Steps/" + name;
    if (!file_->has(path)) return otherwise;
    const Hdf5Shape shape = file_->shapeOf(path);
    if (!shape.numbers || isFloat(shape.type) || shape.components != 1 || shape.rows <= step_)
      failFile(Status::kBadData, "\"" + path + "\" has not an integer for each time step");
    int64_t number;
    openHdf5Values(file_, path, step_)->read(0, 1, &number, ScalarType::kInt64);
    if (number < 0 || static_cast<uint64_t>(number) > kMaxMeshCount)
      failFile(Status::kBadData, "\"" + path + "\" has " + std::to_string(number));
    return static_cast<uint64_t>(number);
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
    checkRows(path, shape, first, rows);
    MeshArray array{cutName(name), shape.type, static_cast<int>(shape.components), {}};
    array.open = [file = file_, path, begin = first * shape.components,
                  held = rows * shape.components](uint64_t count) {
      if (count != held)
        fail(Status::kBadData, "%s: dataset \"%s\" has %llu values where %llu are needed",
             file->name().c_str(), path.c_str(), static_cast<unsigned long long>(held),
             static_cast<unsigned long long>(count));
      return openHdf5Values(file, path, begin);
    };
    return array;
  }

  // The step's rows begin at `first`, unless the file says otherwise for the array.
  void addData(const std::string& data, uint64_t first, uint64_t rows,
               std::vector<MeshArray> MeshPiece::*list) {
    const std::string group = "VTKHDF/" + data;
    for (const std::string& name : file_->datasetsOf(group)) {
      const std::string path = textOf("%s/%s", group.c_str(), name.c_str());
      const std::string shown = textOf("array \"%s\"", cutName(name).c_str());
      const Hdf5Shape shape = file_->shapeOf(path);
      if (!shape.numbers) {
        mesh_.addNote(shown + " is left out: its values are no numbers");
        continue;
      }
      if (shape.components < 1 || shape.components > 9) {
        mesh_.addNote(shown + " is left out: it has " + std::to_string(shape.components) +
                      " components, 1 to 9 are possible");
        continue;
      }
      const uint64_t begin =
          numberOfStep(textOf("%sOffsets/%s", data.c_str(), name.c_str()), first);
      checkRows(path, shape, begin, rows);
      addToParts(name, path, shape, begin, list);
    }
  }

  // What belongs to no vertex or cell: of all that only the time.
  std::optional<double> timeOfFieldData() {
    const std::string group = "VTKHDF/FieldData";
    std::optional<double> time;
    for (const std::string& name : file_->datasetsOf(group)) {
      const std::string path = textOf("%s/%s", group.c_str(), name.c_str());
      const Hdf5Shape shape = file_->shapeOf(path);
      if (!isVtkTime(name) || !shape.numbers || shape.rows != 1 || shape.components != 1)
        mesh_.addNote("the file's FieldData is left out: it belongs to no vertex or cell");
      else if (!time)
        time = timeIn(*openHdf5Values(file_, path, 0));
    }
    return time;
  }

  void checkRows(const std::string& path, const Hdf5Shape& shape, uint64_t first,
                 uint64_t rows) const {
    if (first > shape.rows || rows > shape.rows - first)
      fail(Status::kBadData, "%s: dataset \"%s\" has %llu rows where the counts need %llu",
           mesh_.name.c_str(), path.c_str(), static_cast<unsigned long long>(shape.rows),
           static_cast<unsigned long long>(first + rows));
  }

  void addToParts(const std::string& name, const std::string& path, const Hdf5Shape& shape,
                  uint64_t begin, std::vector<MeshArray> MeshPiece::*list) {
    const bool of_points = list == &MeshPiece::point_data;
    for (MeshPiece& piece : mesh_.pieces)
      (piece.*list)
          .push_back(makeArray(name, path, shape,
                               begin + (of_points ? piece.first_point : piece.first_cell),
                               of_points ? piece.point_count : piece.cell_count));
  }

  const ReadOptions& options_;
  MeshPieces& mesh_;
  SharedFile file_;
  uint64_t step_ = 0;
  std::vector<int64_t> points_, cells_, ids_;
};

}  // namespace

Input openVtkHdf(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  MeshPieces mesh;
  VtkHdf(makeSeekable(std::move(bytes), options.temp_dir), options, mesh).read();
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
#endif
