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
    double own = 0;        // of the volume before, what is handed on as it is not
    double in = 0, out = 0;
  };
  // A face of a cell that moves: of the kind's faces, by what it has besides.
  enum Kind : uint32_t { kOfU, kOfV, kOfBoth };
  struct Side {
    uint64_t others;
    Kind kind;
    uint32_t cell;  // its place in the list
    double gain;    // of the cell
    bool is_met;    // the cell beyond it
  };
  struct Flow {
    uint32_t from, to;  // places in the list of cells, behind it of regions
    double volume;
  };

  template <class At>
  void listKept(const At& at, uint32_t centre, const Star& star, Kind kind);
  template <class At>
  void listDying(const At& at, uint32_t u, uint32_t v, const Star& ring);
  void start(size_t sides);
  void addSide(Kind kind, uint32_t cell, uint64_t others, double gain);
  void listFlows(const CellLabels& labels);
  void addFlow(uint32_t from, uint32_t to, double volume);
  uint32_t regionOf(const Cell& cell, const CellLabels& labels);
  void copyMeans();
  bool isDying(uint32_t place) const { return place < cells_.size() && cells_[place].dies; }
  bool isRegion(uint32_t place) const { return place >= cells_.size(); }
  // Whether what goes out of one is as it was before anything came in.
  bool leavesAsItWas(uint32_t from, uint32_t to) const {
    return !isRegion(from) && (!cells_[from].dies || isDying(to));
  }
  void mix(const std::vector<Flow>& flows);
  void repair(const CellLabels& labels);
  void repair(size_t mean, uint32_t region, const CellLabels& labels);

  size_t means_ = 0;
  std::vector<Cell> cells_;
  std::vector<Side> sides_;
  std::vector<uint32_t> place_of_;  // a hash: of the sides, from 1 on
  std::vector<uint32_t> pairs_;     // sides, two by two
  std::vector<Flow> into_dying_, into_regions_, into_kept_;
  std::vector<uint32_t> regions_;  // of each a cell
  // Of cells: their means before. Of those that die and of regions: of what goes through them.
  std::vector<double> old_, mixed_, mixed_volume_;
};

}  // namespace tetstream
