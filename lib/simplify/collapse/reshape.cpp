#include "reshape.h"

#include <algorithm>

#include "barycentric.h"
#include "settled.h"
#include "vector3.h"

namespace tetstream {

// The mean squared change of the fields over the cells concerned, in those of the whole's error. At
// less the errors at steep fronts are larger, since collapses stay illegal there; at 10 those of
// fields that have layers are, up to 1.6 times, and of all rows 1.05 times.
constexpr double kMostChange = 2;

template <class S>
Reshaper<S>::Reshaper(Core<S>& core, Patch<S>& patch, Tally& tally, Account& account)
    : core_(core),
      patch_(patch),
      tally_(tally),
      reconnector_(patch, account),
      marks_(account),
      means_(static_cast<size_t>(core.plan.cell_means)),
      old_means_(Reconnection::kMostRing * (means_.size() + 1)) {}

template <class S>
void Reshaper<S>::start() {
  counts_thin_ = false;
  patch_.listGone();
  reconnector_.start(core_.folds || core_.locked.non_manifold > 0 || core_.locked.bad_cells > 0);
  if (marks_.size() < patch_.vertexEnd()) marks_.resize(patch_.vertexEnd() + 1024);
  for (uint32_t v = patch_.ownedEnd(); v < patch_.vertexEnd(); ++v)
    marks_[v] = patch_.isFreeElsewhere(v) ? kElsewhere : 0;
}

template <class S>
uint8_t Reshaper<S>::marksOf(uint32_t c) const {
  uint32_t marks = 0;
  for (uint32_t j = 0; j < 4; ++j) marks |= marks_[patch_.vertexOf(c, j)];
  return static_cast<uint8_t>(marks);
}

// Whether a flip is found at a cell depends on the cells that share an edge with it: on the
// vertices of the cells of its vertices.
template <class S>
void Reshaper<S>::markNear() {
  for (uint32_t c = 0; c < patch_.cellEnd(); ++c) {
    if (!patch_.isLive(c)) continue;
    const uint8_t marks = marksOf(c);
    const auto near = static_cast<uint8_t>((marks & kMoved ? kNearMoved : 0) |
                                           (marks & kElsewhere ? kNearSeam : 0));
    if (near)
      for (uint32_t j = 0; j < 4; ++j) marks_[patch_.vertexOf(c, j)] |= near;
  }
}

template <class S>
double Reshaper<S>::meanOf(double error) const {
  return core_.volume > 0 ? kMostChange * error / core_.volume : 0;
}

// No flip was found there before, and none will be now.
template <class S>
bool Reshaper<S>::isAsBefore(uint32_t c) const {
  return !(marksOf(c) & (kNearMoved | kFlipped)) &&
         core_.window.mesh.cellFlags(patch_.cellSlotOf(c)) & kShaped;
}

template <class S>
bool Reshaper<S>::flipAll(int64_t least_cells, int64_t most_cells) {
  least_cells_ = least_cells;
  most_cells_ = most_cells;
  markNear();
  reconnector_.measure([this](uint32_t c) { return !isAsBefore(c); });
  bool any = false;
  for (uint32_t c = 0; c < patch_.cellEnd(); ++c) {
    if (!patch_.isLive(c) || isAsBefore(c)) continue;
    if (reconnector_.thinnessOfCell(c) > core_.poor) any = flipAt(c) || any;
  }
  rememberShaped();
  return any;
}

template <class S>
void Reshaper<S>::rememberShaped() {
  for (uint32_t c = 0; c < patch_.cellEnd(); ++c) {
    if (!patch_.isLive(c)) continue;
    if (marksOf(c) & (kNearSeam | kFlipped))
      core_.window.mesh.unflagCell(patch_.cellSlotOf(c), kShaped);
    else
      core_.window.mesh.flagCell(patch_.cellSlotOf(c), kShaped);
  }
}

template <class S>
void Reshaper<S>::unsettleChanged() {
  for (uint32_t v = 0; v < patch_.vertexEnd(); ++v)
    if ((marks_[v] & kFlipped) && core_.window.isFree(patch_.slotOf(v)))
      outdate(core_.window, patch_.slotOf(v));
}

// Of all flips that the cell takes part in, the one that is worth most. No more cells than before
// come of rings of four and less.
template <class S>
bool Reshaper<S>::flipAt(uint32_t c) {
  Reconnection best, r;
  double most = 0;
  const auto offer = [&] {
    if (!r.improves()) return;
    const double worth = worthOf(r);
    if (!(worth > most) || !isLegal(r)) return;
    most = worth;
    best = r;
  };
  // Faces and edges between vertices that the caller locked stay: they may be locked themselves.
  bool locked[4];
  for (uint32_t j = 0; j < 4; ++j) locked[j] = isLockedByCaller(c, j);
  const auto leastGain = [&] { return counts_thin_ ? 0 : most; };
  for (uint32_t j = 0; j < 4 && !counts_thin_; ++j)
    if (!(locked[(j + 1) % 4] && locked[(j + 2) % 4] && locked[(j + 3) % 4]) &&
        reconnector_.removeFace(c, j, r, leastGain()))
      offer();
  const uint32_t most_ring = counts_thin_ ? 4 : Reconnection::kMostRing;
  for (uint32_t i = 0; i < 4; ++i)
    for (uint32_t j = 0; j < i; ++j)
      if (!(locked[i] && locked[j]) && reconnector_.removeEdge(c, i, j, r, most_ring, leastGain()))
        offer();
  if (!best.improves()) return false;
  apply(best);
  return true;
}

// By how much the worst cell is improved; or how many thin cells there are fewer, for each unit of
// change. Where that is next to nothing it is the same for all.
template <class S>
double Reshaper<S>::worthOf(const Reconnection& r) {
  constexpr double kNextToNothing = 1e-3;
  if (!counts_thin_) return r.before - r.after;
  const int fewer = thinFewer(r);
  if (fewer <= 0) return 0;
  const double changed = change(r).integral;
  if (!(changed <= most_change_) || core_.errorWith(tally_) + changed > core_.error_limit) return 0;
  return fewer / std::max(changed, kNextToNothing * most_change_);
}

template <class S>
int Reshaper<S>::thinFewer(const Reconnection& r) {
  int fewer = 0;
  double p[4][3];
  for (uint32_t g = 0; g < r.gone_count; ++g)
    fewer += reconnector_.thinnessOfCell(r.gone[g]) > core_.poor;
  for (uint32_t m = 0; m < r.made_count; ++m) {
    positionsOf(r.made[m], p);
    fewer -= thinness(p) > core_.poor;
  }
  return fewer;
}

template <class S>
bool Reshaper<S>::isLockedByCaller(uint32_t c, uint32_t j) const {
  return core_.window.mesh.vertexFlags(patch_.slotOf(patch_.vertexOf(c, j))) & kCallerLocked;
}

// Such a face is known by its cell, which stays.
template <class S>
bool Reshaper<S>::hasLabelledFace(uint32_t slot) const {
  for (uint32_t j = 0; j < 4; ++j)
    if (core_.window.faces.labelOf(4 * slot + j)) return true;
  return false;
}

template <class S>
bool Reshaper<S>::isLegal(const Reconnection& r) const {
  const int64_t live = patch_.liveCells() + r.made_count - r.gone_count;
  if (live < least_cells_ || live > most_cells_) return false;
  if (r.made_count > r.gone_count + patch_.freeSlots()) return false;
  // Which cells a tile has is listed beforehand: vertices of others get no new ones.
  for (uint32_t m = 0; m < r.made_count; ++m)
    for (uint32_t v : r.made[m])
      if (patch_.isFreeElsewhere(v)) return false;
  const CellLabels labels = core_.cellLabels();
  const uint32_t first = patch_.cellSlotOf(r.gone[0]);
  for (uint32_t g = 0; g < r.gone_count; ++g) {
    const uint32_t slot = patch_.cellSlotOf(r.gone[g]);
    if (core_.window.mesh.cellFlags(slot) & (kFlat | kFolded)) return false;
    if (labels.count > 0 && labels.differ(first, slot)) return false;
    if (core_.window.faces.anyPlaced() && hasLabelledFace(slot)) return false;
  }
  return counts_thin_ || change(r).mean <= most_change_;
}

template <class S>
void Reshaper<S>::positionsOf(const uint32_t corners[4], double p[4][3]) const {
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) p[k][i] = static_cast<double>(patch_.values(corners[k])[i]);
}

