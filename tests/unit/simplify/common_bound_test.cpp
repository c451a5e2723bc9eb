// The controller of the bound that is common to the stream, on a model of a stream whose cells are
// known at every bound.
#include <gtest/gtest.h>
#include <cmath>
#include <deque>
#include <vector>

#include "budget.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

constexpr double kDecay = 3.0 / 7;

// A piece of the stream: cells in, cells now, and cells left at a bound of 1.
struct Piece {
  double in, now, at_1;
  void simplify(double bound) { now = std::min(now, at_1 * std::pow(bound, -kDecay)); }
};

struct Model {
  int pieces = 400;
  double cells = 1000;                                     // of a piece
  double (*detail)(double) = [](double) { return 50.0; };  // at a place between 0 and 1
  int front = 4, window = 16;                              // pieces
};

// What there is when the last goal is set; `at_bound`: if all were simplified up to its bound.
struct Run {
  double in = 0, left = 0, at_bound = 0, goal = 0, least = 0, written = 0;
};

double sumOf(const std::deque<Piece>& pieces) {
  double sum = 0;
  for (const Piece& p : pieces) sum += p.now;
  return sum;
}

// Works as the loop of the simplifier does: fill, simplify what is not of the front, write the
// oldest half.
class Simulation {
 public:
  Simulation(const Model& model, Budget& budget) : model_(model), budget_(budget) {}

  // Cells out of the pieces between two places.
  double writtenOf(double from, double to) const {
    double sum = 0;
    for (size_t i = 0; i < pieces_out_.size(); ++i) {
      const double place = (static_cast<double>(i) + 0.5) / model_.pieces;
      if (place > from && place < to) sum += pieces_out_[i];
    }
    return sum;
  }

  Run run() {
    const double capacity = model_.window * model_.cells;
    for (int i = 0; i < model_.pieces; ++i) {
      if (live() + model_.cells > capacity) turn(capacity);
      const double place = (i + 0.5) / model_.pieces;
      window_.push_back({model_.cells, model_.cells, model_.detail(place)});
      read_ += model_.cells;
    }
    const Goal last = budget_.lastGoal(ledger(0));
    EXPECT_TRUE(last.last);
    const double left = live() + written_;
    for (Piece& piece : window_) piece.simplify(last.first_bound);
    return {read_,
            left,
            live() + written_,
            static_cast<double>(last.cells) + written_,
            static_cast<double>(last.least_cells) + written_,
            written_};
  }

 private:
  double live() const { return sumOf(window_); }
  size_t simplified() const {
    const auto front = static_cast<size_t>(model_.front);
    return window_.size() < front ? 0 : window_.size() - front;
  }
  Ledger ledger(double front) const {
    Ledger l;
    l.read = static_cast<int64_t>(read_);
    l.written = static_cast<int64_t>(written_);
    l.front = static_cast<int64_t>(front);
    l.live = static_cast<int64_t>(live());
    l.keep = static_cast<int64_t>(model_.window * model_.cells / 2);
    return l;
  }
  void turn(double capacity) {
    const double front = model_.front * model_.cells;
    const Ledger before = ledger(front);
    const Goal goal = budget_.goalOf(before);
    EXPECT_FALSE(goal.last);
    ASSERT_FALSE(std::isnan(goal.first_bound));
    double bound =
        goal.first_bound > 0 ? goal.first_bound / std::pow(goal.step, goal.approaches) : 1e-6;
    for (int pass = 0;; ++pass) {
      for (size_t i = 0; i < simplified(); ++i) window_[i].simplify(bound);
      const bool on_the_way =
          pass < goal.approaches && live() > static_cast<double>(goal.enough_cells);
      if (!on_the_way && live() <= static_cast<double>(goal.cells)) break;
      bound *= on_the_way ? goal.step : 1.05;
      ASSERT_LT(bound, 1e30) << "a goal of " << goal.cells;
    }
    const Ledger after = ledger(front);
    double wrote = 0;
    while (simplified() > 0 && live() > capacity / 2) {
      wrote += window_.front().now;
      pieces_out_.push_back(window_.front().now);
      window_.pop_front();
    }
    written_ += wrote;
    budget_.learn(bound, before, after, static_cast<int64_t>(wrote));
  }

