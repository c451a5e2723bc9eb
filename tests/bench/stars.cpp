// Ways to find the cells round a vertex: links from corner to corner, lists over the window, and
// lists in patches. Each gathers the star of every free vertex of one window, once.
#include <cstdio>
#include <limits>
#include <random>

#include "patch.h"
#include "settled.h"
#include "status.h"
#include "structures.h"
#include "tiling.h"

namespace tetstream::bench {
namespace {

constexpr float kEverything = std::numeric_limits<float>::infinity();

// Consecutive cells from the middle of a stream, their vertices in slots by rank. Free are those
// with all their cells among them.
struct Piece {
  Piece(const Recording& stream, size_t size);

  size_t cellCount() const { return corners.size() / 4; }
  size_t vertexCount() const { return ranks.size(); }
  std::vector<uint32_t> ranks;    // by slot
  std::vector<uint32_t> corners;  // [][4] slots
  std::vector<uint8_t> flags;
  std::vector<uint32_t> free, shuffled;
};

Piece::Piece(const Recording& stream, size_t size) {
  const size_t count = std::min(size, stream.cellCount());
  const size_t first = (stream.cellCount() - count) / 2 * 4, end = first + 4 * count;
  std::vector<uint8_t> used(stream.vertices, kFinal);
  for (size_t i = 0; i < first; ++i) used[stream.cells[i]] = kFinal | kWritten;
  for (size_t i = end; i < stream.cells.size(); ++i) used[stream.cells[i]] &= kWritten;
  ranks.assign(stream.cells.begin() + static_cast<ptrdiff_t>(first),
               stream.cells.begin() + static_cast<ptrdiff_t>(end));
  corners = ranks;
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  std::vector<uint32_t> slots(stream.vertices);
  for (uint32_t slot = 0; slot < ranks.size(); ++slot) slots[ranks[slot]] = slot;
  for (uint32_t& corner : corners) corner = slots[corner];
  for (uint32_t rank : ranks) flags.push_back(used[rank]);
  for (uint32_t slot = 0; slot < ranks.size(); ++slot)
    if (isFreeVertex(flags[slot])) free.push_back(slot);
  shuffled = free;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
}

void add(const Piece& piece, Topology& mesh) {
  for (uint8_t flags : piece.flags) mesh.addVertex(flags);
  for (size_t c = 0; c < piece.cellCount(); ++c) mesh.addCell(&piece.corners[4 * c], 0);
}

// Empties the mesh; its memory stays.
void clear(Topology& mesh) {
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c) mesh.kill(c);
  const std::vector<uint32_t> none(mesh.vertexEnd(), kNone);
  mesh.pack(none.data(), 0, [](uint32_t, uint32_t) {});
}

// What was seen on a walk; the same for all structures.
struct Seen {
  uint64_t cells = 0, slots = 0;
  bool operator==(const Seen&) const = default;
};

struct Walker {
  explicit Walker(Account& account) : star(account), ring(account) {}

  template <class Gather>
  void walk(const std::vector<uint32_t>& order, Gather gather) {
    for (uint32_t v : order) {
      gather(v, star, ring);
      seen.cells += star.size();
    }
  }
  template <class Gather, class SlotOf>
  void check(const std::vector<uint32_t>& order, Gather gather, SlotOf slot_of) {
    for (uint32_t v : order) {
      gather(v, star, ring);
      for (const StarCell& s : star)
        for (uint32_t t : s.t) seen.slots += uint64_t{slot_of(v)} * slot_of(t);
    }
  }

  Star star, ring;
  Seen seen;
};

struct Times {
  std::vector<double> add, build, load, walk, shuffled;
  double bytes_per_cell = 0, beside = 0;
  Seen seen;
};

size_t bytesOf(const Piece& piece, bool linked) {
  Account account;
  const Topology mesh(account, piece.cellCount(), piece.vertexCount(), linked);
  return account.used();
}

class Links {
 public:
  explicit Links(const Piece& piece)
      : piece_(piece),
        mesh_(account_, piece.cellCount(), piece.vertexCount(), true),
        walker_(account_) {}

  void round(Times& times) {
    clear(mesh_);
    times.add.push_back(nsOf([&] { add(piece_, mesh_); }));
    const auto gather = [this](uint32_t v, Star& star, Star& ring) {
      mesh_.gather(v, kNone, star, ring);
    };
    walker_.seen = {};
    times.walk.push_back(nsOf([&] { walker_.walk(piece_.free, gather); }));
    walker_.check(piece_.free, gather, [](uint32_t v) { return v; });
    times.seen = walker_.seen;
    times.shuffled.push_back(nsOf([&] { walker_.walk(piece_.shuffled, gather); }));
    times.bytes_per_cell = static_cast<double>(bytesOf(piece_, true));
  }

