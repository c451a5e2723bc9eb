// simplify/select: the best of a few random edges, tile by tile. See select.h.
#include <algorithm>
#include <array>
#include <limits>

#include "random.h"
#include "select.h"
#include "tiles.h"

namespace tetstream {
namespace {

// A tile is left when this many draws in a row gave nothing below the bound, or nothing legal.
constexpr int kDrawsAboveBound = 12, kDrawsIllegal = 60;
// The bound starts this far below the last window's and rises by this factor from pass to pass:
// finer steps come closer to a global order and load each tile more often.
constexpr double kFirstBound = 1.0 / 16, kBoundStep = 1.6;
// A draw's next best edges are tried when the best is not legal: illegal edges of low error would
// otherwise win again and again and hide the legal ones.
constexpr size_t kTries = 3;
constexpr int kSamples = 256;  // draws from which the first window's bound is taken

template <class S>
class RandomSelector final : public Selector {
 public:
  RandomSelector(Core<S>& core, Collapser<Window<S>>& collapser, Account& account)
      : core_(core),
        collapser_(collapser),
        tiles_(core, account),
        random_(static_cast<uint64_t>(core.options.seed)),
        exhaustive_(makeExhaustiveSelector(core, collapser)),
        z_(static_cast<size_t>(core.plan.dimension)) {
    for (Draw& draw : best_) draw.z.resize(z_.size());
  }

  void decimate(const Goal& goal, const std::function<void()>& tick) override {
    goal_ = goal;
    if (reached()) return;
    tiles_.build();
    sweep(tick);
    if (goal.last && core_.options.last_resort && !reached()) exhaustive_->decimate(goal, tick);
  }

 private:
  struct Draw {
    uint32_t u = kNone, v = kNone;
    S error = std::numeric_limits<S>::infinity();
    std::vector<S> z;
  };

  bool reached() const { return core_.window.mesh.liveCells() <= goal_.cells; }
  void sweep(const std::function<void()>& tick);
  void sweepTile(Tile& tile, S bound, bool* moved, bool* bounded);
  bool drawEdge(Tile& tile, uint32_t* u, uint32_t* v);
  void drawBest(Tile& tile);
  void rank(uint32_t u, uint32_t v, S error);
  bool collapseBest(S bound);
  S sampledBound();

