// mesh/topology: the edges of the window that are parts of curves: where sheets meet, or along a
// ridge. Depends on base.
#pragma once

#include <atomic>
#include <cstdint>
#include <shared_mutex>

#include "memory.h"

namespace tetstream {

// A set of edges, asked for by their ends: a hash of (vertex, neighbour), each edge twice. Curves
// are thin: it stays small beside the window, and takes nothing where the mesh has none.
//
// Folds of the boundary that nobody asked for are curves without being strata: they end and branch
// anywhere, also from a stretch of a curve of strata to another.
//
// Patches that are worked on at the same time ask and merge at the same time: a lock keeps the hash
// whole. What they are told does not depend on who comes first, since nobody else merges a vertex
// of theirs, and a vertex on their rim, which another patch may have on its own, stays on as many
// curves: collapses that would make two edges one are not legal.
class Curves {
 public:
  explicit Curves(Account& account) : places_(account) {}

  bool empty() const { return !any_.load(std::memory_order_relaxed); }
  void add(uint32_t u, uint32_t v, bool is_fold = false);  // what is both is no fold
  bool has(uint32_t u, uint32_t v) const;
  // Whether there is an edge uv along which the curves that are strata go on where its ends become
  // one: one of theirs, or a fold of which an end is on none of them.
  bool leads(uint32_t u, uint32_t v) const;
  // Whether there is an edge at v.
  bool passes(uint32_t v) const;
  // v becomes u, and an edge uv nothing.
  void merge(uint32_t u, uint32_t v);
  // Vertex v becomes keep[v]; edges of vertices that become 0xffffffff are forgotten.
  void remap(const uint32_t* keep);

 private:
  // Vertices are below 2^31: neither is an entry.
  static constexpr uint64_t kEmpty = ~uint64_t{0}, kRemoved = kEmpty - 1;
  static constexpr uint64_t kFold = uint64_t{1} << 31;  // of an entry
  // Of an entry that is not at its place yet.
  static constexpr uint64_t kWaits = uint64_t{1} << 63;
  static bool waits(uint64_t entry) { return entry != kEmpty && entry >= kWaits; }
  static uint64_t entryOf(uint32_t u, uint32_t v) { return uint64_t{u} << 32 | v; }
  static uint32_t otherOf(uint64_t entry) { return static_cast<uint32_t>(entry & ~kFold); }

  size_t placeOf(uint32_t v) const;
  uint64_t firstOf(uint32_t v) const;
  uint64_t find(uint32_t u, uint32_t v) const;
  bool holdsAny(uint32_t v) const { return count_ > 0 && firstOf(v) != kEmpty; }
  bool isOnStratum(uint32_t v) const;
  void put(uint32_t u, uint32_t v, uint64_t fold);
  void insert(uint64_t entry);
  void remove(uint64_t entry);
  // With room for so many more; for none it does not grow.
  void rebuild(size_t more, const uint32_t* keep);
  static uint64_t renamed(uint64_t entry, const uint32_t* keep);
  void place(uint64_t entry, size_t mask);

  Array<uint64_t> places_;       // a power of two of them, at most half in use
  size_t count_ = 0, used_ = 0;  // entries; places that are in use or were
  std::atomic<bool> any_ = false;
  mutable std::shared_mutex mutex_;
};

}  // namespace tetstream
