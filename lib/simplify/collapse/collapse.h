// simplify/collapse: whether an edge may be collapsed to a point, and doing it, in the window or in
// a patch of it. Depends on core.h, mesh.
#pragma once

#include "core.h"
#include "crossing.h"
#include "edge_faces.h"
#include "edge_notes.h"
#include "link.h"
#include "merged_place.h"
#include "patch.h"
#include "price.h"
#include "sheet_sides.h"
#include "sound.h"
#include "star_kernels.h"
#include "strata.h"
#include "swept_data.h"
#include "thin_counts.h"

namespace tetstream {

template <class Mesh>
class Collapser {
 public:
  using S = typename Mesh::Scalar;

  // What it does it counts in the tally of the whole,
  Collapser(Core<S>& core, Mesh& mesh, Account& account)
      : Collapser(core, mesh, core.tally, account) {}
  // or of a part.
  Collapser(Core<S>& core, Mesh& mesh, Tally& tally, Account& account);

  Mesh& mesh() { return mesh_; }
  // Before work on another mesh, or on the same again, that is to depend on nothing done before.
  void forget();
  // Whether a collapse was refused for the limit on the error, here or before.
  bool errorReached() const { return core_.tally.error_reached || tally_.error_reached; }

  // Merges v into u at z, normalised and relative to the edge's midpoint, if the result is legal:
  // both vertices free; topology kept; the boundary not pushed through itself; every cell round the
  // merged vertex strictly oriented as before, decided exactly on the values as they will be
  // written, and the share of thin ones no larger; the whole error within its limit; no fewer than
  // `least_cells` cells left in the window. kDear, where it would have a higher price than
  // `most_price`, in its error: more cells below the dear angles have theirs, and so has keeping
  // the volumes of regions, or of the body, where that costs much (price.h).
  Outcome collapse(uint32_t u, uint32_t v, const S* z, S error, int64_t least_cells,
                   float most_price = std::numeric_limits<float>::infinity());
  // Of the edge that was dear.
  float price() const { return price_; }

  // z of an end.
  void endOf(uint32_t u, uint32_t v, bool at_v, S* z) const {
    const S *a = mesh_.values(u), *b = mesh_.values(v);
    for (size_t i = 0; i < core_.scale.size(); ++i) {
      const S half = S(0.5) * ((b[i] - a[i]) * core_.scale[i]);
      z[i] = at_v ? half : -half;
    }
  }

  // The last edge that was tried. After a collapse the two stars are that of the merged vertex.
  const Stars& stars() const { return stars_; }

 private:
  // What is embedded in the cells, and what of it the ends of an edge lie in: known where there is
  // any.
  struct Strata {
    Embedded embedded;
    StrataCondition::End u{}, v{};
    bool any() const { return embedded.any(); }
    bool onSheets() const { return u.stratum != Stratum::kInside && v.stratum != Stratum::kInside; }
  };

  Embedded embedded() const;
  StrataCondition::End strataEnd(uint32_t v, const Embedded& embedded) const;
  Strata strataOf(uint32_t u, uint32_t v) const;
  bool mayKeepStrata(const Strata& strata, uint32_t other, const Star& ring) const;
  void listSheets(uint32_t u, uint32_t v, const Strata& strata);
  void listStrata(const Strata& strata);
  AxisPlanes<S> planesRound(const Strata& strata) const;
  bool keepsTopology(uint32_t u, uint32_t v, const Strata& strata);
  Outcome test(uint32_t u, uint32_t v, S* error, int64_t least_cells, float most_price);
  // The error at a place that was changed, 0 where it was not, and how many times that counts in
  // the edge's price.
  struct Adjusted {
    S error;
    float cost = 1;
  };
  CellLabels regions() const;
  Adjusted intoCurve();
  Adjusted adjust(uint32_t u, uint32_t v, const Strata& strata);
  Outcome moveOnSheets(uint32_t u, uint32_t v, const Strata& strata, S* error, float most_price);
  uint32_t nextOnCurve(uint32_t v, uint32_t before, const Star& star, const Star& ring,
                       const Embedded& embedded) const;
  bool keepCurveArea(uint32_t u, uint32_t v, const Embedded& embedded);
  bool turnsSameCell(uint32_t u, uint32_t v, const ThinAngle& angle) const;
  Outcome refuseFor(uint32_t u, uint32_t v, const StarCell& turned);
  double growth(uint32_t u, uint32_t v, S error);
  bool passesLimit(uint32_t u, uint32_t v, S error);
  bool isTooLarge(S error) const { return static_cast<double>(error) > core_.most_error; }
  // Of a mesh without regions: whether the boundary is there to shrink or grow.
  bool keepsBody(uint32_t u, uint32_t v) const {
    return core_.keeps_body && (mesh_.isBoundary(u) || mesh_.isBoundary(v));
  }
  StarShape shapeFrom(const S* place, const StarCell* cells, size_t count,
                      const ThinAngle& angle) const;
  // Whether its thin cells may cost a collapse more than that.
  bool isPriced(float most_price) const {
    return !core_.dear.empty() &&
           most_price < (core_.isFlat() ? kHighestPrice : thinPrice(core_.shapesFirst()));
  }
  using Thin = ThinCounts<Mesh>;
  Outcome thins(uint32_t u, uint32_t v, float most_price, const StarShape& after);
  bool thinsOut(uint32_t u, uint32_t v, typename Thin::Angle angle, size_t after);
  void mergeInto(uint32_t u, uint32_t v, S error);
  void addError(uint32_t u, uint32_t v, double grown);
  void handOverCellData(uint32_t u, uint32_t v);
  void trace(uint32_t u, uint32_t v, double error);

  Core<S>& core_;
  Mesh& mesh_;
  Tally& tally_;
  bool drifts_ = false;  // the edge that was tested last changes volumes
  // The cell for which an edge was refused: tried again, it mostly is for the same.
  EdgeNotes<uint32_t> refusals_;
  Thin thin_counts_;
  SoundVertices sound_;       // where shapes come first
  bool leaves_thin_ = false;  // the edge that was tested
  float price_ = 1;
  LinkCondition link_;
  StrataCondition strata_;
  BoundaryCrossing<Mesh> crossing_;
  EdgeFaces<Mesh> edge_faces_;
  StrataCondition::Labelled labelled_;  // of the edge that is tested
  bool has_others_ = false;             // sheets beside the boundary, there
  SheetSides sides_;
  Stars stars_;
  MergedPlace<Mesh> place_;
  SweptData swept_data_;
  std::vector<uint32_t> traced_before_;  // in slots of the window
  std::vector<PlacedCell> traced_after_;
};

}  // namespace tetstream