// In the unit of the errors: that of length there is a power of two.
template <class S>
double Reshaper<S>::normalisedSixVolume(double p[4][3]) const {
  const auto unit = static_cast<double>(core_.scale[0]);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) p[k][i] *= unit;
  return sixVolume(p);
}

// Taken at the centroids of the new cells.
template <class S>
auto Reshaper<S>::change(const Reconnection& r) const -> Change {
  if (core_.scale.size() == 3) return {0, 0};
  double sum = 0, volume = 0, p[4][3];
  CellFrame frames[Reconnection::kMostRing];
  uint32_t corners[Reconnection::kMostRing][4];
  for (uint32_t g = 0; g < r.gone_count; ++g) {
    patch_.cornersOf(r.gone[g], corners[g]);
    positionsOf(corners[g], p);
    frames[g].set(p[0]);
  }
  for (uint32_t m = 0; m < r.made_count; ++m) {
    double x[3], weights[4] = {}, least = -1e301;
    positionsOf(r.made[m], p);
    for (int i = 0; i < 3; ++i) x[i] = (p[0][i] + p[1][i] + p[2][i] + p[3][i]) / 4;
    const double part = normalisedSixVolume(p);
    const uint32_t* old = corners[0];
    for (uint32_t g = 0; g < r.gone_count; ++g) {
      double w[4];
      frames[g].weights(x, w);
      const double l = *std::min_element(w, w + 4);
      if (!(l > least)) continue;
      least = l;
      std::copy_n(w, 4, weights);
      old = corners[g];
    }
    for (size_t f = 3; f < core_.scale.size(); ++f) {
      double difference = 0;
      for (uint32_t k = 0; k < 4; ++k)
        difference += static_cast<double>(patch_.values(r.made[m][k])[f]) / 4 -
                      weights[k] * static_cast<double>(patch_.values(old[k])[f]);
      difference *= static_cast<double>(core_.scale[f]);
      sum += part * difference * difference;
    }
    volume += part;
  }
  return {sum / 6, volume > 0 ? sum / volume : 0};
}

