#include "resolve.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "folds.h"
#include "known_cells.h"
#include "settled.h"
#include "star_kernels.h"

namespace tetstream {

constexpr uint32_t kCellsAtOnce = 4096;  // are added before the thread that follows is told

// A vertex that is final and not resolved, without a branch: kResolved is 32 times kFinal.
static unsigned isNew(unsigned flags) {
  return flags & ~(flags / (kResolved / kFinal)) & kFinal;
}

// The link of each corner that is new gets the opposite face.
template <class S>
void Resolver<S>::addToLinks(uint32_t cell, const unsigned flags[4]) {
  const Topology& mesh = core_.window.mesh;
  const uint32_t taken[4] = {0u - isNew(flags[0]), 0u - isNew(flags[1]), 0u - isNew(flags[2]),
                             0u - isNew(flags[3])};
  addToLinkSums(mesh.corners(cell), mesh.cellFlags(cell) & kNegative, taken,
                &core_.window.outRank(0));
}

// Tells new corners of their first cell, and whether cells of different regions meet there.
template <class S>
void Resolver<S>::tellCorners(uint32_t cell, const unsigned flags[4], const CellLabels& labels) {
  Topology& mesh = core_.window.mesh;
  for (int j = 0; j < 4; ++j) {
    if (!isNew(flags[j])) continue;
    const uint32_t v = mesh.corners(cell)[j];
    uint32_t& first = core_.window.scratch()[v];
    if (first == kNone)
      first = cell;
    else if (labels.differ(first, cell))
      mesh.flagVertex(v, kInterface);
  }
}

// Returns how many of the cells are of the front.
template <class S>
int64_t Resolver<S>::sumLinks(uint32_t first, uint32_t end, uint32_t first_new) {
  const Topology& mesh = core_.window.mesh;
  const CellLabels labels = core_.cellLabels();
  int64_t front = 0;
  for (uint32_t c = first; c < end; ++c) {
    if (!mesh.isLive(c)) continue;
    const uint32_t* v = mesh.corners(c);
    const unsigned f[4] = {mesh.vertexFlags(v[0]), mesh.vertexFlags(v[1]), mesh.vertexFlags(v[2]),
                           mesh.vertexFlags(v[3])};
    const unsigned all_final = f[0] & f[1] & f[2] & f[3] & kFinal;
    front += !all_final;
    if ((isNew(f[0]) | isNew(f[1]) | isNew(f[2]) | isNew(f[3])) == 0) continue;
    addToLinks(c, f);
    if (labels.count > 0 || c < first_new) tellCorners(c, f, labels);
  }
  return front;
}

// The quadrics of the new cells are added, and the links of all are summed. Each has one thread,
// since sums have an order: the second needs of new cells on which side they are, and follows the
// first. It samples them, too, for then both have as much to do. Whoever comes first is the one
// that need not wait.
template <class S>
int64_t Resolver<S>::takeNew(uint32_t first) {
  const uint32_t end = core_.window.mesh.cellEnd();
  metric_.prepare(first, end);
  KnownCells known(first);
  int64_t front = 0;
  const auto add = [&] {
    for (uint32_t c = first; c < end;) {
      const uint32_t next = c + std::min(kCellsAtOnce, end - c);
      metric_.addCells(c, next);
      known.tell(c = next);
    }
  };
  const auto follow = [&] {
    for (uint32_t c = 0, next; c < end; c = next) {
      next = known.waitFor(c);
      front += sumLinks(c, next, first);
      angles_.sample(std::clamp(c, first, next), std::max(first, next));
    }
  };
  std::atomic<bool> taken = false;
  const auto next = [&] { taken.exchange(true) ? follow() : add(); };
  doBoth(core_.tasks(), next, next);
  metric_.settle(first, end);
  return front;
}

// Stars are listed for as many vertices as fit this many corners, or a share of the window's where
// there are interfaces: bounds the memory where all vertices are on the boundary.
constexpr size_t kCornersAtOnce = 1 << 16;

// visit(place, corner): of the window's live cells, those corners whose vertex has a place.
template <class S>
template <class Visit>
void Resolver<S>::forPlaced(uint32_t first, uint32_t end, Visit visit) const {
  const Topology& mesh = core_.window.mesh;
  const uint32_t* place = core_.window.scratch();
  for (uint32_t c = first; c < end; ++c)
    if (mesh.isLive(c))
      for (uint32_t j = 0; j < 4; ++j)
        if (const uint32_t p = place[mesh.corners(c)[j]]) visit(p - 1, 4 * c + j);
}

// Lists the corners of the first vertices, as many as fit; scratch holds a vertex's place in the
// list plus one, 0 for others. Returns their number. Each part of the cells has its part of a star.
template <class S>
size_t Resolver<S>::listStars(size_t count) {
  const size_t cells = core_.window.mesh.cellEnd(), parts = core_.parts();
  for (size_t part = 0; part < parts; ++part) {
    if (next_[part].size() < count) next_[part].resize(count);
    std::fill_n(next_[part].data(), count, 0u);
  }
  core_.forPartsOfCells([this](uint32_t first, uint32_t end, size_t part) {
    forPlaced(first, end, [next = next_[part].data()](uint32_t p, uint32_t) { ++next[p]; });
  });
  const size_t most = std::max<size_t>(kCornersAtOnce, core_.region_picks.empty() ? 0 : cells / 4);
  uint32_t fitting = 0, listed = 0;
  for (; fitting < count; ++fitting) {
    uint32_t all = 0;
    for (size_t part = 0; part < parts; ++part) all += next_[part][fitting];
    if (fitting > 0 && listed + all > most) break;
    for (size_t part = 0; part < parts; ++part)
      listed += std::exchange(next_[part][fitting], listed);
  }
  if (corners_.size() < listed) corners_.resize(listed);
  core_.forPartsOfCells([this, fitting](uint32_t first, uint32_t end, size_t part) {
    forPlaced(first, end, [&, next = next_[part].data()](uint32_t p, uint32_t corner) {
      if (p < fitting) corners_[next[p]++] = corner;
    });
  });
  return fitting;
}

template <class S>
int64_t Resolver<S>::resolve(uint32_t first_new, const uint32_t* vertices, size_t count) {
  Window<S>& window = core_.window;
  Topology& mesh = window.mesh;
  for (size_t i = 0; i < count; ++i) {
    window.outRank(vertices[i]) = 0;
    window.scratch()[vertices[i]] = kNone;
  }
  const int64_t front = takeNew(first_new);
  const bool is_balanced = isBalanced();
  if (!is_balanced) pickSamples(vertices, count);
  if (open_.size() < count) open_.resize(count);
  size_t open = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t v = vertices[i];
    if (window.outRank(v) != 0 || (mesh.vertexFlags(v) & kInterface))
      open_[open++] = v;
    else
      mesh.flagVertex(v, kResolved);
    startUnsettled(window, v, window.scratch()[v] < first_new);
  }
  std::fill_n(window.scratch(), mesh.vertexEnd(), 0u);
  if (!is_balanced) balance(open);
  for (size_t done = 0; done < open;) {
    for (size_t i = done; i < open; ++i)
      window.scratch()[open_[i]] = static_cast<uint32_t>(i - done + 1);
    const size_t listed = listStars(open - done);
    resolveListed(&open_[done], listed);
    for (size_t i = 0; i < listed; ++i) window.scratch()[open_[done + i]] = 0;
    done += listed;
  }
  angles_.choose(first_new, mesh.cellEnd());
  return front;
}

