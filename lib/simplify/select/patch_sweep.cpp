#include "patch_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "settled.h"

namespace tetstream {

constexpr uint32_t kAlways = 0xffffffffu;  // a mark above all others
// Within a patch edges are taken at bounds rising to the pass's, nearly in order of their error.
constexpr float kFirstLevel = 1.0f / 256, kLevelStep = 2;

template <class S>
PatchSweep<S>::PatchSweep(Core<S>& core, Account& account, const State& state)
    : core_(core),
      state_(state),
      patch_(account, core.window),
      collapser_(core, patch_, state_.tally, account),
      choices_(account),
      solutions_(core, account),
      renewal_(core, patch_, account),
      errors_(account),
      neighbours_(account),
      seen_(account),
      looks_(account),
      marks_(account),
      spared_(account),
      seam_values_(account),
      seam_quadrics_(account),
      z_(static_cast<size_t>(core.plan.dimension)) {}

template <class S>
bool PatchSweep<S>::load(const uint32_t* owned, size_t owned_count, const uint32_t* cells,
                         size_t cell_count) {
  collapser_.forget();
  evaluated_ = is_stored_ = false;
  if (owned_count > Choices::kMostVertices ||
      !patch_.load(owned, owned_count, cells, cell_count, core_.window.liveCells() - state_.died))
    return false;
  return patch_.largestStar() <= kLargestStar || leaveHubs(cells, cell_count);
}

// Whoever tries an edge looks at the stars of both ends: with n cells round a hub each of its n
// edges would cost n.
template <class S>
bool PatchSweep<S>::leaveHubs(const uint32_t* cells, size_t cell_count) {
  kept_.clear();
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v)
    if (patch_.starSize(v) <= kLargestStar) kept_.push_back(patch_.slotOf(v));
  return patch_.load(kept_.data(), kept_.size(), cells, cell_count,
                     core_.window.liveCells() - state_.died);
}

template <class S>
void PatchSweep<S>::startList(uint32_t v, size_t cells) {
  if (neighbours_.size() < 4 * cells + kBestEdges) neighbours_.resize(8 * cells + kBestEdges);
  seen_[v] = ++mark_;
}
// v's neighbours that may be merged with it, each once.
template <class S>
void PatchSweep<S>::listNeighbours(uint32_t v) {
  const uint32_t cells = patch_.starSize(v);
  startList(v, cells);
  count_ = listVertices(patch_.corners(), patch_.starOf(v), cells, seen_.data(), mark_,
                        neighbours_.data());
}
// The same, of what the collapse has gathered.
template <class S>
void PatchSweep<S>::listNeighboursOfMerged(uint32_t u) {
  const Stars& stars = collapser_.stars();
  startList(u, stars.u.size() + stars.v.size());
  count_ = listVertices(stars.u.begin(), stars.u.size(), seen_.data(), mark_, neighbours_.data());
  count_ += listVertices(stars.v.begin(), stars.v.size(), seen_.data(), mark_,
                         neighbours_.data() + count_);
}

template <class S>
void PatchSweep<S>::measureNeighbours(uint32_t u) {
  measureIn(core_.tableOf(patch_), u);
}
template <class S>
void PatchSweep<S>::measureIn(const VertexTable<S>& table, uint32_t u) {
  if (errors_.size() < neighbours_.size()) errors_.resize(neighbours_.size());
  core_.kernels.edgeErrors(table, u, neighbours_.data(), static_cast<int>(count_),
                           core_.scale.data(), core_.plan.dimension, errors_.data());
}

// v's edges to those that did not add theirs yet, for both ends; v counts as seen from now on.
template <class S>
void PatchSweep<S>::addEdges(uint32_t v) {
  listNeighbours(v);
  seen_[v] = kAlways;
  measureNeighbours(v);
  choices_.add(v, edges());
}

template <class S>
void PatchSweep<S>::evaluateAll(float bound) {
  evaluated_ = true;
  choices_.reset(patch_.ownedEnd());
  solutions_.reset(patch_.ownedEnd());
  if (looks_.size() < patch_.ownedEnd()) {
    looks_.resize(patch_.ownedEnd() + 1024);
    spared_.resize(looks_.size());
  }
  std::fill_n(spared_.data(), patch_.ownedEnd(), std::numeric_limits<float>::infinity());
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) {
    const Settled s = settledOf(core_.window, patch_.slotOf(v));
    looks_[v] = s.least <= bound;
    evaluated_ = evaluated_ && s.least == 0;
    if (!looks_[v])
      choices_.know(v, s.least, s.refused);
    else if (s.least > 0 && !s.spared)
      choices_.passOver(v, s.least, s.refused);
  }
  // The rim and what dead cells hold count as seen, always.
  if (seen_.size() == 0) seen_.resize(size_t{kGoneCorner} + 1);
  std::fill_n(seen_.data(), patch_.ownedEnd(), 0u);
  std::fill(seen_.data() + patch_.ownedEnd(), seen_.data() + patch_.vertexEnd(), kAlways);
  seen_[kGoneCorner] = kAlways;
  mark_ = 0;
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v)
    if (looks_[v]) addEdges(v);
  std::fill_n(seen_.data(), patch_.ownedEnd(), 0u);
}

