#include "collapse.h"

#include <algorithm>
#include <cmath>

#include "barycentric.h"
#include "curve_area.h"

namespace tetstream {

// Of an edge's length: nearer to it than this is on it.
constexpr double kOnEdge = 1e-3;

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
      merged_(static_cast<size_t>(core.plan.values)),
      z_(static_cast<size_t>(core.plan.dimension)) {}

template <class Mesh>
void Collapser<Mesh>::forget() {
  refusals_.forget();
  thin_counts_.forget();
  sound_.forget();
}

// The new position is rounded to the type in which it is written: what is tested is what the file
// will hold. Where fields are to keep their range, values stay in what is known of it, or in that
// of the two ends where a header has told a narrower one; returns whether z had to give way.
template <class Mesh>
bool Collapser<Mesh>::placeAt(uint32_t u, uint32_t v, S* z) {
  const S *a = mesh_.values(u), *b = mesh_.values(v);
  const bool to_float = core_.plan.schema.position_type == ScalarType::kFloat32;
  bool gave_way = false;
  for (size_t i = 0; i < core_.scale.size(); ++i) {
    const S middle = a[i] + S(0.5) * (b[i] - a[i]);
    S& x = merged_[i] = middle + z[i] * core_.inverse_scale[i];
    if (to_float && i < 3) x = static_cast<S>(static_cast<float>(x));
    if (!(x < core_.least[i] || x > core_.most[i])) continue;
    x = std::clamp(x, std::min({core_.least[i], a[i], b[i]}),
                   std::max({core_.most[i], a[i], b[i]}));
    z[i] = (x - middle) * core_.scale[i];
    gave_way = true;
  }
  return gave_way;
}

// The place goes a step, normalised, and the fields with it to what is best for them there.
template <class Mesh>
void Collapser<Mesh>::moveBy(uint32_t u, uint32_t v, const S step[3]) {
  for (size_t i = 0; i < 3; ++i) z_[i] += step[i];
  core_.kernels.followStep(mesh_.quadric(u), mesh_.quadric(v), core_.plan.dimension, step,
                           z_.data());
  placeAt(u, v, z_.data());
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
  if (price_ < kThinPrice && !thinsOut(u, v, Thin::kFirstDear, after.thin)) price_ = kThinPrice;
  return price_ > most_price ? Outcome::kDear : Outcome::kDone;
}

// Whether u is farther from the new place than v is.
template <class Mesh>
bool Collapser<Mesh>::isFarther(uint32_t u, uint32_t v) const {
  double difference = 0;
  for (size_t i = 0; i < 3; ++i) {
    const auto a = static_cast<double>(merged_[i] - mesh_.values(u)[i]);
    const auto b = static_cast<double>(merged_[i] - mesh_.values(v)[i]);
    difference += a * a - b * b;
  }
  return difference > 0;
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
  return !shapeFrom(merged_.data(), &cell, 1, angle).positive;
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
  const uint32_t chain[4] = {nextOnCurve(u, v, stars_.u, stars_.ring, embedded), u, v,
                             nextOnCurve(v, u, stars_.v, stars_.ring_from_v, embedded)};
  if (chain[0] == kNone || chain[3] == kNone) return false;
  double p[4][3], x[3];
  S step[3];
  for (size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) p[k][i] = static_cast<double>(mesh_.values(chain[k])[i]);
    x[i] = static_cast<double>(merged_[i]);
  }
  if (!keepArea(p[0], p[1], p[2], p[3], x)) return false;
  for (size_t i = 0; i < 3; ++i) step[i] = (static_cast<S>(x[i]) - merged_[i]) * core_.scale[i];
  moveBy(u, v, step);
  return true;
}

// Of the edge merged where it is to be now.
template <class Mesh>
void Collapser<Mesh>::measureVolumes(uint32_t u, uint32_t v, const CellLabels& labels,
                                     const SheetSides* sides) {
  const uint32_t ends[2] = {u, v};
  const double x[3] = {static_cast<double>(merged_[0]), static_cast<double>(merged_[1]),
                       static_cast<double>(merged_[2])};
  volumes_.measure(stars_, ends, mesh_.allValues(), static_cast<size_t>(mesh_.valueStride()), x,
                   labels, sides);
}

