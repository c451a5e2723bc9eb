// Edges of curves are those that a set of pairs would have, whatever happened to them, and take no
// memory but their own while they get other names.
#include "curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "random.h"

namespace tetstream::test {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

// A map of pairs beside it, and whether they are folds.
struct Both {
  void add(uint32_t u, uint32_t v, bool is_fold) {
    curves.add(u, v, is_fold);
    put(edges, std::minmax(u, v), is_fold);
  }
  static void put(std::map<Edge, bool>& edges, const Edge& edge, bool is_fold) {
    const auto [at, is_new] = edges.emplace(edge, is_fold);
    at->second = at->second && is_fold;
  }
  void merge(uint32_t u, uint32_t v) {
    curves.merge(u, v);
    rename([&](uint32_t w) { return w == v ? u : w; });
  }
  void remap(const std::vector<uint32_t>& keep) {
    curves.remap(keep.data());
    rename([&](uint32_t w) { return keep[w]; });
  }
  template <class Name>
  void rename(const Name& name) {
    std::map<Edge, bool> renamed;
    for (const auto& [edge, is_fold] : edges) {
      const auto [a, b] = edge;
      if (name(a) != name(b) && name(a) != ~0u && name(b) != ~0u)
        put(renamed, std::minmax(name(a), name(b)), is_fold);
    }
    edges.swap(renamed);
  }
  // Folds do not join two vertices that are both on other curves.
  bool leads(const Edge& edge, bool is_fold) const {
    const auto is_on_other = [this](uint32_t v) {
      return std::any_of(edges.begin(), edges.end(), [v](const auto& e) {
        return !e.second && (e.first.first == v || e.first.second == v);
      });
    };
    return !is_fold || !is_on_other(edge.first) || !is_on_other(edge.second);
  }
  void expectSame(uint32_t vertices) const {
    EXPECT_EQ(curves.empty(), edges.empty());
    for (uint32_t u = 0; u < vertices; ++u) {
      bool any = false;
      for (uint32_t v = 0; v < vertices; ++v) {
        const auto at = u != v ? edges.find(std::minmax(u, v)) : edges.end();
        const bool is_there = at != edges.end();
        any = any || is_there;
        ASSERT_EQ(curves.has(u, v), is_there) << u << " " << v;
        ASSERT_EQ(curves.leads(u, v), is_there && leads(at->first, at->second)) << u << " " << v;
      }
      ASSERT_EQ(curves.passes(u), any) << u;
    }
  }
  Account account;
  Curves curves{account};
  std::map<Edge, bool> edges;
};

TEST(Curves, AreASetOfEdges) {
  constexpr uint32_t kVertices = 60;
  Random random(3);
  Both both;
  for (int turn = 0; turn < 40; ++turn) {
    const auto any = [&] { return static_cast<uint32_t>(random.below(kVertices)); };
    for (int i = 0; i < 30; ++i)
      if (const uint32_t u = any(), v = any(); u != v) both.add(u, v, random.below(2) > 0);
    both.expectSame(kVertices);
    for (int i = 0; i < 10; ++i)
      if (const uint32_t u = any(), v = any(); u != v) both.merge(u, v);
    both.expectSame(kVertices);
    // Those that stay move up, as the rows of a window do.
    std::vector<uint32_t> keep(kVertices, ~0u);
    uint32_t next = 0;
    for (uint32_t& name : keep)
      if (random.below(4)) name = next++;
    both.remap(keep);
    both.expectSame(kVertices);
  }
}

// What is left of many takes little, and all are still there.
TEST(Curves, GetOtherNamesInPlace) {
  constexpr uint32_t kVertices = 20000;
  Account account;
  Curves curves(account);
  for (uint32_t v = 0; v + 1 < kVertices; ++v) curves.add(v, v + 1);
  const size_t most = account.peak();
  EXPECT_EQ(most, account.used());
  std::vector<uint32_t> keep(kVertices);
  for (uint32_t v = 0; v < kVertices; ++v) keep[v] = kVertices - 1 - v;
  curves.remap(keep.data());
  EXPECT_EQ(account.peak(), most);
  EXPECT_EQ(account.used(), most);
  for (uint32_t v = 0; v + 1 < kVertices; ++v) ASSERT_TRUE(curves.has(v, v + 1)) << v;
  for (uint32_t v = 0; v < kVertices; ++v) keep[v] = v < 100 ? v : ~0u;
  curves.remap(keep.data());
  EXPECT_LT(account.used(), most / 32);
  for (uint32_t v = 0; v < 200; ++v) ASSERT_EQ(curves.has(v, v + 1), v + 1 < 100) << v;
}

}  // namespace
}  // namespace tetstream::test