  const Model& model_;
  Budget& budget_;
  std::deque<Piece> window_;
  std::vector<double> pieces_out_;
  double read_ = 0, written_ = 0;
};

// At the end there is something left to do, since what is simplified too far cannot be brought
// back; the rest comes near the target at the common bound, and never more has been written than
// may be.
void expectSteered(const Model& model, double ratio, const Pilot& pilot, bool say_total,
                   double off) {
  SCOPED_TRACE(ratio);
  const double in = model.pieces * model.cells;
  CommonBound budget({ratio, 0, 0}, say_total ? static_cast<int64_t>(in) : -1, pilot);
  const Run run = Simulation(model, budget).run();
  EXPECT_EQ(run.in, in);
  EXPECT_NEAR(run.goal, ratio * in, 1);
  EXPECT_GE(run.least, ratio * in - std::max(10.0, 0.002 * ratio * in) - 1);
  EXPECT_GE(run.left, run.least) << "simplified too far";
  EXPECT_LE(run.at_bound, run.goal * off);
  EXPECT_GE(run.at_bound, run.goal / off);
  EXPECT_LT(run.written, run.goal) << "more is written than was asked for";
}

TEST(CommonBound, SteersALongStreamToItsTarget) {
  for (double ratio : {0.5, 0.1, 0.05}) expectSteered({}, ratio, {}, true, 1.2);
}

TEST(CommonBound, SteersAStreamThatDoesNotSayItsLength) {
  for (double ratio : {0.5, 0.1, 0.05}) expectSteered({}, ratio, {}, false, 1.5);
}

TEST(CommonBound, SteersAStreamWhoseDetailChanges) {
  Model model;
  model.detail = [](double place) { return 30 + 30 * std::sin(12 * place); };
  expectSteered(model, 0.1, {}, true, 1.3);
  model.detail = [](double place) { return place < 0.5 ? 20.0 : 60.0; };
  expectSteered(model, 0.1, {}, true, 1.3);
}

// A stretch is simpler than what comes before and after, and nobody says that there is an after: it
// is not left with much less than its share of the cells, which could not be brought back. (At
// the bound of what came before it would have a tenth.)
TEST(CommonBound, LeavesEachStretchAPartOfItsShare) {
  Model model;
  model.detail = [](double place) { return place < 0.4 || place > 0.6 ? 200.0 : 20.0; };
  for (double ratio : {0.5, 0.1}) {
    SCOPED_TRACE(ratio);
    CommonBound budget({ratio, 0, 0}, 400000, {});
    Simulation simulation(model, budget);
    simulation.run();
    const double share = ratio * model.cells * 0.2 * model.pieces;
    EXPECT_GT(simulation.writtenOf(0.4, 0.6), 0.4 * share);
  }
}

// A few windows are all the stream there is: what the first ones write must leave room.
TEST(CommonBound, SteersAShortStream) {
  Model model;
  model.pieces = 50;
  for (double ratio : {0.5, 0.1, 0.02}) expectSteered(model, ratio, {}, true, 2.5);
}

// The pilot gives the bound and the shares of a run in core; also one that is somewhat wrong, and
// one that knows the shares alone.
TEST(CommonBound, FollowsAPilot) {
  Model model;
  model.pieces = 50;
  model.detail = [](double place) { return place < 0.5 ? 20.0 : 60.0; };
  for (double ratio : {0.5, 0.1, 0.02})
    for (double off : {1.0, 1.5, 0.67, 0.0}) {
      SCOPED_TRACE(off);
      Pilot pilot;
      // The bound at which all pieces together have ratio * cells.
      std::deque<Piece> all;
      double bound = 1e-9;
      for (double left = model.cells; left > ratio * model.cells; bound *= 1.001) {
        left = 0;
        for (double detail : {20.0, 60.0})
          left += 0.5 * std::min(model.cells, detail * std::pow(bound, -kDecay));
      }
      pilot.bound = off * bound;
      const double first = std::min(model.cells, 20 * std::pow(bound, -kDecay)),
                   second = std::min(model.cells, 60 * std::pow(bound, -kDecay));
      for (int k = 0; k <= 64; ++k)
        pilot.share.push_back((first * std::min(k, 32) + second * std::max(k - 32, 0)) /
                              (32 * (first + second)));
      expectSteered(model, ratio, pilot, true, 1.2);
    }
}