// The one place where cells are replaced.
template <class S>
void Reshaper<S>::apply(const Reconnection& r) {
  uint32_t slots[Reconnection::kMostCells];
  ++tally_.flips;
  if (counts_thin_) tally_.error += change(r).integral;
  reconnector_.replace(r, slots);
  for (uint32_t m = 0; m < r.made_count; ++m)
    for (uint32_t v : r.made[m]) marks_[v] |= kFlipped;
  handOverCellData(r, slots);
  if (observer_) tell(r, slots);
}

// Float cell data: each new cell stands for its share, by its volume, of what the old ones stood
// for, and has their mean. Where there is none, as a value is not finite, the new cells lie side by
// side as the old ones do, and have the value that is where their middles are: such places neither
// grow nor vanish. Integers are those of the cell whose place it takes, of further cells
// those of the first: all are of one region.
template <class S>
void Reshaper<S>::handOverCellData(const Reconnection& r, const uint32_t* slots) {
  Window<S>& window = core_.window;
  for (uint32_t m = r.gone_count; m < r.made_count && core_.plan.cell_picks > 0; ++m)
    std::copy_n(window.cellPicks(patch_.cellSlotOf(r.gone[0])), core_.plan.cell_picks,
                window.cellPicks(patch_.cellSlotOf(slots[m])));
  if (means_.empty()) return;
  const double stood_for = takeMeans(r);
  if (!(stood_for > 0)) return;
  double volume = 0, handed_over = 0, part[Reconnection::kMostCells];
  for (uint32_t m = 0; m < r.made_count; ++m) {
    double p[4][3];
    positionsOf(r.made[m], p);
    volume += part[m] = sixVolume(p);
  }
  for (uint32_t m = 0; m < r.made_count; ++m) {
    double* const to = patch_.cellMeans(slots[m]);
    to[0] = stood_for * (part[m] / volume);
    const double* const there = oldMeansAt(handed_over + to[0] / 2, r.gone_count);
    for (size_t i = 0; i < means_.size(); ++i)
      to[i + 1] = std::isfinite(means_[i]) ? means_[i] : there[i + 1];
    handed_over += to[0];
  }
}

// The old cells' rows and their mean; returns what they stood for.
template <class S>
double Reshaper<S>::takeMeans(const Reconnection& r) {
  const size_t n = means_.size();
  double stood_for = 0;
  std::fill(means_.begin(), means_.end(), 0.0);
  for (uint32_t g = 0; g < r.gone_count; ++g) {
    const double* const old = patch_.cellMeans(r.gone[g]);
    std::copy_n(old, n + 1, &old_means_[g * (n + 1)]);
    stood_for += old[0];
    for (size_t i = 0; i < n; ++i) means_[i] += old[0] * old[i + 1];
  }
  for (double& mean : means_) mean /= stood_for;
  return stood_for;
}

// The row of the old cell that has this place where all lie side by side, as long as what each
// stood for.
template <class S>
const double* Reshaper<S>::oldMeansAt(double place, uint32_t count) const {
  const size_t width = means_.size() + 1;
  const double* row = old_means_.data();
  for (const double* const last = row + (count - 1) * width; row != last && place >= row[0];
       row += width)
    place -= row[0];
  return row;
}

template <class S>
void Reshaper<S>::tell(const Reconnection& r, const uint32_t* slots) {
  uint32_t before[Reconnection::kMostRing];
  PlacedCell after[Reconnection::kMostCells];
  for (uint32_t g = 0; g < r.gone_count; ++g) before[g] = patch_.cellSlotOf(r.gone[g]);
  for (uint32_t m = 0; m < r.made_count; ++m) {
    after[m].cell = patch_.cellSlotOf(slots[m]);
    positionsOf(r.made[m], after[m].corner);
  }
  observer_->flipped(before, r.gone_count, after, r.made_count);
}

template class Reshaper<float>;
template class Reshaper<double>;

}  // namespace tetstream
