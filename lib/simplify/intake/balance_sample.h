// simplify/intake: what taking vertices out of the mesh as it comes would cost, from their stars.
// Depends on balance.h, sheet_quadrics.h.
#pragma once

#include <array>

#include "balance.h"
#include "sheet_quadrics.h"

namespace tetstream {

// Used while the quadrics have what they have from cells alone, nothing of sheets.
template <class S>
class BalanceSample {
 public:
  explicit BalanceSample(Core<S>& core);

  static constexpr size_t kSampled = 128;  // vertices of each group
  struct Group {
    std::vector<uint32_t> vertices;  // that are sampled
    size_t of = 0;                   // among so many
    double volume = 0;               // at those
  };
  // What is sampled of the boundary, of interfaces and inside.
  void start(const Group groups[3], bool is_whole);

  // A face of the sheet at a vertex, by its other two.
  struct Face {
    uint32_t a, b;
  };
  // A vertex goes to one of its neighbours, on a sheet along that. Faces of the boundary have one
  // direction of turning.
  void addInside(uint32_t v, const Star& star);
  void addOnSheet(uint32_t v, const std::vector<Face>& faces, const Star& star, SheetFace kind);
  // Of an interface between two regions.
  void addBend(uint32_t v, const std::vector<Face>& faces);
  // A neighbour of each of these on the interface, each once; then the faces there. Another one of
  // those whose neighbours so far lay on rims, as long as too few pairs tell of the interface; none
  // at last.
  std::vector<uint32_t> partners();
  void addPartner(uint32_t v, const std::vector<Face>& faces);

  // Of the vertices of the boundary that are sampled, how many have another one at their place
  // among all of these.
  void addTouching(const std::vector<uint32_t>& sampled, const uint32_t* all, size_t count);

  // How far the boundary has free sight from those of its vertices that were sampled, up to the
  // next of all of its vertices.
  void addGaps(const uint32_t* all, size_t count);

  const RemovalCosts& costs() const { return costs_; }

  // A quarter of the volume of a vertex's cells, normalised; 0 for one without.
  static double volumeAt(Core<S>& core, uint32_t v) {
    const int weight = quadricSize(QuadricLayout::kFields, core.plan.dimension) - 2;
    return static_cast<double>(core.window.quadric(v)[weight]);
  }

 private:
  double fieldErrorTowards(uint32_t v, uint32_t other);
  double errorTowards(const S* quadric, uint32_t v, uint32_t other);
  void keepUnique();
  void edgesOf(uint32_t v, const Face& face, double edges[2][3]) const;
  const std::vector<uint32_t>& creaseAt(uint32_t v, const std::vector<Face>& faces);
  uint64_t placeKey(uint32_t v) const;

  // Of the faces at a vertex of a sheet, in normalised units.
  struct Bend {
    double normal[3] = {0, 0, 0};  // their mean, of length 1
    double height = 0;             // that the mean of the vertices round it has above it
    double edges = 0;              // mean square of the edges to them
    bool is_closed = false;        // no edge of the sheet
  };
  Bend bendAt(uint32_t v, const std::vector<Face>& faces);
  // A look along the normal, away from the cells.
  struct Sight {
    uint32_t from, nearest;
    double place[3], along[3];
    double square;  // of the distance to the nearest
    std::vector<S> sheet;
  };
  void addSight(uint32_t v, const std::vector<Face>& faces, const Star& star);

  struct Pair {
    std::vector<uint32_t> others;  // that are left, the next one last
    uint32_t partner;
    Bend bend;
    bool is_met = false;
  };

  Core<S>& core_;
  RemovalCosts costs_;
  std::vector<S> sheet_, nowhere_, difference_;
  const std::vector<S> nothing_;
  std::vector<uint32_t> others_;
  std::vector<std::array<double, 3>> normals_;
  std::vector<double> field_costs_;
  std::vector<Pair> pairs_;
  std::vector<Sight> sights_;
};

}  // namespace tetstream
