// simplify/collapse: float cell data through a collapse. Depends on mesh.
#pragma once

#include <vector>

#include "embedded.h"
#include "patch.h"

namespace tetstream {

// Where both ends of an edge go to one place, each face that has one of them sweeps a volume on the
// way, out of the cell on one side into that on the other, with what is there (the first-order
// remapping of arbitrary Lagrangian-Eulerian methods). The cells of the edge go all into those
// beyond their faces. What goes out through the boundary, or through an interface between regions,
// comes in where the region gains. So float cell data are means over the cells' own volumes, and
// what they sum up to over each region stays.
class SweptData {
 public:
  // Before v is merged into u, at `place`. A cell's row is its volume, in units of `scale`, and
  // then `means` numbers.
  template <class Mesh>
  void handOver(Mesh& mesh, uint32_t u, uint32_t v, const Stars& stars, const double place[3],
                double scale, const CellLabels& labels, int means);

 private:
  struct Cell {  // of the stars
    uint32_t cell;
    bool dies;
    double* row;
    double before, after;  // volumes
    double own;            // of the volume before, what is handed on as it is not
    double left;           // of one that dies: what has to go
  };
  // A face of a cell that moves: of the kind's faces, by what it has besides.
  enum Kind : uint32_t { kOfU, kOfV, kOfBoth };
  // That was met from one side.
  struct Side {
    uint64_t key;  // the kind and what the face has
    double gain;   // of the cell
    uint32_t cell, round;
  };
  // Of places in the list of cells, or of regions.
  struct Flow {
    uint32_t from, to;
    double volume;
  };
  static constexpr uint32_t kRegion = 1u << 31;

  void start(size_t sides, const CellLabels& labels);
  template <class At>
  void listKept(const At& at, uint32_t centre, const Star& star, Kind kind);
  template <class At>
  void listDying(const At& at, uint32_t u, uint32_t v, const Star& ring);
  void addSide(Kind kind, uint64_t others, double gain);  // of the last cell
  void meet(uint32_t from, uint32_t to, double volume);
  void leave(uint32_t cell, double gain);
  void leaveRest();
  void addFlow(uint32_t from, uint32_t to, double volume);
  uint32_t regionOf(const Cell& cell);
  void copyMeans();
  static bool isRegion(uint32_t place) { return place & kRegion; }
  bool isDying(uint32_t place) const { return !isRegion(place) && cells_[place].dies; }
  // Whether what goes out of one is as it was before anything came in.
  bool leavesAsItWas(uint32_t from, uint32_t to) const {
    return !isRegion(from) && (!cells_[from].dies || isDying(to));
  }
  // The row of means: regions are behind the cells.
  size_t rowOf(uint32_t place) const {
    return isRegion(place) ? cells_.size() + (place & ~kRegion) : place;
  }
  void mix(const std::vector<Flow>& flows);
  void repair();
  void repair(size_t mean, uint32_t region);

  size_t means_ = 0;
  std::vector<Cell> cells_;
  std::vector<Side> sides_;     // a hash, forgotten by counting on
  std::vector<size_t> opened_;  // its places that were taken
  uint32_t round_ = 0;
  CellLabels labels_;
  std::vector<Flow> into_dying_, into_regions_, into_kept_;
  std::vector<uint32_t> regions_;  // of each a cell
  // Of cells: their means before. Of those that die and of regions: of what goes through them.
  std::vector<double> old_, mixed_, mixed_volume_;
};

}  // namespace tetstream