template <class S>
void Resolver<S>::gather(Corners corners, Star& star) const {
  star.clear();
  for (size_t i = 0; i < corners.count; ++i)
    star.add() = core_.window.mesh.starCell(corners.first[i]);
}

template <class S>
void Resolver<S>::findFaces(const uint32_t* vertices, size_t begin, size_t end, Part& part) const {
  part.faces.clear();
  part.found.clear();
  for (size_t i = begin; i < end; ++i) {
    gather(cornersOf(i), part.star);
    Found found = {part.faces.size(), 0, part.border.find(part.star), false, false};
    if (found.is_plain) {
      const std::vector<uint64_t>& edges = part.border.edges();
      found.count = edges.size();
      found.is_disk = part.border.isCircle(edges);
      found.folds = foldsAt(vertices[i], edges);
      part.faces.insert(part.faces.end(), edges.begin(), edges.end());
    }
    part.found.push_back(found);
  }
}

// Where there is nothing but boundary, stars are looked at by several threads; then their faces are
// added in the order of the vertices. One thread does it star by star, and keeps nothing.
template <class S>
void Resolver<S>::resolveListed(const uint32_t* vertices, size_t count) {
  if (!core_.region_picks.empty() || !core_.window.faces.empty()) {
    for (size_t i = 0; i < count; ++i) resolveOpen(vertices[i], cornersOf(i));
    return;
  }
  const size_t parts = core_.parts(), step = parts > 1 ? count : 1;
  for (size_t i = 0; i < count;) {
    core_.forPartsOf(step, [&, begin = i](size_t first, size_t end, size_t part) {
      findFaces(vertices, begin + first, begin + end, parts_[part]);
    });
    for (size_t part = 0; part < parts; ++part)
      for (const Found& found : parts_[part].found) {
        found.is_plain ? addFound(vertices[i], found, parts_[part])
                       : resolveOpen(vertices[i], cornersOf(i));
        ++i;
      }
  }
}