 private:
  const Piece& piece_;
  Account account_;
  Topology mesh_;
  Walker walker_;
};

// As Topology's, which is in line there: a call for each cell would be half of the walk.
inline StarCell starCell(const Topology& mesh, uint32_t corner) {
  const uint32_t* v = mesh.corners(corner / 4);
  const uint8_t* t = kOpposite[corner % 4];
  const bool negative = mesh.cellFlags(corner / 4) & kNegative;
  return {corner, {v[t[0]], v[t[negative ? 2 : 1]], v[t[negative ? 1 : 2]]}};
}

// The corners of every free vertex, one vertex after the other.
class Lists {
 public:
  explicit Lists(const Piece& piece)
      : piece_(piece),
        mesh_(account_, piece.cellCount(), piece.vertexCount(), false),
        walker_(account_),
        begin_(piece.vertexCount() + 2),
        corners_(4 * piece.cellCount()) {}

  void round(Times& times) {
    clear(mesh_);
    times.add.push_back(nsOf([&] { add(piece_, mesh_); }));
    times.build.push_back(nsOf([&] { build(); }));
    const auto gather = [this](uint32_t v, Star& star, Star& ring) { look(v, kNone, star, ring); };
    walker_.seen = {};
    times.walk.push_back(nsOf([&] { walker_.walk(piece_.free, gather); }));
    walker_.check(piece_.free, gather, [](uint32_t v) { return v; });
    times.seen = walker_.seen;
    times.shuffled.push_back(nsOf([&] { walker_.walk(piece_.shuffled, gather); }));
    const size_t lists = begin_[piece_.vertexCount()] + begin_.size();
    times.bytes_per_cell = static_cast<double>(bytesOf(piece_, false) + lists * sizeof(uint32_t));
  }

 private:
  // Sorted by counting: begin_[v + 1] is where v's next corner goes, and so v's end at last.
  void build() {
    std::fill(begin_.begin(), begin_.end(), 0u);
    const uint32_t end = 4 * mesh_.cellEnd();
    for (uint32_t i = 0; i < end; ++i) {
      const uint32_t v = mesh_.corners(0)[i];
      begin_[v + 2] += mesh_.isFree(v);
    }
    for (size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    for (uint32_t i = 0; i < end; ++i) {
      const uint32_t v = mesh_.corners(0)[i];
      if (mesh_.isFree(v)) corners_[begin_[v + 1]++] = i;
    }
  }

  void look(uint32_t v, uint32_t other, Star& star, Star& ring) const {
    star.clear();
    ring.clear();
    for (uint32_t i = begin_[v]; i < begin_[v + 1]; ++i) {
      const StarCell cell = starCell(mesh_, corners_[i]);
      (cell.has(other) ? ring : star).add() = cell;
    }
  }

  const Piece& piece_;
  Account account_;
  Topology mesh_;
  Walker walker_;
  std::vector<uint32_t> begin_, corners_;
};

// As Patch::gather, without vectors.
void lookPlainly(const Patch<float>& patch, uint32_t v, uint32_t other, Star& star, Star& ring) {
  star.clear();
  ring.clear();
  for (uint32_t i = 0; i < patch.starSize(v); ++i) {
    const uint32_t c = patch.starOf(v)[i];
    const uint16_t* of = patch.corners() + 4 * size_t{c};
    const uint32_t j = of[0] == v ? 0 : of[1] == v ? 1 : of[2] == v ? 2 : 3;
    const uint8_t* t = kOpposite[j];
    const StarCell cell = {4 * c + j, {of[t[0]], of[t[1]], of[t[2]]}};
    (cell.has(other) ? ring : star).add() = cell;
  }
}

// One measured component, so that a patch loads what a run would.
Schema oneField() {
  Schema schema;
  schema.fields.push_back({"field", 1, ScalarType::kFloat32});
  return schema;
}

class Patches {
 public:
  Patches(const Piece& piece, const Recording& stream)
      : piece_(piece),
        plan_(makePlan(oneField(), options_)),
        core_(plan_, options_, account_, piece.cellCount(), piece.vertexCount(), 0),
        tiling_(core_, tiling_account_),
        patch_(patch_account_, core_.window),
        walker_(account_) {
    Window<float>& window = core_.window;
    for (uint32_t v = 0; v < piece.vertexCount(); ++v) {
      std::copy_n(&stream.positions[3 * size_t{piece.ranks[v]}], 3, window.values(v));
      window.values(v)[3] = 0;
      std::fill_n(window.quadric(v), window.shape().quadric, 0.0f);
      unsettle(window, v);
    }
  }

