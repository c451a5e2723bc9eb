// The best edges of a vertex against a list of all of them.
#include "choices.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

#include "choice_kernels.inl"
#include "random.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

struct Counted {
  Account account;
};
class ChoicesOf : Counted, public Choices {
 public:
  explicit ChoicesOf(size_t vertices) : Choices(account) { reset(vertices); }
  void add(uint32_t v, uint32_t w, float error) { Choices::add(v, one(w, error)); }
  void replace(uint32_t x, uint32_t u, uint32_t v, float error) {
    Choices::replace(u, v, one(x, error));
  }

 private:
  EdgeList<float> one(uint32_t other, float error) {
    others_[0] = other;
    errors_[0] = error / 2;
    return {errors_, others_, 1, 2};
  }
  float errors_[kBestEdges];
  uint32_t others_[kBestEdges];
};

// Vertex 0 with edges to others, all of which it looks at.
void look(Choices& c, const std::map<uint32_t, float>& edges) {
  std::vector<uint32_t> others;
  std::vector<float> errors;
  for (const auto& [v, error] : edges) {
    others.push_back(v);
    errors.push_back(error);
  }
  const size_t count = others.size(), room = (count + kBestEdges) / kBestEdges * kBestEdges;
  others.resize(room);
  errors.resize(room);
  c.relist(0, EdgeList<float>{errors.data(), others.data(), count, 1});
}

TEST(Choices, KnowTheEightBestAndTheLeastOfTheOthers) {
  ChoicesOf c(120);
  EXPECT_EQ(c.least(0), kInf);
  for (uint32_t error : {9u, 3u, 8u, 5u}) c.add(0, 10 * error, static_cast<float>(error));
  for (uint32_t error : {4u, 10u, 2u}) c.add(10 * error, 0, static_cast<float>(error));
  for (uint32_t error : {1u, 7u, 6u}) c.add(0, 10 * error, static_cast<float>(error));
  EXPECT_EQ(c.least(40), 4);  // both ends know
  EXPECT_EQ(c.target(40), 0u);
  for (uint32_t error = 1; error <= 8; ++error) {
    EXPECT_EQ(c.least(0), static_cast<float>(error));
    EXPECT_EQ(c.target(0), 10 * error);
    EXPECT_FALSE(c.mustLookAgain(0));
    c.refuse(0, 10 * error);
    EXPECT_EQ(c.least(10 * error), kInf);
  }
  EXPECT_EQ(c.least(0), 9);  // 9 and 10 are there still, whoever they are
  EXPECT_TRUE(c.mustLookAgain(0));
  // What was refused is not listed again.
  std::map<uint32_t, float> all;
  for (uint32_t error = 1; error <= 10; ++error) all[10 * error] = static_cast<float>(error);
  look(c, all);
  EXPECT_EQ(c.target(0), 90u);
  EXPECT_EQ(c.least(0), 9);
  EXPECT_FALSE(c.mustLookAgain(0));
  EXPECT_EQ(c.least(1), kInf);
}

// Whichever of the best it is, and from whichever end.
TEST(Choices, ForgetAnyOfTheBestThatTheOtherEndRefuses) {
  for (uint32_t refused = 1; refused <= 8; ++refused) {
    ChoicesOf c(90);
    for (uint32_t error = 1; error <= 8; ++error) c.add(0, 10 * error, static_cast<float>(error));
    c.refuse(10 * refused, 0);
    for (uint32_t error = 1; error <= 8; ++error) {
      if (error == refused) continue;
      EXPECT_EQ(c.target(0), 10 * error);
      EXPECT_EQ(c.least(0), static_cast<float>(error));
      c.refuse(0, 10 * error);
    }
    EXPECT_EQ(c.least(0), kInf);
  }
}

// Rounded down, by less than a part in 2000; errors that differ by more are told apart.
TEST(Choices, KeepErrorsRoundedDown) {
  for (float error : {1e-30f, 0.1f, 1.0f, 12345.678f, 3e38f}) {
    ChoicesOf c(4096);
    c.add(0, 4095, error);
    EXPECT_LE(c.least(0), error);
    EXPECT_GE(c.least(0), error * (1 - 1.0f / 2000));
    EXPECT_EQ(c.target(0), 4095u);
    c.add(0, 1, error * (1 - 1e-3f));
    EXPECT_EQ(c.target(0), 1u);
  }
}

TEST(Choices, LeaveOutWhatIsKnownElsewhere) {
  ChoicesOf c(60);
  c.know(1, 7, false);
  EXPECT_EQ(c.least(1), 7);
  EXPECT_TRUE(c.mustLookAgain(1));
  c.passOver(2, 3, true);
  c.add(2, 5, 2);
  c.add(2, 6, 4);
  EXPECT_EQ(c.target(2), 6u);
  EXPECT_EQ(c.target(5), 2u);  // the other end knows it
  EXPECT_TRUE(c.hasRefused(2));
  c.replace(2, 6, 9, 4);  // something changed: all are looked at again
  c.reconsider();
  EXPECT_TRUE(c.mustLookAgain(2));
  EXPECT_EQ(c.least(2), 0);
}