template <class S>
void Resolver<S>::addFound(uint32_t v, const Found& found, const Part& part) {
  sheets_.clear();
  for (size_t i = found.begin; i < found.begin + found.count; ++i) {
    const uint64_t face = part.faces[i];
    addFace(v, static_cast<uint32_t>(face >> 32), static_cast<uint32_t>(face), SheetFace::kOuter,
            nullptr);
  }
  finishFaces(v, found.is_disk, found.folds);
}

template <class S>
void Resolver<S>::resolveOpen(uint32_t v, Corners corners) {
  gather(corners, star());
  resolveFaces(v);
  finishFaces(v, boundary_.empty() || parts_[0].border.isCircle(boundary_), foldsAt(v, boundary_));
}

// Where nothing is asked for; the paper's modes know no curves but those.
template <class S>
bool Resolver<S>::foldsAt(uint32_t v, const std::vector<uint64_t>& faces) const {
  const bool counts = core_.keeps_body && core_.options.feature_angle == 0;
  return counts && hasFold(core_.window, v, faces);
}

template <class S>
void Resolver<S>::finishFaces(uint32_t v, bool is_disk, bool folds) {
  Topology& mesh = core_.window.mesh;
  if (!is_disk) lockNonManifold(v);
  const bool may_move = !(sheets_.wanted() || folds) || sheets_.classify(v, folds);
  if (!may_move && sheets_.wanted()) {
    mesh.flagVertex(v, kLocked);
    ++core_.locked.corners;
  }
  mesh.flagVertex(v, kResolved);
}

// Two cells on the same side of their common face: both are passed on as they are. (A flat cell has
// no side; it was marked, and its vertices locked, when it was read.)
template <class S>
void Resolver<S>::lockFold(uint32_t a, uint32_t b) {
  Topology& mesh = core_.window.mesh;
  for (const StarCell& s : star())
    if (s.has(a) && s.has(b) && (mesh.cellFlags(s.cell) & kFlat)) return;
  for (const StarCell& s : star()) {
    if (!s.has(a) || !s.has(b)) continue;
    if (mesh.cellFlags(s.cell) & kFolded) continue;
    mesh.flagCell(s.cell, kFolded);
    core_.folds = true;
    for (int j = 0; j < 4; ++j) mesh.flagVertex(mesh.corners(s.cell)[j], kLocked);
    ++core_.report.locked_cells;
    ++core_.locked.bad_cells;
  }
}

template <class S>
void Resolver<S>::addFace(uint32_t v, uint32_t a, uint32_t b, SheetFace kind,
                          const int64_t* label) {
  Topology& mesh = core_.window.mesh;
  for (uint32_t x : {v, a, b})
    mesh.flagVertex(x, kind == SheetFace::kOuter ? kBoundary : kInterface);
  core_.interfaces |= kind == SheetFace::kInterface;
  core_.inner_sheets |= kind == SheetFace::kInner;
  sheets_.add(a, b, kind, label);
  const bool counted = (mesh.vertexFlags(a) | mesh.vertexFlags(b)) & kResolved;
  if (counted) return;
  Window<S>& window = core_.window;
  const S* x[3] = {window.values(v), window.values(a), window.values(b)};
  S* q[3] = {window.quadric(v), window.quadric(a), window.quadric(b)};
  addFaceQuadric(core_, x, kind, q);
}

// The corner of a cell that is opposite its face vab.
static uint32_t cornerAcross(const Topology& mesh, uint32_t cell, uint32_t v, uint32_t a,
                             uint32_t b) {
  const uint32_t* corners = mesh.corners(cell);
  uint32_t j = 0;
  while (corners[j] == v || corners[j] == a || corners[j] == b) ++j;
  return 4 * cell + j;
}

// Of the face of v and an edge of its link; null if it has none.
template <class S>
const int64_t* Resolver<S>::labelOf(const LinkEdge* edge, size_t cells, uint32_t v, uint32_t a,
                                    uint32_t b) {
  if (core_.window.faces.empty()) return nullptr;
  const Topology& mesh = core_.window.mesh;
  const uint32_t cell = edge[0].cell, other = edge[cells > 1 ? 1 : 0].cell;
  const uint32_t corner = cornerAcross(mesh, cell, v, a, b);
  const uint32_t across = cornerAcross(mesh, other, v, a, b);
  if (edge[0].key & 1) std::swap(a, b);
  return core_.window.faces.labelOf(corner, across, v, b, a);
}

