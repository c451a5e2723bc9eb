#include "collapse.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetstream {

template <class Mesh>
Collapser<Mesh>::Collapser(Core<S>& core, Mesh& mesh, Tally& tally, Account& account)
    : core_(core),
      mesh_(mesh),
      tally_(tally),
      refusals_(account),
      thin_counts_(core, mesh, account),
      sound_(account),
      link_(account),
      crossing_(mesh, account),
      edge_faces_(mesh, core.window.faces),
      stars_(account),
      place_(core, mesh) {}

template <class Mesh>
void Collapser<Mesh>::forget() {
  refusals_.forget();
  thin_counts_.forget();
  sound_.forget();
}

template <class Mesh>
StarShape Collapser<Mesh>::shapeFrom(const S* place, const StarCell* cells, size_t count,
                                     const ThinAngle& angle) const {
  const double x[3] = {static_cast<double>(place[0]), static_cast<double>(place[1]),
                       static_cast<double>(place[2])};
  return starShape(x, mesh_.allValues(), mesh_.valueStride(), static_cast<double>(core_.scale[0]),
                   cells, count, angle);
}

// Whether the share of thin cells in the two stars would not grow, so that in the end it is no
// larger than in the input.
template <class Mesh>
bool Collapser<Mesh>::thinsOut(uint32_t u, uint32_t v, typename Thin::Angle angle, size_t after) {
  if (after == 0) return true;
  const size_t before = thin_counts_.count(u, v, stars_, angle);
  if (before == 0 && core_.shapesFirst()) {
    sound_.add(u);
    sound_.add(v);
  }
  const size_t left = stars_.u.size() + stars_.v.size();
  return after * (left + stars_.ring.size()) <= before * left;
}

// `after`: below the first dear angle, the last and the floor; without a price all below the floor.
template <class Mesh>
Outcome Collapser<Mesh>::thins(uint32_t u, uint32_t v, float most_price, const StarShape& after) {
  const bool is_priced = isPriced(most_price);
  if (!thinsOut(u, v, Thin::kFloor, is_priced ? after.inner : after.thin)) return Outcome::kThin;
  if (!is_priced) return Outcome::kDone;
  if (core_.isFlat()) {
    const size_t flat = thin_counts_.count(u, v, stars_, Thin::kLastDear);
    const size_t left = stars_.u.size() + stars_.v.size();
    price_ = std::max(price_, flatPrice(flat, after.middle, stars_.ring.size(), left));
  }
  const float price = thinPrice(core_.shapesFirst());
  if (price_ < price && !thinsOut(u, v, Thin::kFirstDear, after.thin)) price_ = price;
  return price_ > most_price ? Outcome::kDear : Outcome::kDone;
}

template <class Mesh>
Outcome Collapser<Mesh>::refuseFor(uint32_t u, uint32_t v, const StarCell& turned) {
  refusals_.put(u, v, turned.cell);
  return Outcome::kOrientation;
}

// Whether the cell that the edge was refused for is still there and would be turned over now, too,
// or thin. Slots may have changed hands since: any cell of one end tells.
template <class Mesh>
bool Collapser<Mesh>::turnsSameCell(uint32_t u, uint32_t v, const ThinAngle& angle) const {
  const uint32_t* const last = refusals_.find(u, v);
  if (!last || *last >= mesh_.cellEnd() || !mesh_.isLive(*last)) return false;
  uint32_t ends = 0, at = 0;
  for (uint32_t j = 0; j < 4; ++j) {
    const uint32_t x = mesh_.vertexOf(*last, j);
    if (x != u && x != v) continue;
    ++ends;
    at = 4 * *last + j;
  }
  if (ends != 1) return false;
  const StarCell cell = mesh_.starCell(at);
  return !shapeFrom(place_.values().data(), &cell, 1, angle).positive;
}