  void round(Times& times, Times& plain) {
    clear(core_.window.mesh);
    times.add.push_back(nsOf([&] { add(piece_, core_.window.mesh); }));
    times.build.push_back(nsOf([&] { tiling_.build(0, kEverything); }));
    walker_.seen = {};
    seen_plainly_ = {};
    for (Times* t : {&times, &plain}) {
      t->walk.push_back(0);
      t->shuffled.push_back(0);
    }
    times.load.push_back(0);
    for (const TilePiece& tile : tiling_.tiles()) walkTile(tile, times, plain);
    times.seen = walker_.seen;
    plain.add = times.add, plain.build = times.build, plain.load = times.load;
    plain.seen = seen_plainly_;
    plain.bytes_per_cell = times.bytes_per_cell =
        static_cast<double>(bytesOf(piece_, false) + tiling_account_.used());
    plain.beside = times.beside = static_cast<double>(patch_account_.used());
  }

 private:
  void walkTile(const TilePiece& tile, Times& times, Times& plain) {
    times.load.back() += nsOf([&] {
      if (!patch_.load(tiling_.vertices(tile), tile.vertexCount(), tiling_.listCells(tile, listed_),
                       tile.cell_count, core_.window.liveCells()))
        fail(Status::kUnsupported, "a tile is too large for a patch");
    });
    order_.resize(patch_.ownedEnd());
    for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) order_[v] = v;
    shuffled_ = order_;
    std::shuffle(shuffled_.begin(), shuffled_.end(), std::mt19937(1));
    walkPatch(times,
              [this](uint32_t v, Star& star, Star& ring) { patch_.gather(v, kNone, star, ring); });
    std::swap(walker_.seen, seen_plainly_);
    walkPatch(plain, [this](uint32_t v, Star& star, Star& ring) {
      lookPlainly(patch_, v, kNone, star, ring);
    });
    std::swap(walker_.seen, seen_plainly_);
  }

  template <class Gather>
  void walkPatch(Times& times, Gather gather) {
    times.walk.back() += nsOf([&] { walker_.walk(order_, gather); });
    walker_.check(order_, gather, [this](uint32_t v) { return patch_.slotOf(v); });
    const Seen seen = walker_.seen;
    times.shuffled.back() += nsOf([&] { walker_.walk(shuffled_, gather); });
    walker_.seen = seen;
  }

  const Piece& piece_;
  const SimplifyOptions options_;
  const Plan plan_;
  Account account_, tiling_account_, patch_account_;
  Core<float> core_;
  Tiling<float> tiling_;
  Array<uint32_t> listed_{tiling_account_};
  Patch<float> patch_;
  Walker walker_;
  Seen seen_plainly_;
  std::vector<uint32_t> order_, shuffled_;
};

void print(const char* name, const Piece& piece, const Times& times) {
  const double cells = static_cast<double>(piece.cellCount());
  std::printf("| %s |", name);
  for (const auto* of : {&times.add, &times.build, &times.load, &times.walk, &times.shuffled})
    of->empty() ? std::printf(" - |") : std::printf(" %.1f |", median(*of) / cells);
  std::printf(" %.1f |", times.bytes_per_cell / cells);
  times.beside > 0 ? std::printf(" %.0f |\n", times.beside / 1024) : std::printf(" - |\n");
}

}  // namespace

void compareStars(const Recording& stream, size_t window, int rounds) {
  const Piece piece(stream, window);
  if (piece.free.empty()) fail(Status::kUnsupported, "no vertex is free in a window that small");
  Links links(piece);
  Lists lists(piece);
  Patches patches(piece, stream);
  Times of_links, of_lists, of_patches, of_plain;
  for (int i = 0; i < rounds; ++i) {
    links.round(of_links);
    lists.round(of_lists);
    patches.round(of_patches, of_plain);
    for (const Times* t : {&of_lists, &of_patches, &of_plain})
      if (!(t->seen == of_links.seen)) fail(Status::kBadData, "stars differ");
  }
  std::printf("window: %zu cells, %zu vertices, %zu free, %llu cells in their stars\n\n",
              piece.cellCount(), piece.vertexCount(), piece.free.size(),
              static_cast<unsigned long long>(of_links.seen.cells));
  std::printf(
      "| stars | add | lists or tiles | load | walk | walk, shuffled | bytes / cell | "
      "patch KB |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  print("links, 32 bits", piece, of_links);
  print("lists, 32 bits", piece, of_lists);
  print("patches, 16 bits", piece, of_patches);
  print("patches, 16 bits, plain loop", piece, of_plain);
}

}  // namespace tetstream::bench
