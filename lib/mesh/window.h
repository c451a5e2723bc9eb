// mesh: the bounded in-core part of the mesh: topology, and what each vertex and cell carries.
// Depends on topology.h, stream (front).
//
// Vertices and cells lie in the order of their arrival; packing keeps it. All arrays are allocated
// for a capacity; they grow only between chunks.
#pragma once

#include <cstring>

#include "embedded.h"
#include "front.h"
#include "labelled_faces.h"
#include "topology.h"

namespace tetstream {

class Tasks;

// What one row carries, fixed for a run. Values are kept in the user's units.
struct WindowShape {
  int values = 3;        // S per vertex: x y z, then components that are interpolated
  int quadric = 0;       // S per vertex
  int picks = 0;         // int64 per vertex: integer fields, picked
  int cell_means = 0;    // double per cell: float cell data
  int cell_picks = 0;    // int64 per cell: integer cell data
  bool origins = false;  // int64 per vertex: where it came from
  bool points = false;   // uint32 per cell: the first of the points traced in it
  bool errors = false;   // float per vertex: the error that was made where it stands
};

// Rows are short: a call would take longer than the copying.
template <class T>
inline void copyRow(const T* from, size_t count, T* to) {
  for (; count >= 4; count -= 4, from += 4, to += 4) std::memcpy(to, from, 4 * sizeof(T));
  for (size_t i = 0; i < count; ++i) to[i] = from[i];
}

template <class S>
class Window {
 public:
  using Scalar = S;
  Window(Account& account, const WindowShape& shape, size_t cells, size_t vertices, bool linked)
      : mesh(account, cells, vertices, linked),
        curves(account),
        faces(account),
        shape_(shape),
        values_(account),
        quadrics_(account),
        picks_(account),
        out_rank_(account),
        origins_(account),
        errors_(account),
        cell_means_(account),
        cell_picks_(account),
        first_points_(account),
        remap_(account) {
    sizeVertices();
    sizeCells();
  }

  Topology mesh;
  Curves curves;
  LabelledFaces faces;

  const WindowShape& shape() const { return shape_; }
  S* values(uint32_t v) { return &values_[size_t{v} * shape_.values]; }
  const S* values(uint32_t v) const { return &values_[size_t{v} * shape_.values]; }
  S* quadric(uint32_t v) { return &quadrics_[size_t{v} * shape_.quadric]; }
  int64_t* picks(uint32_t v) { return &picks_[size_t{v} * shape_.picks]; }
  // Of a vertex that has left: its rank in the output. Until then free for other use.
  uint64_t& outRank(uint32_t v) { return out_rank_[v]; }
  // Where there are origins: the vertex's own in the input, or its complement, below 0, once the
  // vertex stands elsewhere.
  int64_t& origin(uint32_t v) { return origins_[v]; }
  // Where there are errors: what merging vertices into it has added, nothing at first.
  float& error(uint32_t v) { return errors_[v]; }
  // Where there are points: the first one of each cell, or kNone.
  uint32_t* firstPoints() { return first_points_.data(); }
  // Volume that the cell stands for, then the means over it.
  double* cellMeans(uint32_t c) { return &cell_means_[size_t{c} * meansStride()]; }
  int64_t* cellPicks(uint32_t c) { return &cell_picks_[size_t{c} * shape_.cell_picks]; }

  // For steps that work on a window or on a patch of it alike.
  uint32_t cellEnd() const { return mesh.cellEnd(); }
  bool isLive(uint32_t c) const { return mesh.isLive(c); }
  uint32_t vertexOf(uint32_t c, uint32_t j) const { return mesh.corners(c)[j]; }
  StarCell starCell(uint32_t corner) const { return mesh.starCell(corner); }
  int64_t liveCells() const { return mesh.liveCells(); }
  bool isFree(uint32_t v) const { return mesh.isFree(v); }
  bool isBoundary(uint32_t v) const { return mesh.vertexFlags(v) & kBoundary; }
  bool isFreeElsewhere(uint32_t) const { return false; }  // as of a patch
  const int64_t* allCellPicks() const { return cell_picks_.data(); }
  const S* allValues() const { return values_.data(); }
  const S* allQuadrics() const { return quadrics_.data(); }
  const uint8_t* allFlags() const { return mesh.allVertexFlags(); }
  int valueStride() const { return shape_.values; }
  uint32_t slotOf(uint32_t v) const { return v; }
  uint32_t cellSlotOf(uint32_t c) const { return c; }
  const uint32_t* vertexSlots() const { return nullptr; }
  const uint32_t* cellSlots() const { return nullptr; }
  uint32_t cornerSlot(uint32_t corner) const { return corner; }
  void gather(uint32_t v, uint32_t other, Star& star, Star& ring) {
    mesh.gather(v, other, star, ring);
  }
  bool gatherOnBoundary(uint32_t v, size_t most, Star& star) const {
    return mesh.gatherUpTo(v, most, star);
  }
  void merge(uint32_t u, uint32_t v, const Stars& stars) { mesh.merge(u, v, stars); }

  // 32 bits per vertex that no step owns: of use until the next step begins.
  uint32_t* scratch() { return remap_.data(); }

  // So many more cells and vertices will come soon, if the window has room.
  void expect(size_t cells, size_t vertices);

  // When memory does not suffice they throw, and the window is as it was.
  void growCells(size_t capacity);
  void growVertices(size_t capacity);

  // Drops dead cells, and the vertices that are final and in no cell; tells the front. Scratch
  // holds, per vertex, its live cells. Returns how many vertices were dropped that no cell ever
  // used. `tasks`: null, or for rows and cells at the same time.
  uint64_t pack(Front& front, const Tasks* tasks);

 private:
  int meansStride() const { return shape_.cell_means ? 1 + shape_.cell_means : 0; }
  void sizeVertices();
  void sizeCells();
  template <class Visit>
  void forVertexArrays(Visit visit);
  template <class Visit>
  void forCellArrays(Visit visit);
  uint32_t chooseVertices(uint64_t* unused);
  void moveVertices(uint32_t end);
  void packCells(uint32_t kept_vertices);

  WindowShape shape_;
  Array<S> values_, quadrics_;
  Array<int64_t> picks_;
  Array<uint64_t> out_rank_;
  Array<int64_t> origins_;
  Array<float> errors_;
  Array<double> cell_means_;
  Array<int64_t> cell_picks_;
  Array<uint32_t> first_points_;
  Array<uint32_t> remap_;
  size_t expected_cells_ = 0, expected_vertices_ = 0;  // all that were so far
};

template <class S>
inline void cornersIn(const Window<S>& window, uint32_t cell, double corners[4][3]) {
  for (int j = 0; j < 4; ++j) {
    const S* const x = window.values(window.mesh.corners(cell)[j]);
    for (int i = 0; i < 3; ++i) corners[j][i] = static_cast<double>(x[i]);
  }
}

}  // namespace tetstream