  Core<S>& core_;
  Collapser<Window<S>>& collapser_;
  Tiles<S> tiles_;
  Random random_;
  std::unique_ptr<Selector> exhaustive_;
  std::array<Draw, kTries> best_;  // of the last draw, in order of error
  std::vector<S> z_;
  Goal goal_{};
  S bound_ = 0;  // that the last window ended with
};

// A random live cell of the tile and two of its vertices; false if that edge may not collapse.
template <class S>
bool RandomSelector<S>::drawEdge(Tile& tile, uint32_t* u, uint32_t* v) {
  static constexpr uint8_t kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  const Topology& mesh = core_.window.mesh;
  const uint64_t bits = random_.next();
  const size_t place = tile.begin + (((bits >> 32) * tile.size()) >> 32);
  const uint32_t cell = tiles_.cell(place);
  if (!mesh.isLive(cell)) {
    tiles_.remove(tile, place);
    return false;
  }
  const uint8_t* edge = kEdges[((bits & 0xffffffffu) * 6) >> 32];
  *u = mesh.corners(cell)[edge[0]];
  *v = mesh.corners(cell)[edge[1]];
  return mesh.isFree(*u) && mesh.isFree(*v);
}

// Puts an edge, with z_, in its place among the best; an edge drawn twice counts once.
template <class S>
void RandomSelector<S>::rank(uint32_t u, uint32_t v, S error) {
  for (const Draw& draw : best_)
    if ((draw.u == u && draw.v == v) || (draw.u == v && draw.v == u)) return;
  size_t place = kTries - 1;
  std::swap(best_[place].z, z_);
  best_[place].u = u;
  best_[place].v = v;
  best_[place].error = error;
  for (; place > 0 && best_[place].error < best_[place - 1].error; --place)
    std::swap(best_[place], best_[place - 1]);
}

template <class S>
void RandomSelector<S>::drawBest(Tile& tile) {
  const Window<S>& window = core_.window;
  const int last = window.shape().quadric - 1;
  for (Draw& draw : best_) {
    draw.u = draw.v = kNone;
    draw.error = std::numeric_limits<S>::infinity();
  }
  int64_t found = 0;
  for (int64_t tries = 0; found < core_.options.candidates && tile.size() > 0; ++tries) {
    if (tries >= 8 * core_.options.candidates) break;
    uint32_t u, v;
    if (!drawEdge(tile, &u, &v)) continue;
    ++found;
    S *a = core_.window.quadric(u), *b = core_.window.quadric(v);
    const S worst = best_[kTries - 1].error;
    if (a[last] + b[last] >= worst) continue;  // the merge cannot be better
    const S error = core_.kernels.minimizeEdge(a, window.values(u), b, window.values(v),
                                               core_.scale.data(), core_.plan.dimension, z_.data());
    if (error < worst) rank(u, v, error);
  }
}

// Tries the last draw's edges in order of their error.
template <class S>
bool RandomSelector<S>::collapseBest(S bound) {
  for (const Draw& draw : best_) {
    if (!(draw.error <= bound)) return false;
    if (collapser_.collapse(draw.u, draw.v, draw.z.data(), draw.error, goal_.least_cells) ==
        Outcome::kDone)
      return true;
  }
  return false;
}

template <class S>
void RandomSelector<S>::sweepTile(Tile& tile, S bound, bool* moved, bool* bounded) {
  int above = 0, illegal = 0;
  while (!reached() && tile.size() > 0 && above < kDrawsAboveBound && illegal < kDrawsIllegal) {
    drawBest(tile);
    if (!(best_[0].error <= bound)) {
      ++above;
      *bounded = *bounded || best_[0].u != kNone;
    } else if (collapseBest(bound)) {
      above = illegal = 0;
      *moved = true;
    } else {
      ++illegal;
    }
  }
}

// The error of the better edges: a tenth of all draws are below.
template <class S>
S RandomSelector<S>::sampledBound() {
  std::vector<S> errors;
  for (int i = 0; i < kSamples; ++i) {
    drawBest(tiles_.tiles()[random_.below(static_cast<uint32_t>(tiles_.tiles().size()))]);
    const S error = best_[0].error;
    if (best_[0].u != kNone && error > 0 && std::isfinite(error)) errors.push_back(error);
  }
  if (errors.empty()) return 0;
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 10];
}

template <class S>
void RandomSelector<S>::sweep(const std::function<void()>& tick) {
  if (tiles_.tiles().empty()) return;
  // note: never 0, which would not rise.
  S bound = std::max(bound_ > 0 ? bound_ * S(kFirstBound) : sampledBound(),
                     std::numeric_limits<S>::min());
  for (bool going = true; going;) {
    bool moved = false, bounded = false;
    for (Tile& tile : tiles_.tiles()) {
      sweepTile(tile, bound, &moved, &bounded);
      tick();
      if (reached()) {
        bound_ = bound;
        return;
      }
    }
    // Nothing left that is legal at any error, or everything dearer than any bound.
    going = (moved || bounded) && std::isfinite(bound);
    bound *= S(kBoundStep);
  }
}

}  // namespace

template <class S>
std::unique_ptr<Selector> makeRandomSelector(Core<S>& core, Collapser<Window<S>>& collapser,
                                             Account& account) {
  return std::make_unique<RandomSelector<S>>(core, collapser, account);
}

template std::unique_ptr<Selector> makeRandomSelector(Core<float>&, Collapser<Window<float>>&,
                                                      Account&);
template std::unique_ptr<Selector> makeRandomSelector(Core<double>&, Collapser<Window<double>>&,
                                                      Account&);

}  // namespace tetstream