// Moves the place, by as much as it takes, to where no region of the stars grows or shrinks, or
// side of a sheet, or the body; returns the error there. Where that is too far the body changes,
// but of regions nothing may: infinity.
template <class Mesh>
auto Collapser<Mesh>::keepVolumes(uint32_t u, uint32_t v, const CellLabels& labels,
                                  const SheetSides* sides) -> S {
  measureVolumes(u, v, labels, sides);
  double step[3], form[6];
  S cost[6];
  core_.kernels.spaceForm(mesh_.quadric(u), mesh_.quadric(v), core_.plan.dimension, cost);
  std::copy_n(cost, 6, form);
  const bool is_near = volumes_.step(form, step);
  if (!is_near && labels.count > 0) return std::numeric_limits<S>::infinity();
  if (!is_near && !sides) return S(0);
  S scaled[3];
  for (size_t i = 0; i < 3; ++i) scaled[i] = static_cast<S>(step[i]) * core_.scale[i];
  moveBy(u, v, scaled);
  return errorHere(u, v);
}

template <class Mesh>
auto Collapser<Mesh>::errorHere(uint32_t u, uint32_t v) const -> S {
  return core_.kernels.errorAt(mesh_.quadric(u), mesh_.values(u), mesh_.quadric(v), mesh_.values(v),
                               core_.scale.data(), core_.plan.dimension, z_.data());
}

// With features, curves stay where they are: what is merged with a vertex of one goes there, and
// between two of them a place off their edge by rounding goes onto it. False, and nothing is done,
// for other places between two.
template <class Mesh>
bool Collapser<Mesh>::putOnCurve(uint32_t u, uint32_t v, bool u_on_it, bool v_on_it) {
  double along[3], square = 0, dot = 0, off = 0;
  for (size_t i = 0; i < 3; ++i) {
    along[i] = static_cast<double>((mesh_.values(v)[i] - mesh_.values(u)[i]) * core_.scale[i]);
    square += along[i] * along[i];
    dot += along[i] * static_cast<double>(z_[i]);
  }
  double t = v_on_it ? 0.5 : -0.5;
  if (u_on_it == v_on_it) {
    t = std::clamp(dot / square, -0.5, 0.5);
    for (size_t i = 0; i < 3; ++i) {
      const double d = static_cast<double>(z_[i]) - t * along[i];
      off += d * d;
    }
    if (!(off <= kOnEdge * kOnEdge * square)) return false;
  }
  S step[3];
  for (size_t i = 0; i < 3; ++i) step[i] = static_cast<S>(t * along[i]) - z_[i];
  moveBy(u, v, step);
  if (u_on_it != v_on_it) std::copy_n(mesh_.values(v_on_it ? v : u), 3, merged_.data());
  return true;
}

// The place that sheets and curves want.
template <class Mesh>
auto Collapser<Mesh>::adjust(uint32_t u, uint32_t v, const Strata& strata) -> Adjusted {
  const bool u_on_it = strata.u.stratum == Stratum::kCurve;
  const bool v_on_it = strata.v.stratum == Stratum::kCurve;
  const CellLabels& labels = strata.embedded.labels;
  if (core_.exact_curves && (u_on_it || v_on_it) && putOnCurve(u, v, u_on_it, v_on_it)) {
    measureVolumes(u, v, labels, nullptr);
    return {errorHere(u, v), volumes_.changeHere() ? kIntoCurve : 1};
  }
  const bool has_volumes = labels.count > 0 || keepsBody(u, v);
  if (!core_.inner_sheets) return {has_volumes ? keepVolumes(u, v, labels, nullptr) : S(0)};
  const bool moved = u_on_it && v_on_it && keepCurveArea(u, v, strata.embedded);
  const bool is_cut =
      !(labelled_.u.empty() && labelled_.v.empty()) && sides_.find(stars_, labels, labelled_) > 1;
  if (is_cut || has_volumes) return {keepVolumes(u, v, labels, is_cut ? &sides_ : nullptr)};
  return {moved ? errorHere(u, v) : S(0)};
}

