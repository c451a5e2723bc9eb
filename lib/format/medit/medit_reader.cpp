// Reads MEDIT's meshes, text (.mesh) and binary (.meshb), versions 1 to 4, in one go, with the
// solutions that lie beside them (.sol, .solb); rows of binary files where they lie. Vertices are
// numbered from 1; references are the labels of cells and faces.
#include <algorithm>

#include "medit_format.h"
#include "medit_required.h"
#include "medit_scan.h"
#include "medit_sol.h"
#include "mesh_intake.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kMostMeditNodes = 27;

class MeditReader {
 public:
  MeditReader(std::unique_ptr<ByteSource> bytes, const ReadOptions& options)
      : scan_(std::move(bytes), options.threads),
        options_(options),
        // note: text of version 1 is written with a double's digits by many.
        intake_(
            scan_.file(), options,
            scan_.binary() && scan_.version() == 1 ? ScalarType::kFloat32 : ScalarType::kFloat64),
        required_(options.temp_dir) {
    const bool wide = scan_.version() == 4;
    intake_.addLabels(kMeditReference, wide);
    intake_.addPointLabels(kMeditReference, wide);
    if (!options.path.empty()) solution_ = options.watched(openMeditSolution(options.path));
  }

  std::unique_ptr<IndexedSource> read() {
    for (MeditSection section; scan_.next(&section);) readSection(section);
    if (!scan_.saysEnd()) intake_.note(std::string("it ") + kNoEnd);
    if (!any_vertices_) scan_.file().failBad("there are no Vertices");
    rows_.points = intake_.mesh().pointCount();
    required_.lock(scan_.file(), intake_);
    readSolutions();
    return intake_.finish();
  }

 private:
  void readSection(const MeditSection& section) {
    const MeditKeyword* keyword = section.number ? meditKeyword(section.number) : nullptr;
    if (section.number == kMeditDimension) {
      readDimension();
    } else if (section.number == kMeditVertices) {
      readVertices();
    } else if (section.number == kMeditEdges) {
      readEdges();
    } else if (section.number == kMeditRequiredVertices) {
      readRequiredVertices();
    } else if (section.number == kMeditRequiredEdges) {
      required_.readEdges(scan_, intake_);
    } else if (section.number == kMeditRequiredTriangles) {
      required_.readTriangles(scan_, intake_);
    } else if (section.number == kMeditSolAtVertices || section.number == kMeditSolAtTetrahedra) {
      rows_.points = intake_.mesh().pointCount();
      solutions_.read(scan_, intake_, rows_, section.number == kMeditSolAtTetrahedra);
    } else if (keyword && keyword->kind) {
      readCells(section, *keyword->kind);
    } else {
      leaveOut(section);
    }
  }

  void readDimension() {
    const int64_t dimension = scan_.small("the dimension");
    if (dimension != 3)
      scan_.file().failHere(Status::kUnsupported, textOf("dimension %lld; only 3 is read",
                                                         static_cast<long long>(dimension)));
  }

  void readVertices() {
    if (any_vertices_) scan_.file().failBad("a second section of Vertices");
    any_vertices_ = true;
    const uint64_t count = scan_.rows(1, 3, "vertices");
    if (placeVertices(count)) return;
    double position[3];
    scan_.expectRows(count, {{{true, 3}, {false, 1}}});
    for (uint64_t i = 0; i < count; ++i) {
      int64_t reference;
      scan_.reals(position, 3, "the position of a vertex");
      scan_.integers(&reference, 1, "the reference of a vertex");
      intake_.addPoint(position);
      intake_.labelPoint(reference);
    }
  }

  // Whether they can be read where they lie.
  bool placeVertices(uint64_t count) {
    const auto rows = scan_.rowsHere(count, 1, 3);
    if (!rows || !intake_.mayPlacePoints()) return false;
    const NumbersOfRow position = scan_.realsOfRow(0, 3);
    intake_.placePoints(*rows, position);
    intake_.placePointLabels(*rows, scan_.integersOfRow(3 * position.width, 1));
    scan_.pass(*rows, "the vertices");
    return true;
  }

