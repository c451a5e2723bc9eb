// simplify/state: the state that the steps of a run share. Depends on mesh, plan.h, options.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance.h"
#include "front.h"
#include "kernels.h"
#include "label_volumes.h"
#include "options.h"
#include "plan.h"
#include "queued_edges.h"
#include "ranked_cell.h"
#include "star_kernels.h"
#include "tally.h"
#include "tasks.h"
#include "tracer.h"
#include "window.h"

namespace tetstream {

// Vertex flags beside those of topology.h: the boundary round a final vertex is known, and its
// quadric complete.
constexpr uint8_t kResolved = 32;
// Locked by the stream itself, which the output says again.
constexpr uint8_t kCallerLocked = 64;

// Vertices that never move, by reason: what a missed target is explained with.
struct LockedVertices {
  int64_t corners = 0, non_manifold = 0, bad_cells = 0, by_caller = 0;
  bool any() const { return corners + non_manifold + bad_cells + by_caller > 0; }
};

constexpr size_t kCellsPerVertex = 4;  // 5.5 inside a mesh, less towards a boundary

// Points of a map for each cell of the window's capacity that a memory budget is made for, of those
// that stay with the cells that do. More would make the window smaller, fewer let cells go early
// where nothing is left beside it.
constexpr double kTracedPerCell = 0.75;

// Bytes of a row beside its values: of a cell its corners, flags, links or places in tiles; of a
// vertex its flags, rank, new slot or uses, and its first corner or its places in tiles. A queue's
// edges count with the cells.
struct RowBytes {
  size_t cell, vertex;
};
inline RowBytes rowBytes(Mode mode) {
  switch (mode) {
    case Mode::kPaper:
      return {37, 17};
    case Mode::kQueue:
      return {37 + kQueuedPerCell * sizeof(QueuedEdge), 17};
    case Mode::kSweep:
      break;
  }
  return {24, 19};
}
inline RowBytes rowBytes(const SimplifyOptions& options) {
  RowBytes row = rowBytes(options.mode);
  if (options.release == ReleaseOrder::kError) row.cell += sizeof(RankedCell);
  return row;
}

// By what is known before the first cell.
inline bool mayHaveRegions(const Schema& schema, const SimplifyOptions& options) {
  if (options.regions != "auto") return options.regions != "none";
  return std::any_of(schema.cell_data.begin(), schema.cell_data.end(),
                     [](const Column& c) { return !isFloat(c.type) && !namesPartition(c.name); });
}

// Curves and labelled faces lie in hashes of up to four places for each entry, and six while they
// grow. An edge of a curve is there twice, at 8 bytes; one to four cells of the window is allowed
// for, more than real meshes with ridges have: with less a sponge had too large windows. A labelled
// face waits for its cell, at 24 bytes, then has its place, at 16; there are as many to a cell as
// the stream says.
constexpr size_t kCurveBytes = 24, kFaceBytes = 4 * 24 + 6 * 16;
inline size_t embeddedBytes(const Schema& schema, const SimplifyOptions& options) {
  const bool may_have_curves = options.feature_angle > 0 || mayHaveRegions(schema, options);
  if (schema.face_count <= 0) return may_have_curves ? kCurveBytes : 0;
  const auto faces = static_cast<double>(schema.face_count);
  const auto cells = static_cast<double>(std::max<int64_t>(schema.cell_count, 1));
  return kCurveBytes + static_cast<size_t>(kFaceBytes * std::min(faces / cells, 4.0));
}

// No cell needs to be thinner than this smallest dihedral angle, in degrees, unless many of the
// input are: rounding, or another program's arithmetic, may turn it over.
constexpr double kLeastFloor = 0.05;

// Vertices of a patch: with its cells and stars they should fit a core's L2 cache, and its seams
// should be few. Of 2048 a window of four fronts has twice as many for threads to share, but its
// errors at 0.02 were 4 % higher. Where rows are long, with many
// fields, fewer seams are worth more than the cache: on 10^5 cells smaller patches took 1 to 16 %
// longer with 7, 20 and 125 components. A memory budget may want less.
constexpr int64_t kTileVertices = 4096;
// With all that a patch and its sweep hold, of one field. Where all faces are of the boundary, as
// in a wall, the lists of them take a quarter of it.
constexpr int64_t kTileVertexBytes = 700;
constexpr int64_t kOneFieldValues = 4, kOneFieldQuadric = 11;  // numbers, of these

inline int64_t tileVertices(const SimplifyOptions& options, int64_t vertex_bytes) {
  if (options.tile_vertices > 0) return options.tile_vertices;
  if (options.memory_bytes == 0) return kTileVertices;
  return std::clamp<int64_t>(options.memory_bytes / (6 * vertex_bytes), 128, kTileVertices);
}

template <class S>
class ErrorSample;

template <class S>
struct Core {
  Core(const Plan& the_plan, const SimplifyOptions& the_options, Account& account, size_t cells,
       size_t vertices, uint64_t span)
      : plan(the_plan),
        options(the_options),
        kernels(quadricKernels<S>(the_plan.layout, the_plan.dimension)),
        window(account, shapeOf(the_plan), cells, vertices, followsPaper(the_options.mode)),
        front(account, span),
        scale(static_cast<size_t>(the_plan.dimension), S(1)),
        inverse_scale(scale),
        least(scale.size(), -std::numeric_limits<S>::infinity()),
        most(scale.size(), std::numeric_limits<S>::infinity()),
        shape_weight(the_options.shape_weight >= 0    ? the_options.shape_weight
                     : followsPaper(the_options.mode) ? kShapeWeightPaper
                                                      : kShapeWeight),
        thin(0),
        stream_cells(the_plan.schema.cell_count),
        exact_curves(the_options.feature_angle > 0 && the_options.feature_angle < 180),
        keeps_body(!followsPaper(the_options.mode)) {}