// `ring` as gathered from one end, towards the other.
template <class Mesh>
bool Collapser<Mesh>::mayKeepStrata(const Strata& strata, uint32_t other, const Star& ring) const {
  const bool in_labelled =
      core_.inner_sheets && strata.onSheets() && edge_faces_.holdEdge(ring, other);
  return StrataCondition::mayHold(strata.u, strata.v, ring, strata.embedded, in_labelled);
}

// Of the stars as gathered.
template <class Mesh>
void Collapser<Mesh>::listLabelled(uint32_t u, uint32_t v) {
  labelled_.u.clear();
  labelled_.v.clear();
  const uint8_t* const flags = mesh_.allFlags();
  if (flags[u] & kInterface) edge_faces_.list(stars_.u, stars_.ring, labelled_.u);
  if (flags[v] & kInterface) edge_faces_.list(stars_.v, stars_.ring_from_v, labelled_.v);
}

// Of the stars as gathered.
template <class Mesh>
bool Collapser<Mesh>::keepsTopology(uint32_t u, uint32_t v, const Strata& strata) {
  if (!link_.holds({u, mesh_.isBoundary(u)}, {v, mesh_.isBoundary(v)}, stars_)) return false;
  return !strata.any() ||
         strata_.holds(strata.u, strata.v, stars_, mesh_.allFlags(), strata.embedded, labelled_);
}

// Half of all edges fail, most of them by the cells of the end that moves most.
template <class Mesh>
Outcome Collapser<Mesh>::test(uint32_t u, uint32_t v, S* error, int64_t least_cells,
                              float most_price) {
  price_ = 1;
  if (!mesh_.isFree(u) || !mesh_.isFree(v)) return Outcome::kLocked;
  for (int i = 0; i < core_.plan.dimension; ++i)
    if (!std::isfinite(merged_[static_cast<size_t>(i)])) return Outcome::kNotFinite;
  // Where no cell is thin none may become so: the first one tells.
  ThinAngle angle = core_.thin;
  angle.barred = sound_.has(u) && sound_.has(v);
  if (turnsSameCell(u, v, angle)) return Outcome::kOrientation;
  const bool u_first = isFarther(u, v);
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
  const bool on_sheet = (mesh_.allFlags()[u] | mesh_.allFlags()[v]) & kOnSheet;
  if (on_sheet && (strata.any() || keepsBody(u, v))) {
    gather(!u_first);
    if (core_.inner_sheets) listLabelled(u, v);
    const Adjusted moved = adjust(u, v, strata);
    if (!std::isfinite(moved.error)) return Outcome::kTooFar;
    price_ = growthPrice(*error, moved.error * S(moved.cost));
    if (price_ > most_price) return Outcome::kDear;
    if (isTooLarge(moved.error)) return Outcome::kTooLarge;
    *error = std::max(*error, moved.error);
  }
  if (isPriced(most_price)) {
    angle = core_.dear.front();
    angle.inner_cos2 = core_.thin.cos2;
    if (core_.isFlat()) angle.middle_cos2 = core_.dear.back().cos2;
  }
  const Star& farther = u_first ? stars_.u : stars_.v;
  const StarShape a = shapeFrom(merged_.data(), farther.begin(), farther.size(), angle);
  if (!a.positive) return refuseFor(u, v, farther[a.turned]);
  gather(!u_first);
  const Star& nearer = u_first ? stars_.v : stars_.u;
  const StarShape b = shapeFrom(merged_.data(), nearer.begin(), nearer.size(), angle);
  if (!b.positive) return refuseFor(u, v, nearer[b.turned]);
  const StarShape both = {true, a.thin + b.thin, a.middle + b.middle, a.inner + b.inner, 0};
  if (const Outcome o = thins(u, v, most_price, both); o != Outcome::kDone) return o;
  if (!keepsTopology(u, v, strata)) return Outcome::kTopology;
  if ((mesh_.isBoundary(u) || mesh_.isBoundary(v)) &&
      crossing_.find(u, v, stars_, merged_.data(), static_cast<double>(core_.scale[0])))
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
  std::copy_n(z, z_.size(), z_.data());
  if (placeAt(u, v, z_.data())) error = std::max(error, errorHere(u, v));
  std::copy_n(mesh_.values(u) + core_.plan.dimension, core_.plan.values - core_.plan.dimension,
              merged_.data() + core_.plan.dimension);
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
  tally_.error += growth(u, v, error);
  if (core_.plan.values > core_.plan.dimension) interpolateCarried(u, v);
  if (core_.plan.picks > 0) pickNearest(u, v);
  if (core_.plan.cell_means > 0) heirs_.handOver(mesh_, v, stars_, core_.plan.cell_means);
  if (core_.window.faces.anyPlaced()) edge_faces_.handOver(u, v, stars_);
  const double in_users_terms = static_cast<double>(error) * core_.error_unit;
  if (core_.tracer) trace(u, v, in_users_terms);
  mesh_.merge(u, v, stars_);
  thin_counts_.merged(stars_);
  core_.window.curves.merge(mesh_.slotOf(u), mesh_.slotOf(v));
  std::copy(merged_.begin(), merged_.end(), mesh_.values(u));
  S *a = mesh_.quadric(u), *b = mesh_.quadric(v);
  const int last = core_.window.shape().quadric - 1;
  for (int i = 0; i < last; ++i) a[i] += b[i];
  a[last] = error;
  tally_.largest_error = std::max(tally_.largest_error, in_users_terms);
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
        put(merged_.data(), cell.corner[0]);
        for (int k = 0; k < 3; ++k) put(mesh_.values(s.t[k]), cell.corner[k + 1]);
        traced_before_.push_back(cell.cell);
      }
    for (const StarCell& s : stars_.ring) traced_before_.push_back(mesh_.cellSlotOf(s.cell));
  }
  core_.tracer->collapsed({mesh_.slotOf(u), mesh_.slotOf(v), mesh_.values(u), mesh_.values(v),
                           merged_.data(), error, traced_before_, traced_after_});
}