// Of the star that was gathered: visit(a, b, first, count) for each edge of its link, with the
// `count` cells that have it from `first` on.
template <class S>
template <class Visit>
void Resolver<S>::forLinkEdges(Visit visit) {
  // Pairs of slots fit 31 bits each: a window has fewer than 2^30 vertices. The lowest bit is
  // the direction.
  if (edges_.size() < 3 * star().size()) edges_.resize(6 * star().size());
  size_t count = 0;
  for (const StarCell& s : star())
    for (int i = 0; i < 3; ++i) {
      const uint64_t a = s.t[i], b = s.t[(i + 1) % 3];
      edges_[count++] = {a < b ? a << 33 | b << 1 : b << 33 | a << 1 | 1, s.cell};
    }
  std::sort(edges_.data(), edges_.data() + count,
            [](const LinkEdge& a, const LinkEdge& b) { return a.key < b.key; });
  for (size_t i = 0, j; i < count; i = j) {
    const uint64_t pair = edges_[i].key >> 1;
    for (j = i + 1; j < count && edges_[j].key >> 1 == pair;) ++j;
    visit(static_cast<uint32_t>(pair >> 32), static_cast<uint32_t>(pair), &edges_[i], j - i);
  }
}

template <class S>
void Resolver<S>::resolveFaces(uint32_t v) {
  const CellLabels labels = core_.cellLabels();
  boundary_.clear();
  sheets_.clear();
  forLinkEdges([&](uint32_t a, uint32_t b, const LinkEdge* edge, size_t cells) {
    if (cells == 1) {
      boundary_.push_back(uint64_t{a} << 32 | b);
      addFace(v, a, b, SheetFace::kOuter, labelOf(edge, cells, v, a, b));
    } else if (cells == 2) {
      if ((edge[0].key & 1) == (edge[1].key & 1)) lockFold(a, b);
      const int64_t* label = labelOf(edge, cells, v, a, b);
      const bool differ = labels.differ(edge[0].cell, edge[1].cell);
      const SheetFace kind = differ ? SheetFace::kInterface : SheetFace::kInner;
      if (differ || label) addFace(v, a, b, kind, label);
    } else {  // a face of three cells or more, with its label if it has one
      lockNonManifold(v);
      labelOf(edge, cells, v, a, b);
    }
  });
}

// Interfaces may come later.
template <class S>
bool Resolver<S>::isBalanced() const {
  const bool has_more = !core_.balance.knows_interfaces && !core_.region_picks.empty();
  return !(core_.balance_ratio > 0) || (core_.balance.knows_outer && !has_more);
}

// Before the links' sums are written over: some of the vertices of each group, evenly spread.
template <class S>
void Resolver<S>::pickSamples(const uint32_t* vertices, size_t count) {
  const Topology& mesh = core_.window.mesh;
  const auto groupOf = [&](uint32_t v) -> Sampled* {
    if ((mesh.vertexFlags(v) & kLocked) || !(BalanceSample<S>::volumeAt(core_, v) > 0))
      return nullptr;
    if (core_.window.outRank(v) != 0) return &sampled_[0];
    return &sampled_[mesh.vertexFlags(v) & kInterface ? 1 : 2];
  };
  for (Sampled& group : sampled_) group = {};
  for (size_t i = 0; i < count; ++i)
    if (Sampled* const group = groupOf(vertices[i])) {
      ++group->of;
      group->volume += BalanceSample<S>::volumeAt(core_, vertices[i]);
    }
  size_t met[3] = {};
  for (size_t i = 0; i < count; ++i) {
    Sampled* const group = groupOf(vertices[i]);
    if (!group) continue;
    const size_t step = group->of / BalanceSample<S>::kSampled + 1;
    if (met[group - sampled_]++ % step == step / 2) group->vertices.push_back(vertices[i]);
  }
}