// A window that is smaller than the front has nothing to simplify, and nothing to learn from.
TEST(CommonBound, KeepsItsBoundWhenAllCellsAreOfTheFront) {
  CommonBound budget({0.1, 0, 0}, 1000, {});
  const Ledger full = {64, 0, 64, 64, 32, 1};
  budget.goalOf(full);
  budget.learn(1e-3, full, full, 0);
  const double bound = budget.goalOf(full).first_bound;
  EXPECT_GE(bound, 1e-4);
  EXPECT_LE(bound, 1e-2);
}

// What windows leave beside the target is made up for at the end, but not what they lose where they
// are reduced to next to nothing in one go.
TEST(CommonBound, IsApproachedByStreamsThatAreParkedOnlyWhereWindowsLeaveFew) {
  const auto approaches = [](double ratio, double parked, Effort effort) {
    CommonBound budget({ratio, 0, 0}, 100000, {}, false, effort, parked);
    const Ledger first = {20000, 0, 2000, 20000, 10000};
    budget.goalOf(first);
    budget.learn(1e-3, first, first, 900);
    return budget.goalOf(first).approaches;
  };
  EXPECT_EQ(approaches(0.01, 5, Effort::kNormal), 0) << "by twenty";
  EXPECT_GT(approaches(0.01, 5, Effort::kHigh), 0);
  EXPECT_GT(approaches(0.01, 2, Effort::kNormal), 0) << "by fifty";
  EXPECT_GT(approaches(0.01, 1, Effort::kNormal), 0);
}

// When the quadrics are carried over into other units, so is all that was learnt.
TEST(CommonBound, ChangesItsUnitsWithTheQuadrics) {
  const auto bounds = [](double rescaled, const Pilot& pilot) {
    CommonBound budget({0.1, 0, 0}, 100000, pilot);
    const Ledger first = {20000, 0, 2000, 20000, 10000};
    budget.goalOf(first);
    Ledger after = first;
    after.live = 6000;
    budget.learn(1e-3, first, after, 900);
    Ledger second = {40000, 900, 2000, 20000, 10000};
    second.rescaled = rescaled;
    const double next = budget.goalOf(second).first_bound;
    second.rescaled = 1;
    budget.learn(2 * next, second, second, 700);
    second.rescaled = rescaled;
    return std::pair(next, budget.lastGoal(second).first_bound);
  };
  for (const Pilot& pilot : {Pilot{}, Pilot{1e-3, {0, 0.5, 1}}}) {
    const auto [next, last] = bounds(1, pilot);
    const auto [next_by_4, last_by_4] = bounds(4, pilot);
    EXPECT_NEAR(next_by_4, 4 * next, 1e-9 * next);
    EXPECT_NEAR(last_by_4, 16 * last, 1e-9 * last);
  }
}