TEST(Choices, ListVerticesUpToALevel) {
  ChoicesOf c(100);
  for (uint32_t v : {3u, 40u, 41u, 99u}) c.know(v, 2, false);
  c.know(50, 3, false);
  uint32_t found[100 + Choices::kBlock];
  EXPECT_EQ(c.listUpTo(1, 0, 100, found), 0u);
  ASSERT_EQ(c.listUpTo(2, 3, 100, found), 4u);
  EXPECT_EQ(std::vector<uint32_t>(found, found + 4), (std::vector<uint32_t>{3, 40, 41, 99}));
  EXPECT_EQ(c.listUpTo(2, 41, 100, found), 2u);  // from there on
  EXPECT_EQ(c.listUpTo(2, 4, 1, found), 2u);     // the block of the first
}

TEST(Choices, AreOrderedByTheOtherEndWhereErrorsAreEqual) {
  ChoicesOf c(10);
  for (uint32_t other : {7u, 3u, 9u}) c.add(0, other, 0);
  EXPECT_EQ(c.target(0), 3u);
  c.refuse(0, 3);
  EXPECT_EQ(c.target(0), 7u);
}

TEST(Choices, TakeNoErrorThatIsNoNumber) {
  ChoicesOf c(4);
  c.add(0, 1, std::numeric_limits<float>::quiet_NaN());
  c.add(0, 2, kInf);
  EXPECT_EQ(c.least(0), kInf);
  EXPECT_EQ(c.least(1), kInf);
  EXPECT_EQ(c.least(2), kInf);
  c.add(0, 3, std::numeric_limits<float>::max());
  EXPECT_EQ(c.target(0), 3u);
  EXPECT_LT(c.least(3), kInf);
}

TEST(Choices, ForgetARefusalWhenANeighbourIsReplaced) {
  ChoicesOf c(6);
  c.add(0, 2, 1);
  c.add(0, 1, 2);
  c.add(0, 4, 3);
  c.refuse(0, 2);
  c.reconsider();  // nothing has changed round it
  EXPECT_EQ(c.target(0), 1u);
  c.replace(0, 4, 5, 3);  // 5 was merged into 4
  c.reconsider();
  EXPECT_EQ(c.least(0), 1);
  EXPECT_EQ(c.target(0), 2u);
  EXPECT_FALSE(c.mustLookAgain(0));
}

// What was known of either of the two that were merged is void, refused or not.
TEST(Choices, KnowNothingOfWhatWasReplaced) {
  ChoicesOf c(8);
  c.add(0, 1, 1);
  c.add(0, 2, 2);
  c.refuse(0, 1);
  c.replace(0, 2, 1, 7);
  c.reconsider();
  if (c.mustLookAgain(0)) look(c, {{2, 7}});
  EXPECT_EQ(c.target(0), 2u);
  EXPECT_EQ(c.least(0), 7);
}

TEST(Choices, OfAVertexThatIsForgottenAreNone) {
  ChoicesOf c(3);
  c.add(0, 1, 1);
  c.refuse(0, 1);
  c.add(0, 2, 2);
  c.replace(0, 2, 1, 3);
  c.forget(0);
  c.reconsider();
  EXPECT_EQ(c.least(0), kInf);
}

// A neighbour collapsed: its new edge is better than one that was refused before.
TEST(Choices, TakeANewEdgeThatIsBetterThanARefusedOne) {
  ChoicesOf c(6);
  c.add(0, 3, 5);
  c.refuse(0, 3);
  c.replace(0, 2, 4, 1);
  c.reconsider();
  EXPECT_LE(c.least(0), 1);
}

// The edges of one vertex as a list, taken best first as a sweep does.
class Model {
 public:
  Model() : choices(21) {}
  void replace(uint32_t u, uint32_t v, float error) {
    for (uint32_t gone : {u, v}) {
      all_.erase(gone);
      refused_.erase(gone);
    }
    all_[u] = error;
    woken_ = true;
    choices.replace(0, u, v, error);
  }
  void reconsider() {
    if (woken_) refused_.clear();
    woken_ = false;
    choices.reconsider();
  }
  // Refuses the best, if there is one.
  void refuseBest() {
    if (choices.least(0) == kInf) return;
    while (choices.mustLookAgain(0)) look(choices, all_);
    if (choices.least(0) == kInf) return;
    const uint32_t best = choices.target(0);
    ASSERT_TRUE(all_.count(best));
    EXPECT_EQ(all_[best], choices.least(0));
    EXPECT_LE(all_[best], leastLeft());  // less: tried once more, which costs time only
    refused_.insert(best);
    choices.refuse(0, best);
  }
  float leastLeft() const {
    float least = kInf;
    for (const auto& [v, error] : all_)
      if (!refused_.count(v)) least = std::min(least, error);
    return least;
  }
  ChoicesOf choices;