  static WindowShape shapeOf(const Plan& plan) {
    return {plan.values,        quadricSize(plan.layout, plan.dimension),
            plan.picks,         plan.cell_means,
            plan.cell_picks,    plan.traces_vertices,
            plan.traces_points, plan.tellsErrors()};
  }

  // What a vertex of a window takes.
  static size_t bytesPerVertex(const Plan& plan, const SimplifyOptions& options) {
    const WindowShape shape = shapeOf(plan);
    return sizeof(S) * static_cast<size_t>(shape.values + shape.quadric) +
           sizeof(int64_t) * static_cast<size_t>(shape.picks) + rowBytes(options).vertex;
  }

  // What a window of one cell takes, with its share of vertices and the steps' own arrays.
  static size_t bytesPerCell(const Plan& plan, const SimplifyOptions& options) {
    const RowBytes row = rowBytes(options);
    const WindowShape shape = shapeOf(plan);
    const size_t vertex = bytesPerVertex(plan, options);
    const size_t data = sizeof(double) * static_cast<size_t>(shape.cell_means + 1) +
                        sizeof(int64_t) * static_cast<size_t>(shape.cell_picks);
    return row.cell + (shape.cell_means + shape.cell_picks ? data : 0) + vertex / kCellsPerVertex;
  }

  // The same with curves and labelled faces, and with what is traced: a vertex's origin; of a map
  // each cell's first point, the way between cells (cell_walk.h), a point for every vertex that is
  // merged, and those of the cells that stay. The cache does not hold them.
  static size_t budgetPerCell(const Plan& plan, const SimplifyOptions& options) {
    constexpr double kPoints = kTracedPerCell + 1.0 / kCellsPerVertex;
    size_t bytes = bytesPerCell(plan, options) + embeddedBytes(plan.schema, options);
    bytes += 1;  // what is tiled is marked: a byte of a vertex, rounded up
    if (plan.tellsErrors())
      bytes += 1 + sampledBytes(plan.dimension) / kCellsPerSampledOfBudget +
               sizeof(float) / kCellsPerVertex;
    if (plan.traces_vertices) bytes += sizeof(int64_t) / kCellsPerVertex;
    if (plan.traces_points)
      bytes += Tracer<S>::kCellBytes + Tracer<S>::kVertexBytes / kCellsPerVertex +
               static_cast<size_t>(kPoints * Tracer<S>::pointBytes());
    return bytes;
  }