  // Corners may be told before there are vertices; the intake checks them then.
  void readCells(const MeditSection& section, CellKind kind) {
    const auto nodes = static_cast<size_t>(kind.nodes);
    const uint64_t count = scan_.rows(nodes + 1, 0, section.name.c_str());
    if (section.number == kMeditTetrahedra) {
      rows_.first_tetrahedron = intake_.cellCount();
      rows_.tetrahedra = count;
    }
    if (section.number == kMeditTriangles)
      required_.addTriangles(intake_.mesh().faceCount(), count);
    if (placeTetrahedra(kind, count)) return;
    const auto corners = static_cast<size_t>(cornersOf(kind.shape));
    const bool is_cell = dimensionOf(kind.shape) == 3;
    const int64_t last = lastVertex();
    int64_t room[kMostMeditNodes + 1], ranks[kMostMeditNodes];
    scan_.expectRows(count, {{{false, nodes + 1}}});
    for (uint64_t i = 0; i < count; ++i) {
      const int64_t* const row = scan_.integersHere(room, nodes + 1, section.name.c_str());
      for (size_t k = 0; k < corners; ++k) {
        checkVertex(row[k], last);
        ranks[k] = row[k] - 1;  // only now: the least integer has none before it
      }
      if (is_cell)
        intake_.addCell(kind, ranks, row + nodes, static_cast<int64_t>(i + 1));
      else
        intake_.addFace(kind, ranks, row[nodes]);
    }
  }

  // For those that are required.
  void readEdges() {
    const uint64_t count = scan_.rows(3, 0, "edges");
    int64_t edge[3];
    scan_.expectRows(count, {{{false, 3}}});
    for (uint64_t i = 0; i < count; ++i) {
      scan_.integers(edge, 3, "an edge");
      required_.addEdge(edge[0], edge[1]);
    }
  }

  // As placeVertices.
  bool placeTetrahedra(CellKind kind, uint64_t count) {
    if (kind.shape != CellShape::kTetra || !any_vertices_ || !intake_.mayPlaceCells()) return false;
    const auto nodes = static_cast<size_t>(kind.nodes);
    const auto rows = scan_.rowsHere(count, nodes + 1, 0);
    if (!rows) return false;
    const int64_t last = lastVertex();
    const auto vertices = std::make_shared<TagTable>(options_.temp_dir);
    vertices->addRun(1, 0, last);
    int64_t twice;
    vertices->finish(&twice);
    const size_t width = scan_.integersOfRow(0, 1).width;
    intake_.placeCells(kind, {*rows, {0, width, false}, vertices, [last](int64_t, int64_t vertex) {
                                return notOneOf(vertex, last);
                              }});
    intake_.placeCellLabels(0, *rows, scan_.integersOfRow(nodes * width, 1));
    scan_.pass(*rows, "the tetrahedra");
    return true;
  }

  int64_t lastVertex() {
    return any_vertices_ ? static_cast<int64_t>(intake_.mesh().pointCount()) : INT64_MAX;
  }

  void checkVertex(int64_t vertex, int64_t last) {
    if (vertex < 1 || vertex > last) failVertex(vertex);
  }

  [[noreturn]] void failVertex(int64_t vertex) {
    scan_.file().failBad(notOneOf(vertex, static_cast<int64_t>(intake_.mesh().pointCount())));
  }

  static std::string notOneOf(int64_t vertex, int64_t last) {
    return textOf("vertex %lld, where there are 1 to %lld", static_cast<long long>(vertex),
                  static_cast<long long>(last));
  }

  void readRequiredVertices() {
    const uint64_t count = scan_.rows(1, 0, "required vertices");
    for (uint64_t i = 0; i < count; ++i) {
      int64_t vertex;
      scan_.integers(&vertex, 1, "a required vertex");
      if (!any_vertices_) continue;
      checkVertex(vertex, lastVertex());
      intake_.mesh().lock(static_cast<uint64_t>(vertex - 1));
    }
    if (!any_vertices_ && count > 0)
      intake_.leaveOut("required vertices, which come before the vertices,", count);
  }

  void leaveOut(const MeditSection& section) {
    intake_.note("the section " + section.name + " is left out");
    scan_.skip();
  }

  void readSolutions() {
    if (!solution_) return;
    intake_.note("its solutions are read from " + solution_->name());
    MeditScan scan(std::move(solution_), options_.threads);
    solutions_.readFile(scan, intake_, rows_);
  }

  MeditScan scan_;
  const ReadOptions& options_;
  MeshIntake intake_;
  MeditRequired required_;
  MeditSolutions solutions_;
  MeditRows rows_;
  std::unique_ptr<ByteSource> solution_;  // beside the mesh; null: none is there
  bool any_vertices_ = false;
};

}  // namespace

Input openMedit(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  Input input;
  input.indexed = MeditReader(std::move(bytes), options).read();
  return input;
}

}  // namespace tetstream