// Carried fields take the value that the old cells have at the new position. One that is not finite
// has no part in a mean: there the nearest corner's is taken, so that such places do not grow.
template <class Mesh>
void Collapser<Mesh>::interpolateCarried(uint32_t u, uint32_t v) {
  double x[3], best = -1e301, weights[4] = {1, 0, 0, 0};
  uint32_t corners[4] = {u, u, u, u};
  for (int i = 0; i < 3; ++i) x[i] = static_cast<double>(merged_[static_cast<size_t>(i)]);
  for (const Star* star : {&stars_.ring, &stars_.u, &stars_.v}) {
    if (best >= 0) break;  // x lies in that cell
    const uint32_t centre = star == &stars_.v ? v : u;
    const NearestCell nearest =
        nearestCell(x, mesh_.allValues(), mesh_.valueStride(), static_cast<double>(core_.scale[0]),
                    centre, star->begin(), star->size());
    if (!(nearest.least > best)) continue;
    best = nearest.least;
    corners[0] = centre;
    std::copy_n((*star)[nearest.place].t, 3, corners + 1);
  }
  double p[4][3];
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) p[k][i] = static_cast<double>(mesh_.values(corners[k])[i]);
  clampedWeights(p, x, weights);
  const auto nearest = static_cast<size_t>(std::max_element(weights, weights + 4) - weights);
  for (int i = core_.plan.dimension; i < core_.plan.values; ++i) {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += weights[k] * static_cast<double>(mesh_.values(corners[k])[i]);
    const S mean = static_cast<S>(sum);
    merged_[static_cast<size_t>(i)] =
        std::isfinite(mean) ? mean : mesh_.values(corners[nearest])[i];
  }
}

template <class Mesh>
void Collapser<Mesh>::pickNearest(uint32_t u, uint32_t v) {
  double to_u = 0, to_v = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double s = static_cast<double>(core_.scale[i]), x = static_cast<double>(merged_[i]);
    const double a = (static_cast<double>(mesh_.values(u)[i]) - x) * s;
    const double b = (static_cast<double>(mesh_.values(v)[i]) - x) * s;
    to_u += a * a;
    to_v += b * b;
  }
  if (to_v < to_u) std::copy_n(mesh_.picks(v), core_.plan.picks, mesh_.picks(u));
}

template class Collapser<Window<float>>;
template class Collapser<Window<double>>;
template class Collapser<Patch<float>>;
template class Collapser<Patch<double>>;

}  // namespace tetstream