  // A point at which errors are measured, with its number and place in a bin and two bins.
  static constexpr size_t kCellsPerSampledOfBudget = 128;
  static size_t sampledBytes(int dimension) {
    return sizeof(S) * static_cast<size_t>(dimension + 3) + sizeof(float) + 3 * sizeof(uint32_t);
  }

  // What a patch takes for a vertex that it owns: its arrays have a quarter to spare, and small
  // ones a rim of as many vertices, whose values are there twice while room is made for them.
  static int64_t tileVertexBytes(const Plan& plan) {
    const WindowShape shape = shapeOf(plan);
    const int64_t values = std::max<int64_t>(shape.values - kOneFieldValues, 0);
    const int64_t quadric = std::max<int64_t>(shape.quadric - kOneFieldQuadric, 0);
    return kTileVertexBytes + static_cast<int64_t>(sizeof(S)) * (5 * quadric / 4 + 4 * values);
  }

  CellLabels cellLabels() const {
    return {window.allCellPicks(), static_cast<size_t>(plan.cell_picks), region_picks.data(),
            static_cast<int>(region_picks.size()), nullptr};
  }

  // Of the window, or of a patch.
  template <class Mesh>
  VertexTable<S> tableOf(const Mesh& mesh) const {
    return {mesh.allQuadrics(), mesh.allValues(), window.shape().quadric, mesh.valueStride()};
  }

  // For what is done to the window; null: by one thread. A memory budget is for one, for a single
  // patch.
  const Tasks* tasks() const {
    const bool several = options.tasks && options.tasks->threads() > 1;
    return several && options.memory_bytes == 0 ? options.tasks : nullptr;
  }

  size_t mostThreads() const {
    return tasks() ? std::min(tasks()->threads(), options.most_threads) : 1;
  }

  // Parts that all of the window is cut into, one for a thread. Each has arrays of its own, so that
  // threads write apart: of many they would take more memory than they save time.
  size_t mostParts() const {
    constexpr size_t kMostParts = 8;
    return std::min(mostThreads(), kMostParts);
  }
  // Where there is little to do another thread would come too late.
  size_t parts() const {
    constexpr int64_t kLeastTiles = 4;  // fewer cells than these have vertices are few
    const int64_t tile = options.tile_vertices > 0 ? options.tile_vertices : kTileVertices;
    const auto worth = static_cast<size_t>(window.mesh.cellEnd() / (kLeastTiles * tile));
    return std::clamp<size_t>(worth, 1, mostParts());
  }

  // Calls work(first, end, part) for each part of so many, in order where one thread works.
  template <class Work>
  void forPartsOf(size_t count, Work work) const {
    const size_t parts = this->parts();
    const auto begin = [&](size_t part) { return static_cast<uint32_t>(count * part / parts); };
    doEach(tasks(), parts, [&](size_t part) { work(begin(part), begin(part + 1), part); });
  }
  // The same for the cells of the window.
  template <class Work>
  void forPartsOfCells(Work work) const {
    forPartsOf(window.mesh.cellEnd(), work);
  }

  // Whether the window has room for the whole stream, or holds all that is left of it.
  bool holdsAll() const {
    return holds_rest || (stream_cells >= 0 && stream_cells <= report.window_cells);
  }
  // Whether more than the price of their error is common among collapses; where the body is kept
  // some have it.
  bool hasPrices() const { return !dear.empty() || interfaces || exact_curves; }
  // Whether the input has so many cells below the smaller of the dear angles that each has its
  // price.
  bool isFlat() const { return dear.size() > 1; }
  // Whether cells are flipped for their shapes more than for the field. Where so many are below a
  // degree, or most are thin, no flips that are small beside the error would bring them above the
  // solver's floor.
  bool shapesFirst() const { return options.shape == Shape::kSolver && !isFlat() && !is_thin; }
  // A log of collapses from which the cells follow has no flips.
  bool flips() const {
    const bool is_logged = tracer && tracer->keepsLog();
    return shapesFirst() || (!dear.empty() && !is_logged);
  }
  // Made so far, with what a part has made that is not added yet.
  double errorWith(const Tally& part) const {
    return (&part == &tally ? 0 : tally.error) + part.error;
  }