// Windows leave what is parked, and fewer passes lead to their bounds the more that is; the target
// is met at the end, from the bound that they had. Once parking has stopped it is as without it.
TEST(CommonBound, LeavesMoreToTheEndWhereCellsAreParked) {
  const auto second = [](CommonBound& budget) {
    const Ledger window = {20000, 0, 2000, 20000, 10000};
    budget.goalOf(window);
    budget.learn(1e-3, window, window, 500);
    return budget.goalOf(window);
  };
  const auto parking = [](double ratio, double times, Effort effort = Effort::kNormal) {
    return CommonBound({ratio, 0, 0}, 1000000, {}, false, effort, times);
  };
  CommonBound plain({0.06, 0, 0}, 1000000, {}), some = parking(0.04, 1.5), many = parking(0.02, 3),
                                                stopped = parking(0.06, 3),
                                                high = parking(0.02, 3, Effort::kHigh);
  stopped.stopParking();
  const Goal goal = second(plain);
  for (CommonBound* budget : {&some, &many, &stopped}) EXPECT_EQ(second(*budget).cells, goal.cells);
  EXPECT_EQ(second(stopped).approaches, goal.approaches);
  EXPECT_EQ(second(some).approaches, 2);
  EXPECT_EQ(second(many).approaches, 0);
  EXPECT_GT(second(high).approaches, 0);
  const Ledger all = {1000000, 0, 0, 60000, 60000};
  const Goal last = many.lastGoal(all);
  EXPECT_EQ(last.cells, 20000);
  EXPECT_GE(last.least_cells, 19950);
  EXPECT_GT(last.first_bound, 0);
  EXPECT_EQ(last.approaches, 0);
}

// With a front of a quarter of a million cells there is one pass on the way.
TEST(CommonBound, ApproachesOnceWithAWideFront) {
  CommonBound budget({0.02, 0, 0}, 500000000, {});
  Ledger window = {4000000, 0, 1 << 18, 1500000, 800000};
  budget.goalOf(window);
  budget.learn(1e-3, window, window, 500);
  const Goal wide = budget.goalOf(window);
  EXPECT_EQ(wide.approaches, 1);
  EXPECT_EQ(wide.step, 8);
  --window.front;
  EXPECT_EQ(budget.goalOf(window).approaches, 2);
}

// Every window of a stream that nobody knows is approached: in fewer passes than where a pilot
// tells that a strong reduction is worth them, and from not far below.
TEST(CommonBound, ApproachesInFewerPassesWithoutAPilot) {
  const auto second = [](double ratio, const Pilot& pilot, bool is_tight, bool flips = false) {
    CommonBound budget({ratio, 0, 0}, 1000000, pilot, is_tight);
    Ledger window = {20000, 0, 2000, 20000, 10000};
    window.flips = flips;
    budget.goalOf(window);
    budget.learn(1e-3, window, window, 500);
    return budget.goalOf(window);
  };
  const Pilot pilot{1e-3, {0, 0.5, 1}};
  for (double ratio : {0.5, 0.02}) {
    const Goal unknown = second(ratio, {}, false);
    EXPECT_EQ(unknown.approaches, 2);
    EXPECT_EQ(unknown.step, 3);
    EXPECT_EQ(second(ratio, {}, true).approaches, 0) << "memory is bounded";
    EXPECT_EQ(second(ratio, {}, false, true).approaches, 4) << "flips come between";
  }
  EXPECT_EQ(second(0.5, pilot, false).approaches, 4) << "the bound is the final one";
  EXPECT_EQ(second(0.5, {0, {0, 0.5, 1}}, false).approaches, 0);
  const Pilot even{0, {0, 1}};
  EXPECT_EQ(second(0.5, even, false).approaches, 1) << "no part is known";
  EXPECT_EQ(second(0.1, even, false).approaches, 0);
  EXPECT_EQ(second(0.5, even, true).approaches, 0) << "memory is bounded";
  EXPECT_EQ(second(0.02, even, false).approaches, 4) << "as with any pilot";
  const Goal known = second(0.02, pilot, false);
  EXPECT_EQ(known.approaches, 4);
  EXPECT_EQ(known.step, 2);
}