// The merged vertex measures its edges and tells its neighbours.
template <class S>
void PatchSweep<S>::pushAfter(uint32_t u, uint32_t gone) {
  listNeighboursOfMerged(u);
  measureNeighbours(u);
  solutions_.moved(u);
  choices_.forget(gone);
  choices_.forget(u);
  choices_.relist(u, edges());
  choices_.replace(u, gone, edges());
}

// The best edges of v and of the next vertices that have one up to the level.
template <class S>
void PatchSweep<S>::solveFrom(uint32_t v, float level) {
  solutions_.clear();
  uint32_t found[kEdgeLanes + Choices::kBlock];
  const uint32_t count = choices_.listUpTo(level, v, kEdgeLanes, found);
  for (uint32_t i = 0; i < count && !solutions_.full(); ++i)
    if (!choices_.mustLookAgain(found[i])) solutions_.add(found[i], choices_.target(found[i]));
  solutions_.solve(core_.tableOf(patch_));
}

// The error of the edge; z_ becomes its minimizer.
template <class S>
S PatchSweep<S>::solve(uint32_t v, uint32_t w, float level) {
  if (!solutions_.reach(v)) solveFrom(v, level);
  S error;
  if (const S* z = solutions_.find(v, w, &error)) {
    std::copy_n(z, z_.size(), z_.data());
    return error;
  }
  return core_.kernels.solveEdge(patch_.quadric(v), patch_.values(v), patch_.quadric(w),
                                 patch_.values(w), core_.scale.data(), core_.plan.dimension,
                                 z_.data());
}

// Tries v's edges of errors up to the level, best first, until one is collapsed that has no higher
// price, in errors, than `most`; 0: than its error.
template <class S>
void PatchSweep<S>::collapseFrom(uint32_t v, float level, float most) {
  while (choices_.least(v) <= level) {
    if (choices_.mustLookAgain(v)) {
      listNeighbours(v);
      measureNeighbours(v);
      choices_.relist(v, edges());
      continue;
    }
    const uint32_t w = choices_.target(v);
    const S error = solve(v, w, level);
    const float most_price = most > 0 ? std::max(most / choices_.least(v), 1.0f) : 1.0f;
    const Outcome outcome =
        collapser_.collapse(v, w, z_.data(), error, state_.goal.least_cells, most_price);
    if (outcome == Outcome::kDone) {
      pushAfter(v, w);
      return;
    }
    if (outcome == Outcome::kDear)
      spared_[v] = std::min(spared_[v], collapser_.price() * choices_.least(v));
    choices_.refuse(v, w);
  }
}

// Returns the least error of an edge that is left, infinity if none is.
template <class S>
float PatchSweep<S>::sweepLevel(float level, float most) {
  float least = std::numeric_limits<float>::infinity();
  solutions_.clear();
  for (uint32_t block = 0; block < patch_.ownedEnd(); block += Choices::kBlock) {
    if (choices_.leastOfBlock(block) <= level)
      for (uint32_t v = block; v < block + Choices::kBlock; ++v) {
        if (!(choices_.least(v) <= level)) continue;
        collapseFrom(v, level, most);
        if (mustStop()) return std::numeric_limits<float>::infinity();
      }
    least = std::min(least, choices_.leastOfBlock(block));
  }
  return least;
}

// What was spared at lower levels has its price now. Where prices are common all edges of half the
// error and less may have theirs.
template <class S>
void PatchSweep<S>::sweepSpared(float level) {
  bool any = core_.hasPrices();
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) {
    if (!(spared_[v] <= level)) continue;
    spared_[v] = std::numeric_limits<float>::infinity();
    choices_.reconsider(v);
    any = true;
  }
  if (!any) return;
  const float reach = core_.isFlat() ? level : level / thinPrice(core_.shapesFirst());
  while (sweepLevel(reach, level) <= reach) {
  }
}