template <class Mesh>
Embedded Collapser<Mesh>::embedded() const {
  Embedded e{{}, &core_.window.curves, false, mesh_.vertexSlots()};
  if (core_.interfaces) e.labels = core_.cellLabels();
  e.labels.slots = mesh_.cellSlots();
  e.inner_sheets = core_.inner_sheets;
  return e;
}

template <class Mesh>
StrataCondition::End Collapser<Mesh>::strataEnd(uint32_t v, const Embedded& embedded) const {
  return {v, embedded.stratumOf(v, mesh_.allFlags()[v] & kOnSheet), mesh_.isBoundary(v)};
}

template <class Mesh>
auto Collapser<Mesh>::strataOf(uint32_t u, uint32_t v) const -> Strata {
  Strata strata;
  if (core_.interfaces || core_.inner_sheets || !core_.window.curves.empty())
    strata.embedded = embedded();
  if (!strata.any()) return strata;
  strata.u = strataEnd(u, strata.embedded);
  strata.v = strataEnd(v, strata.embedded);
  return strata;
}

// The vertex behind v on its curve, seen from `before`; kNone if there is none.
template <class Mesh>
uint32_t Collapser<Mesh>::nextOnCurve(uint32_t v, uint32_t before, const Star& star,
                                      const Star& ring, const Embedded& embedded) const {
  const uint8_t* const flags = mesh_.allFlags();
  for (const Star* part : {&star, &ring})
    for (const StarCell& s : *part)
      for (uint32_t t : s.t)
        if (t != before && (flags[t] & kOnSheet) && embedded.onCurve(v, t)) return t;
  return kNone;
}

// Moves the place of two vertices of a curve; false if it stays.
template <class Mesh>
bool Collapser<Mesh>::keepCurveArea(uint32_t u, uint32_t v, const Embedded& embedded) {
  const uint32_t behind_u = nextOnCurve(u, v, stars_.u, stars_.ring, embedded);
  const uint32_t behind_v = nextOnCurve(v, u, stars_.v, stars_.ring_from_v, embedded);
  return behind_u != kNone && behind_v != kNone && place_.keepCurveArea(behind_u, behind_v);
}

// As they are told apart, whether or not there is an interface so far.
template <class Mesh>
CellLabels Collapser<Mesh>::regions() const {
  if (core_.region_picks.empty()) return {};
  CellLabels labels = core_.cellLabels();
  labels.slots = mesh_.cellSlots();
  return labels;
}

template <class Mesh>
auto Collapser<Mesh>::intoCurve() -> Adjusted {
  constexpr double kThere[3] = {0, 0, 0};
  const CellLabels labels = regions();
  if (!place_.changesVolumes(stars_, labels)) return {place_.error()};
  if (place_.givesUpRegion(labels, kThere)) return {std::numeric_limits<S>::infinity()};
  if (place_.driftsOff(labels, core_.tally, tally_)) {
    tally_.drift_reached = true;
    return {std::numeric_limits<S>::infinity()};
  }
  drifts_ = true;
  return {place_.error(), kIntoCurve};
}

// The place that sheets and curves want.
template <class Mesh>
auto Collapser<Mesh>::adjust(uint32_t u, uint32_t v, const Strata& strata) -> Adjusted {
  const bool u_on_it = strata.u.stratum == Stratum::kCurve;
  const bool v_on_it = strata.v.stratum == Stratum::kCurve;
  const CellLabels& labels = strata.embedded.labels;
  if (core_.exact_curves && (u_on_it || v_on_it) && place_.putOnCurve(u_on_it, v_on_it))
    return intoCurve();
  bool moved = core_.keeps_body && place_.putOnPlanes(planesRound(strata));
  const SheetSides* sides = nullptr;
  if (core_.inner_sheets) {
    moved |= u_on_it && v_on_it && keepCurveArea(u, v, strata.embedded);
    const bool is_labelled = !(labelled_.u.empty() && labelled_.v.empty());
    if (is_labelled && sides_.find(stars_, labels, labelled_) > 1) sides = &sides_;
  }
  if (sides || labels.count > 0 || keepsBody(u, v))
    return {place_.keepVolumes(stars_, labels, sides)};
  return {moved ? place_.error() : S(0)};
}