  const Plan& plan;
  const SimplifyOptions& options;
  const QuadricKernels<S>& kernels;
  Window<S> window;
  Front front;
  uint64_t reached = 0;  // the vertices up to the last one that a cell of those read has
  std::vector<S> scale, inverse_scale;  // per dimension: normalised = scale * user's units
  std::vector<S> least, most;           // per dimension: the values a merged vertex may have
  double error_unit = 1;                // times a quadric error: the report's unit
  double shape_weight;                  // of a cell's regulariser (kernels.h)
  double face_weight = 0;               // of a face on the boundary, before it is balanced
  Balance balance;
  bool is_tight = false;                 // a memory budget that the whole does not fit into
  double target_ratio = 0;               // cells out of those in; towards an error the usual one
  double balance_ratio = 0;              // that it is chosen for; 0: it is not
  bool weighs_fields = false;            // against each other
  ThinAngle thin;                        // no more cells below than the input has
  double poor = 1;                       // cells thinner than this are worth a flip (thinness.h)
  std::vector<ThinAngle> dear;           // falling, above: more cells below have their price
  std::vector<ThinAngle> dear_when_few;  // instead of none, once few cells are left
  bool is_thin = false;                  // the input, in most of its cells
  // Of the whole stream; negative while nobody knows. One that is read and still there is known.
  int64_t stream_cells;
  // Of all cells read, normalised: volume; the extent of the mesh; the error that may be made.
  double volume = 0, extent = 1;
  double error_limit = std::numeric_limits<double>::infinity();
  // Of an edge that may be taken; and of all vertices, in percent of the range, where that is why.
  double most_error = std::numeric_limits<double>::infinity(), most_percent = 0;
  double most_drift = kMostDrift;  // of a region's volume
  Tally tally;                     // of the whole; parts that are not added yet have their own
  bool holds_rest = false;         // all was read, and what was parked is back (parking.h)
  double rescaled = 1;             // what errors of the last window count in today's units
  bool exact_curves;               // there are curves that the user wants to stay where they are
  bool keeps_body;                 // the volume in the boundary, where there are no regions
  bool interfaces = false;         // met any: labels that are all the same cost nothing
  bool inner_sheets = false;       // met labelled faces with cells of one region on both sides
  bool folds = false;              // met two cells on the same side of their common face
  std::vector<int> region_picks;   // columns of the cell picks that label regions
  LabelVolumes label_volumes;      // of those
  Report report;
  LockedVertices locked;
  Tracer<S>* tracer = nullptr;             // told of all collapses, and of what leaves
  ErrorSample<S>* error_sample = nullptr;  // null: no errors are told
};

// The quadrics tell errors at the vertices, where they are larger than between them, and those
// of the boundary and of shapes beside the fields': on real meshes reduced to 0.5, 0.1 and 0.02 the
// square root of their sum was 1.5 to 4.2 times the RMS error. This share of it is still above.
// Nearer is what is measured (error_sample.h).
constexpr double kErrorShare = 0.8;

// The corners of a cell in the window's units of length, in which no power of theirs is out of
// reach.
template <class S>
void cornersInUnits(const Core<S>& core, uint32_t cell, double corners[4][3]) {
  cornersIn(core.window, cell, corners);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) corners[k][i] *= static_cast<double>(core.scale[0]);
}

// The RMS error in percent of the range that an error over a volume stands for, and back.
template <class S>
double percentOf(const Core<S>& core, double error) {
  if (!(core.volume > 0)) return 0;
  return 100 * kErrorShare * std::sqrt(error / core.volume) / core.extent;
}
template <class S>
double errorOf(const Core<S>& core, double percent) {
  const double share = percent / (100 * kErrorShare) * core.extent;
  return share * share * core.volume;
}

template <class S>
inline void positionOf(const Window<S>& window, uint32_t v, double out[3]) {
  const S* x = window.values(v);
  for (int i = 0; i < 3; ++i) out[i] = static_cast<double>(x[i]);
}

}  // namespace tetstream