 private:
  std::map<uint32_t, float> all_;
  std::set<uint32_t> refused_;
  bool woken_ = false;
};

// Any edges come and go and are refused: no edge is ever below `least`, the best one is the best,
// and once it says that there is none there is none.
TEST(Choices, AreThoseOfAListAfterAnySteps) {
  for (uint64_t seed = 0; seed < (slowRun() ? 5u : 300u); ++seed) {
    SCOPED_TRACE(seed);
    Random r(seed);
    Model m;
    for (int step = 0; step < 90 && !::testing::Test::HasFailure(); ++step) {
      const uint32_t u = 1 + r.below(20), v = 1 + (u + r.below(19)) % 20;
      const uint32_t what = r.below(10);
      if (what < 4)
        m.replace(u, v, static_cast<float>(21 * r.below(8) + u));  // no two alike
      else if (what < 5)
        m.reconsider();
      else
        m.refuseBest();
      ASSERT_LE(m.choices.least(0), m.leastLeft()) << "step " << step;
    }
    for (int k = 0; k < 40; ++k) m.refuseBest();
    EXPECT_EQ(m.leastLeft(), kInf);
    EXPECT_EQ(m.choices.least(0), kInf);
  }
}

// What is known of some vertices, after any steps, by the build for this processor and by the plain
// one.
template <class S>
class Builds {
 public:
  static constexpr uint32_t kVertices = 40;
  explicit Builds(uint64_t seed) : r_(seed) {
    for (Rows& rows : rows_)
      for (uint32_t v = 0; v < kVertices; ++v) {
        std::fill_n(rows.of[v].best, kBestEdges, kNothing);
        rows.of[v].refused = rows.of[v].passed_over = rows.of[v].also_refused = kNothing;
        rows.of[v].tried = 0;
        rows.least[v] = kInf;
        rows.woken[v] = 0;
      }
  }
  void step() {
    const uint32_t v = r_.below(kVertices);
    const auto [best, plain] = std::pair(rows_[0].table(), rows_[1].table());
    const EdgeList<S> edges = edgesOf(v);
    switch (r_.below(5)) {
      case 0:
        relistEdges(best, v, edges);
        return relistEdgesOf(plain, v, edges);
      case 1:
        addEdges(best, v, edges);
        return addEdgesOf(plain, v, edges);
      case 2:
        replaceEdges(best, v, (v + 1) % kVertices, edges);
        return replaceEdgesOf(plain, v, (v + 1) % kVertices, edges);
      case 3:
        reconsiderEdges(best, v);
        return reconsiderEdgesOf(plain, v);
    }
    if (best.least[v] == kInf || best.of[v].best[0] == kNothing) return;
    const uint32_t w = otherOf(best.of[v].best[0]);
    refuseEdge(best, v, w);
    refuseEdgeOf(plain, v, w);
  }
  bool same() const {
    return std::memcmp(rows_[0].of, rows_[1].of, sizeof rows_[0].of) == 0 &&
           std::memcmp(rows_[0].least, rows_[1].least, sizeof rows_[0].least) == 0 &&
           std::memcmp(rows_[0].woken, rows_[1].woken, sizeof rows_[0].woken) == 0;
  }

 private:
  struct Rows {
    Choice of[kVertices];
    float least[kVertices];
    uint8_t woken[kVertices];
    ChoiceTable table() { return {of, least, woken}; }
  };
  // To others, each once, at most 20 of them.
  EdgeList<S> edgesOf(uint32_t v) {
    const uint32_t first = r_.below(kVertices), most = r_.below(21);
    size_t count = 0;
    for (uint32_t k = 0; k < most; ++k) {
      others_[count] = (first + k) % kVertices;
      errors_[count] =
          r_.below(9) ? static_cast<S>(r_.below(1000)) : std::numeric_limits<S>::infinity();
      count += others_[count] != v;
    }
    return {errors_, others_, count, S(0.75)};
  }

  Random r_;
  Rows rows_[2];
  S errors_[24] = {};  // also those beyond the list, which are read and dropped
  uint32_t others_[24] = {};
};

template <class S>
void expectSameOfBuilds() {
  for (uint64_t seed = 0; seed < (slowRun() ? 3u : 60u); ++seed) {
    Builds<S> builds(seed);
    for (int k = 0; k < 200; ++k) {
      builds.step();
      ASSERT_TRUE(builds.same()) << "seed " << seed << ", step " << k;
    }
  }
}

TEST(Choices, AreTheSameFromEveryBuild) {
  expectSameOfBuilds<float>();
  expectSameOfBuilds<double>();
}

}  // namespace
}  // namespace tetstream::test