// `ring` as gathered from one end, towards the other.
template <class Mesh>
bool Collapser<Mesh>::mayKeepStrata(const Strata& strata, uint32_t other, const Star& ring) const {
  const bool in_labelled =
      core_.inner_sheets && strata.onSheets() && edge_faces_.holdEdge(ring, other);
  return StrataCondition::mayHold(strata.u, strata.v, ring, strata.embedded, in_labelled);
}

// Of the stars as gathered: the faces of the boundary, and those of all sheets where there are
// others.
template <class Mesh>
void Collapser<Mesh>::listSheets(uint32_t u, uint32_t v, const Strata& strata) {
  if (mesh_.isBoundary(u) || mesh_.isBoundary(v)) crossing_.list(u, v, stars_);
  const uint8_t* const flags = mesh_.allFlags();
  has_others_ = strata.any() && ((flags[u] | flags[v]) & kInterface);
  if (core_.inner_sheets) {
    labelled_.u.clear();
    labelled_.v.clear();
    if (flags[u] & kInterface) edge_faces_.list(stars_.u, stars_.ring, labelled_.u);
    if (flags[v] & kInterface) edge_faces_.list(stars_.v, stars_.ring_from_v, labelled_.v);
  }
  if (has_others_) listStrata(strata);
}

template <class Mesh>
void Collapser<Mesh>::listStrata(const Strata& strata) {
  strata_.list(strata.u, strata.v, stars_, mesh_.allFlags(), strata.embedded, labelled_);
}

// Of the sheets as listed.
template <class Mesh>
AxisPlanes<typename Mesh::Scalar> Collapser<Mesh>::planesRound(const Strata& strata) const {
  AxisPlanes<S> planes(place_.roundingOfPlanes());
  if (!has_others_)
    crossing_.addTo(planes);
  else
    strata_.forFaces(strata.u, strata.v, [&](uint32_t x, uint32_t a, uint32_t b) {
      planes.add(mesh_.values(x), mesh_.values(a), mesh_.values(b));
    });
  return planes;
}

// Of the stars as gathered.
template <class Mesh>
bool Collapser<Mesh>::keepsTopology(uint32_t u, uint32_t v, const Strata& strata) {
  if (!link_.holds({u, mesh_.isBoundary(u)}, {v, mesh_.isBoundary(v)}, stars_)) return false;
  if (!strata.any()) return true;
  if (!has_others_) listStrata(strata);
  return strata_.holds(strata.u, strata.v, strata.embedded);
}

// To the place that sheets and curves want, if that may be had.
template <class Mesh>
Outcome Collapser<Mesh>::moveOnSheets(uint32_t u, uint32_t v, const Strata& strata, S* error,
                                      float most_price) {
  const Adjusted moved = adjust(u, v, strata);
  if (!std::isfinite(moved.error)) return Outcome::kVolume;
  if (!place_.isFinite()) return Outcome::kNotFinite;
  price_ = growthPrice(*error, moved.error * S(moved.cost));
  if (price_ > most_price) return Outcome::kDear;
  if (isTooLarge(moved.error)) return Outcome::kTooLarge;
  *error = std::max(*error, moved.error);
  return Outcome::kDone;
}