template <class S>
bool PatchSweep<S>::sweep(float bound) {
  if (!evaluated_) {
    if (core_.options.renews) renewal_.renewStale();
    evaluateAll(bound);
  }
  evaluated_ = false;
  float level = bound * kFirstLevel, least;
  for (;;) {
    choices_.reconsider();
    sweepSpared(level);
    do least = sweepLevel(level, 0);
    while (least <= level);
    if (level >= bound || mustStop()) break;
    level = std::min(std::max(level * kLevelStep, least), bound);
  }
  return least < std::numeric_limits<float>::infinity();
}

// A vertex of the window, with its row copied: kernels read beyond the end of a row, and what lies
// there another patch may be writing.
template <class S>
void PatchSweep<S>::copySeamRow(uint32_t slot, size_t row) {
  Window<S>& window = core_.window;
  const auto values = static_cast<size_t>(window.shape().values);
  const auto quadric = static_cast<size_t>(window.shape().quadric);
  if (seam_values_.size() < (row + 1) * values + 3) {
    const size_t rows = 2 * row + 32;
    seam_values_.resize(rows * values + 3);
    seam_quadrics_.resize(rows * quadric + 3);
  }
  copyRow(window.values(slot), values, &seam_values_[row * values]);
  copyRow(window.quadric(slot), quadric, &seam_quadrics_[row * quadric]);
}

// The least error of v's edges to vertices of other patches.
template <class S>
float PatchSweep<S>::leastAcrossSeam(uint32_t v) {
  listNeighbours(v);
  seen_[v] = kAlways;
  Window<S>& window = core_.window;
  copySeamRow(patch_.slotOf(v), 0);
  for (size_t i = 0; i < count_; ++i) {
    const uint32_t slot = patch_.slotOf(neighbours_[i]);
    copySeamRow(slot, i + 1);
    neighbours_[i] = static_cast<uint32_t>(i + 1);
  }
  measureIn(
      {seam_quadrics_.data(), seam_values_.data(), window.shape().quadric, window.shape().values},
      0);
  S least = std::numeric_limits<S>::infinity();
  for (size_t i = 0; i < count_; ++i) least = errors_[i] < least ? errors_[i] : least;  // no NaN
  return static_cast<float>(least * static_cast<S>(state_.unit));
}

// Marks of vertices when they are settled, in the lower bits what they are, in the upper ones what
// is round them: vertices that were merged, and free ones of other patches, across a seam.
constexpr uint8_t kMerged = 1, kBeyondSeam = 2;
constexpr uint8_t kByMerged = kMerged << 2, kAtSeam = kBeyondSeam << 2;

// Seen, from now on, are all but the free vertices of other patches.
template <class S>
void PatchSweep<S>::markSurroundings() {
  const uint32_t owned = patch_.ownedEnd(), end = patch_.vertexEnd();
  if (marks_.size() < end) marks_.resize(end + 1024);
  uint8_t* const marks = marks_.data();
  std::fill_n(seen_.data(), owned, kAlways);
  for (uint32_t v = 0; v < owned; ++v) marks[v] = solutions_.hasMoved(v) ? kMerged : 0;
  for (uint32_t x = owned; x < end; ++x) {
    marks[x] = patch_.isFreeElsewhere(x) ? kBeyondSeam : 0;
    if (marks[x] != 0) seen_[x] = 0;
  }
  for (uint32_t c = 0; c < patch_.cellEnd(); ++c) {
    if (!patch_.isLive(c)) continue;
    uint32_t v[4];
    patch_.cornersOf(c, v);
    const int round = (marks[v[0]] | marks[v[1]] | marks[v[2]] | marks[v[3]]) << 2;
    for (uint32_t x : v) marks[x] |= static_cast<uint8_t>(round & (kByMerged | kAtSeam));
  }
}

// What is known now is kept for the next sweep, in the window.
template <class S>
void PatchSweep<S>::settleAll() {
  choices_.reconsider();
  markSurroundings();
  for (uint32_t x = patch_.ownedEnd(); x < patch_.vertexEnd(); ++x)
    if ((marks_[x] & kBeyondSeam) && (marks_[x] & kByMerged))
      outdate(core_.window, patch_.slotOf(x));
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) {
    if (!patch_.isFree(v)) continue;
    if (marks_[v] & kByMerged) {
      outdate(core_.window, patch_.slotOf(v));
      continue;
    }
    float least = choices_.least(v);
    if ((marks_[v] & kAtSeam) && looks_[v]) least = std::min(least, leastAcrossSeam(v));
    const bool spared = spared_[v] < std::numeric_limits<float>::infinity();
    settle(core_.window, patch_.slotOf(v),
           {std::min(least, spared_[v]), choices_.hasRefused(v), spared});
  }
}

template class PatchSweep<float>;
template class PatchSweep<double>;

}  // namespace tetstream
