// Reads TetGen's meshes: points in NAME.node, cells in NAME.ele, labelled faces in NAME.face where
// that is there. Any of the three names the mesh.
#include "compressed_bytes.h"
#include "file_scan.h"
#include "medit_sol.h"
#include "mesh_intake.h"
#include "status.h"
#include "tetgen_format.h"

namespace tetstream {

namespace {

constexpr int64_t kMostAttributes = 512;
constexpr size_t kMostLineBytes = 512;  // that are looked at: of a face at most ten numbers

std::unique_ptr<ByteSource> openBeside(const ReadOptions& options, const char* extension) {
  return unwrapped(options.watched(openFile(withExtension(options.path, extension))));
}

// Numbers of the next line that is no comment, which stays the next one.
size_t numbersOfNextLine(FileScan& file) {
  file.peekWord();
  const std::string_view text = file.peekBytes(kMostLineBytes);
  const std::string_view line = text.substr(0, text.find_first_of("\n#"));
  size_t numbers = 0;
  for (size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos; ++numbers)
    at = std::min(line.find_first_of(" \t\r", at), line.size());
  return numbers;
}

class TetgenReader {
 public:
  // The points, whose numbers tell whether all count from 0 or from 1.
  TetgenReader(std::unique_ptr<ByteSource> nodes, const ReadOptions& options)
      : nodes_(std::move(nodes), '#', options.threads),
        threads_(options.threads),
        intake_(nodes_, options, ScalarType::kFloat64) {}

  std::unique_ptr<IndexedSource> read(std::unique_ptr<ByteSource> cells,
                                      std::unique_ptr<ByteSource> faces) {
    readNodes();
    readCells(std::move(cells));
    if (faces) readFaces(std::move(faces));
    return intake_.finish();
  }

 private:
  // Points, 3, attributes, whether there are markers; then rows with the point's number first.
  void readNodes() {
    const auto count = static_cast<uint64_t>(nodes_.integer("the number of points", 0, INT64_MAX));
    nodes_.checkClaim(count, 8, "points");
    if (nodes_.integer("the dimension") != 3)
      nodes_.failHere(Status::kUnsupported, "the dimension is not 3");
    const int64_t attributes = nodes_.integer("the number of attributes", 0, kMostAttributes);
    const bool markers = nodes_.integer("whether there are markers", 0, 1) != 0;
    if (markers) intake_.addPointLabels("marker");
    std::vector<size_t> columns;
    for (int64_t a = 0; a < attributes; ++a)
      columns.push_back(
          intake_.addData({"attribute" + std::to_string(a), 1, ScalarType::kFloat64}, false));
    const bool has_more = hasMore(nodes_, 4 + columns.size() + markers);
    nodes_.expectRows(
        count,
        {{{false, 1}, {true, 3 + columns.size()}, {false, markers ? 1U : 0U}}, nullptr, has_more});
    for (uint64_t i = 0; i < count; ++i) {
      int64_t number;
      nodes_.integers(&number, 1, "the number of a point");
      if (i == 0) first_ = number;
      if ((i == 0 && first_ != 0 && first_ != 1) || number != first_ + static_cast<int64_t>(i))
        nodes_.failBad(textOf("point %lld, where they should count from 0 or 1",
                              static_cast<long long>(number)));
      double position[3];
      nodes_.reals(position, 3, "the position of a point");
      intake_.addPoint(position);
      for (size_t column : columns) {
        double value;
        nodes_.reals(&value, 1, "an attribute of a point");
        intake_.putData(column, i, &value);
      }
      if (markers) intake_.labelPoint(nodes_.integer("the marker of a point"));
      if (has_more) nodes_.passLine();
    }
  }

  // Whether the rows that follow have more numbers than the file's first line tells: some programs
  // write them, and TetGen passes over them.
  bool hasMore(FileScan& file, size_t told) {
    const size_t numbers = numbersOfNextLine(file);
    if (numbers <= told) return false;
    intake_.note((&file == &nodes_ ? "" : "of " + file.name() + " ") +
                 "what each line has at its end is left out: " + std::to_string(numbers - told) +
                 " more than its header tells");
    return true;
  }