// Half of all edges fail, most of them by the cells of the end that moves most: at the place that
// the errors want, and then also at one that sheets want, which is near.
template <class Mesh>
Outcome Collapser<Mesh>::test(uint32_t u, uint32_t v, S* error, int64_t least_cells,
                              float most_price) {
  price_ = 1;
  drifts_ = false;
  if (!mesh_.isFree(u) || !mesh_.isFree(v)) return Outcome::kLocked;
  if (!place_.isFinite()) return Outcome::kNotFinite;
  // Where no cell is thin none may become so: the first one tells.
  ThinAngle angle = core_.thin;
  angle.barred = sound_.has(u) && sound_.has(v);
  if (turnsSameCell(u, v, angle)) return Outcome::kOrientation;
  const bool u_first = place_.isFartherFromU();
  const auto gather = [&](bool of_u) {
    if (of_u)
      mesh_.gather(u, v, stars_.u, stars_.ring);
    else
      mesh_.gather(v, u, stars_.v, stars_.ring_from_v);
  };
  gather(u_first);
  const Star& ring = u_first ? stars_.ring : stars_.ring_from_v;
  const auto dying = static_cast<int64_t>(ring.size());
  if (dying == 0) return Outcome::kTopology;  // no edge any more
  if (mesh_.liveCells() - dying < least_cells) return Outcome::kTooMany;
  const Strata strata = strataOf(u, v);
  if (strata.any() && !mayKeepStrata(strata, u_first ? v : u, ring)) return Outcome::kTopology;
  if (isPriced(most_price)) {
    angle = core_.dear.front();
    angle.inner_cos2 = core_.thin.cos2;
    if (core_.isFlat()) angle.middle_cos2 = core_.dear.back().cos2;
  }
  const Star& farther = u_first ? stars_.u : stars_.v;
  StarShape a = shapeFrom(place_.values().data(), farther.begin(), farther.size(), angle);
  if (!a.positive) return refuseFor(u, v, farther[a.turned]);
  gather(!u_first);
  const bool on_sheet = (mesh_.allFlags()[u] | mesh_.allFlags()[v]) & kOnSheet;
  if (on_sheet) listSheets(u, v, strata);
  if (on_sheet && (strata.any() || keepsBody(u, v))) {
    if (const Outcome o = moveOnSheets(u, v, strata, error, most_price); o != Outcome::kDone)
      return o;
    a = shapeFrom(place_.values().data(), farther.begin(), farther.size(), angle);
    if (!a.positive) return refuseFor(u, v, farther[a.turned]);
  }
  const Star& nearer = u_first ? stars_.v : stars_.u;
  const StarShape b = shapeFrom(place_.values().data(), nearer.begin(), nearer.size(), angle);
  if (!b.positive) return refuseFor(u, v, nearer[b.turned]);
  const StarShape both = {true, a.thin + b.thin, a.middle + b.middle, a.inner + b.inner, 0};
  if (const Outcome o = thins(u, v, most_price, both); o != Outcome::kDone) return o;
  if (!keepsTopology(u, v, strata)) return Outcome::kTopology;
  if ((mesh_.isBoundary(u) || mesh_.isBoundary(v)) &&
      crossing_.find(place_.values().data(), static_cast<double>(core_.scale[0])))
    return Outcome::kCrossing;
  leaves_thin_ = both.thin > 0;
  return Outcome::kDone;
}

// What merging two vertices adds to the error of the whole.
template <class Mesh>
double Collapser<Mesh>::growth(uint32_t u, uint32_t v, S error) {
  const int last = core_.window.shape().quadric - 1;
  return static_cast<double>(error) - static_cast<double>(mesh_.quadric(u)[last]) -
         static_cast<double>(mesh_.quadric(v)[last]);
}

template <class Mesh>
Outcome Collapser<Mesh>::collapse(uint32_t u, uint32_t v, const S* z, S error, int64_t least_cells,
                                  float most_price) {
  if (place_.set(u, v, z)) error = std::max(error, place_.error());
  Outcome outcome = Outcome::kNotFinite;
  if (isTooLarge(error)) {
    outcome = Outcome::kTooLarge;
  } else if (std::isfinite(error)) {
    outcome = test(u, v, &error, least_cells, most_price);
    if (outcome == Outcome::kDone && passesLimit(u, v, error)) {
      tally_.error_reached = true;
      outcome = Outcome::kTooFar;
    }
  }
  tally_.count(outcome);
  if (outcome == Outcome::kDone) {
    mergeInto(u, v, error);
    if (core_.shapesFirst()) sound_.merged(u, stars_, leaves_thin_);
  }
  return outcome;
}