// Of some windows the first one keeps no more than its share, or than twice that where memory is
// bounded and they are few; however many may stay in it. A sample tells how large the share is.
TEST(CommonBound, LeavesCellsForOtherWindows) {
  const Pilot sampled{0, {0, 0.4, 0.7, 1}};
  for (const bool is_tight : {false, true})
    for (const Pilot& pilot : {Pilot{}, sampled})
      for (const int64_t windows : {3, 5}) {
        const int64_t cells = 100000 * windows;
        CommonBound budget({0.1, 0, 0}, cells, pilot, is_tight);
        Ledger first = {100000, 0, 10000, 100000, 50000};
        first.window = 100000;
        budget.goalOf(first);
        budget.learn(1e-6, first, first, 0);
        const double part = 90000.0 / static_cast<double>(cells);
        const double of_all = pilot.known() ? pilot.shareOf(part) : part;
        const auto share = static_cast<int64_t>(of_all * static_cast<double>(cells / 10));
        const int64_t kept = budget.goalOf(first).cells - first.front;
        const int64_t times = is_tight && windows == 3 ? 2 : 1;
        EXPECT_LE(kept, times * share);
        EXPECT_GT(kept, times * share - share / 10);
      }
}

// A window that had to pass its bound: the next one starts near where it ended.
TEST(CommonBound, StartsAgainNearWhereAWindowWasForcedTo) {
  const auto next = [](double times) {
    CommonBound budget({0.5, 0, 0}, 1000000, {});
    const Ledger window = {20000, 0, 2000, 20000, 10000};
    budget.goalOf(window);
    budget.learn(1e-3, window, window, 5000);
    Ledger second = window;
    second.read = 40000;
    second.written = 5000;
    const double first = budget.goalOf(second).first_bound;
    budget.learn(times * first, second, second, 5000);
    second.read = 60000;
    second.written = 10000;
    return std::pair(times * first, budget.goalOf(second).first_bound);
  };
  const auto [reached, start] = next(1000);
  EXPECT_GT(start, 0.5 * reached);
}

// Nothing to divide by: one cell, none, all of them, a stream of which nothing is known.
TEST(CommonBound, GivesNumbersWhateverItIsTold) {
  int wrong = 0;  // some are enough
  for (double ratio : {1.0, 1e-18, 0.1})
    for (int64_t total : {int64_t{-1}, int64_t{0}, int64_t{1}, int64_t{1} << 62})
      for (int64_t cells : {int64_t{0}, int64_t{1}, int64_t{1} << 62})
        for (double pilot_bound : {-1.0, 0.0, 1e-45, 1e38}) {
          Pilot pilot;
          if (pilot_bound >= 0) pilot = {pilot_bound, {0, 0, 1}};
          CommonBound budget({ratio, 0, cells}, total, pilot);
          for (Ledger l : {Ledger{}, Ledger{1, 0, 1, 1}, Ledger{1, 1, 0, 0}, Ledger{5, 0, 0, 5}})
            for (double bound : {0.0, 1e-45, 1.0, 1e38}) {
              const Goal goal = budget.goalOf(l);
              budget.learn(bound, l, l, 0);
              const Goal last = budget.lastGoal(l);
              EXPECT_LE(last.least_cells, last.cells);
              EXPECT_LE(last.cells, l.read);
              if ((goal.first_bound >= 0 && last.first_bound >= 0) || ++wrong > 5) continue;
              ADD_FAILURE() << "bounds of " << goal.first_bound << " and " << last.first_bound
                            << ": ratio " << ratio << ", total " << total << ", cells " << cells
                            << ", pilot " << pilot_bound << ", next learnt " << bound;
            }
        }
}

TEST(Pilot, SharesGrowFromNothingToAll) {
  const Pilot pilot = {1, {0, 0.1, 0.1, 0.7, 1}};
  EXPECT_TRUE(pilot.known());
  EXPECT_FALSE(Pilot().known());
  EXPECT_EQ(pilot.shareOf(0), 0);
  EXPECT_EQ(pilot.shareOf(1), 1);
  EXPECT_NEAR(pilot.shareOf(0.125), 0.05, 1e-15);
  EXPECT_NEAR(pilot.shareOf(0.625), 0.4, 1e-15);
  for (double part = 0; part < 1; part += 0.01)
    EXPECT_LE(pilot.shareOf(part), pilot.shareOf(part + 0.01));
}

}  // namespace
}  // namespace tetstream::test