// From what was picked, before it has the quadrics of its sheets, of so many that are open. Of too
// little no star is looked at, which may be as large as the window; those of interfaces will be
// anyway.
template <class S>
void Resolver<S>::balance(size_t open) {
  const auto on_sheets = static_cast<double>(std::max(sampled_[0].of, sampled_[1].of));
  const bool is_enough = on_sheets >= kLeastVertices;
  if (!is_enough && sampled_[1].of < kLeastPairs) return;
  BalanceSample<S> sample(core_);
  sample.start(sampled_, core_.holdsAll());
  // Costs are those of the weights that were asked for.
  const Balance known = std::exchange(core_.balance, {});
  sampleSheet(sampled_[1].vertices, SheetFace::kInterface, sample);
  if (is_enough) {
    sample.addTouching(sampled_[0].vertices, open_.data(), open);
    sampleSheet(sampled_[0].vertices, SheetFace::kOuter, sample);
    if (isWall(sample.costs())) sample.addGaps(open_.data(), open);
    forStarsOf(sampled_[2].vertices, [&](uint32_t v) { sample.addInside(v, star()); });
  }
  core_.balance = known;
  chooseBalance(sample.costs(), core_.balance_ratio, &core_.balance);
}

// Each star is gathered first; of as many vertices as fit what lists them.
template <class S>
template <class Visit>
void Resolver<S>::forStarsOf(const std::vector<uint32_t>& vertices, Visit visit) {
  uint32_t* const place = core_.window.scratch();
  for (size_t i = 0; i < vertices.size(); ++i) place[vertices[i]] = static_cast<uint32_t>(i + 1);
  const size_t listed = listStars(vertices.size());
  for (uint32_t v : vertices) place[v] = 0;
  for (size_t i = 0; i < listed; ++i) {
    gather(cornersOf(i), star());
    visit(vertices[i]);
  }
}

// Of the star that was gathered; those of interfaces as seen from one region. Returns whether they
// all have that region on one side and the same on the other.
template <class S>
bool Resolver<S>::listSheet(SheetFace kind, std::vector<SampledFace>& faces) {
  const CellLabels labels = core_.cellLabels();
  uint32_t near = kNone, far = kNone;  // cells of the two regions
  bool is_plain = true;
  faces.clear();
  forLinkEdges([&](uint32_t a, uint32_t b, const LinkEdge* edge, size_t cells) {
    const bool is_inner = cells == 2 && labels.differ(edge[0].cell, edge[1].cell);
    if (kind == SheetFace::kOuter && cells == 1)
      faces.push_back(edge[0].key & 1 ? SampledFace{b, a} : SampledFace{a, b});
    if (kind == SheetFace::kOuter || !is_inner) return;
    if (near == kNone) {
      near = edge[0].cell;
      far = edge[1].cell;
    }
    const size_t k = labels.differ(near, edge[0].cell) ? 1 : 0;
    is_plain &= !labels.differ(near, edge[k].cell) && !labels.differ(far, edge[1 - k].cell);
    faces.push_back(edge[k].key & 1 ? SampledFace{b, a} : SampledFace{a, b});
  });
  return is_plain;
}

template <class S>
void Resolver<S>::sampleSheet(const std::vector<uint32_t>& vertices, SheetFace kind,
                              BalanceSample<S>& sample) {
  forSheetsOf(vertices, kind,
              [&](uint32_t v, const std::vector<SampledFace>& faces, bool is_plain) {
                sample.addOnSheet(v, faces, star(), kind);
                if (kind == SheetFace::kInterface && is_plain) sample.addBend(v, faces);
              });
  if (kind != SheetFace::kInterface) return;
  const auto add = [&](uint32_t v, const std::vector<SampledFace>& faces, bool is_plain) {
    if (is_plain) sample.addPartner(v, faces);
  };
  for (auto p = sample.partners(); !p.empty(); p = sample.partners()) forSheetsOf(p, kind, add);
}

// visit(v, faces, is_plain) for those whose sheet has nothing yet of what its quadrics will have.
template <class S>
template <class Visit>
void Resolver<S>::forSheetsOf(const std::vector<uint32_t>& vertices, SheetFace kind, Visit visit) {
  const Topology& mesh = core_.window.mesh;
  std::vector<SampledFace> faces;
  forStarsOf(vertices, [&](uint32_t v) {
    const bool is_plain = listSheet(kind, faces);
    const auto is_told = [&](const SampledFace& face) {
      return (mesh.vertexFlags(face.a) | mesh.vertexFlags(face.b)) & kResolved;
    };
    if (!faces.empty() && std::none_of(faces.begin(), faces.end(), is_told))
      visit(v, faces, is_plain);
  });
}

template <class S>
void Resolver<S>::lockNonManifold(uint32_t v) {
  core_.window.mesh.flagVertex(v, kLocked);
  ++core_.locked.non_manifold;
}

template class Resolver<float>;
template class Resolver<double>;

}  // namespace tetstream