template <class Mesh>
bool Collapser<Mesh>::passesLimit(uint32_t u, uint32_t v, S error) {
  return core_.errorWith(tally_) + growth(u, v, error) > core_.error_limit;
}

template <class Mesh>
void Collapser<Mesh>::mergeInto(uint32_t u, uint32_t v, S error) {
  const double grown = growth(u, v, error);
  tally_.error += grown;
  if (drifts_) place_.addDrifts(regions(), tally_);
  if (core_.window.shape().errors) addError(mesh_.slotOf(u), mesh_.slotOf(v), grown);
  if (core_.plan.values > core_.plan.dimension) place_.interpolateCarried(stars_);
  if (core_.plan.picks > 0 && place_.isFartherFromU())
    std::copy_n(mesh_.picks(v), core_.plan.picks, mesh_.picks(u));
  if (core_.plan.cell_means > 0) handOverCellData(u, v);
  if (core_.window.faces.anyPlaced()) edge_faces_.handOver(u, v, stars_);
  const double in_users_terms = static_cast<double>(error) * core_.error_unit;
  if (core_.tracer) trace(u, v, in_users_terms);
  mesh_.merge(u, v, stars_);
  thin_counts_.merged(stars_);
  core_.window.curves.merge(mesh_.slotOf(u), mesh_.slotOf(v));
  std::copy(place_.values().begin(), place_.values().end(), mesh_.values(u));
  S *a = mesh_.quadric(u), *b = mesh_.quadric(v);
  const int last = core_.window.shape().quadric - 1;
  for (int i = 0; i < last; ++i) a[i] += b[i];
  a[last] = error;
  tally_.largest_error = std::max(tally_.largest_error, in_users_terms);
}

template <class Mesh>
void Collapser<Mesh>::addError(uint32_t u, uint32_t v, double grown) {
  Window<S>& window = core_.window;
  window.error(u) += window.error(v) + std::max(static_cast<float>(grown), 0.0f);
}

template <class Mesh>
void Collapser<Mesh>::handOverCellData(uint32_t u, uint32_t v) {
  double place[3];
  for (size_t i = 0; i < 3; ++i) place[i] = static_cast<double>(place_.values()[i]);
  swept_data_.handOver(mesh_, u, v, stars_, place, static_cast<double>(core_.scale[0]),
                       embedded().labels, core_.plan.cell_means);
}

// Before the mesh changes: the cells are those of the stars, with the merged vertex at their
// centres.
template <class Mesh>
void Collapser<Mesh>::trace(uint32_t u, uint32_t v, double error) {
  traced_before_.clear();
  traced_after_.clear();
  if (core_.tracer->tracesPoints()) {
    const auto put = [](const S* from, double to[3]) {
      for (int i = 0; i < 3; ++i) to[i] = static_cast<double>(from[i]);
    };
    for (const Star* star : {&stars_.u, &stars_.v})
      for (const StarCell& s : *star) {
        PlacedCell& cell = traced_after_.emplace_back();
        cell.cell = mesh_.cellSlotOf(s.cell);
        put(place_.values().data(), cell.corner[0]);
        for (int k = 0; k < 3; ++k) put(mesh_.values(s.t[k]), cell.corner[k + 1]);
        traced_before_.push_back(cell.cell);
      }
    for (const StarCell& s : stars_.ring) traced_before_.push_back(mesh_.cellSlotOf(s.cell));
  }
  core_.tracer->collapsed({mesh_.slotOf(u), mesh_.slotOf(v), mesh_.values(u), mesh_.values(v),
                           place_.values().data(), error, traced_before_, traced_after_});
}

template class Collapser<Window<float>>;
template class Collapser<Window<double>>;
template class Collapser<Patch<float>>;
template class Collapser<Patch<double>>;

}  // namespace tetstream