  void readCorners(FileScan& file, size_t count, int64_t* corners) {
    const auto points = static_cast<int64_t>(intake_.mesh().pointCount());
    file.integers(corners, count, "a corner of a cell", first_, first_ + points - 1);
    for (size_t k = 0; k < count; ++k) corners[k] -= first_;
  }

  // Cells, corners of each (4, or 10 of second order), attributes: the first one is the region.
  void readCells(std::unique_ptr<ByteSource> bytes) {
    FileScan file(std::move(bytes), '#', threads_);
    const auto count = static_cast<uint64_t>(file.integer("the number of cells", 0, INT64_MAX));
    file.checkClaim(count, 10, "cells");
    const int64_t nodes = file.integer("the number of corners", 4, 10);
    if (nodes != 4 && nodes != 10) file.failBad("cells with neither 4 nor 10 points");
    const int64_t attributes = file.integer("the number of attributes", 0, kMostAttributes);
    std::vector<size_t> columns;
    for (int64_t a = 0; a < attributes; ++a)
      columns.push_back(
          intake_.addCellNumbers(a == 0 ? "region" : "attribute" + std::to_string(a)));
    const CellKind kind = {CellShape::kTetra, static_cast<int>(nodes)};
    const auto corner_count = static_cast<size_t>(nodes);
    const bool has_more = hasMore(file, 1 + corner_count + columns.size());
    file.expectRows(count,
                    {{{false, 1 + corner_count}, {true, columns.size()}}, nullptr, has_more});
    for (uint64_t i = 0; i < count; ++i) {
      int64_t number;
      file.integers(&number, 1, "the number of a cell");
      int64_t corners[10];
      readCorners(file, corner_count, corners);
      intake_.addCell(kind, corners, nullptr, number);
      for (size_t column : columns) {
        double value;
        file.reals(&value, 1, "an attribute of a cell");
        intake_.putData(column, i, &value);
      }
      if (has_more) file.passLine();
    }
  }

  // Faces, whether there are markers; rows of the face's number, its nodes, the marker and perhaps
  // the cells on both sides. Those of second order have six nodes, which nothing says but the
  // length of the rows: of others it is 5 or 7. The cells do not tell: faces may be of first order
  // beside them.
  void readFaces(std::unique_ptr<ByteSource> bytes) {
    FileScan file(std::move(bytes), '#', threads_);
    const auto count = static_cast<uint64_t>(file.integer("the number of faces", 0, INT64_MAX));
    file.checkClaim(count, 8, "faces");
    const bool markers = file.integer("whether there are markers", 0, 1) != 0;
    if (!markers) return intake_.leaveOut("faces without markers", count);
    const size_t nodes = numbersOfNextLine(file) < 1 + 6 + 1 ? 3 : 6;
    const CellKind kind = {CellShape::kTriangle, static_cast<int>(nodes)};
    file.expectRows(count, {{{false, 2 + nodes}}, nullptr, true});
    for (uint64_t i = 0; i < count; ++i) {
      file.integer("the number of a face");
      int64_t corners[6];
      readCorners(file, nodes, corners);
      const int64_t label = file.integer("the marker of a face");
      file.passLine();  // the cells on both sides
      if (label == 0)
        intake_.leaveOut("faces whose marker is 0");
      else
        intake_.addFace(kind, corners, label);
    }
  }

  FileScan nodes_;
  const TextThreads threads_;
  MeshIntake intake_;
  int64_t first_ = 0;
};

}  // namespace

Input openTetgen(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  if (options.path.empty())
    fail(Status::kUnsupported,
         "%s: TetGen's meshes are two files, .node and .ele: give the name of one of them",
         bytes->name().c_str());
  bytes.reset();
  const std::string face = withExtension(options.path, ".face");
  TetgenReader reader(openBeside(options, ".node"), options);
  Input input;
  input.indexed = reader.read(openBeside(options, ".ele"),
                              exists(face) ? openBeside(options, ".face") : nullptr);
  return input;
}

}  // namespace tetstream
