#include "sample_rates.h"

#include <algorithm>

namespace tetstream {

constexpr size_t kLeastBricks = 8;  // with fewer that have vertices inside nothing is known
// Of the mean: a part of the stream for which bricks left nothing is not the same all along.
constexpr double kLeastRate = 0.1;

namespace {

class Sums {
 public:
  // Or, with a sign of -1, takes it away again.
  void add(const BrickLeft& brick, double sign = 1) {
    inside_ += sign * brick.inside;
    left_ += sign * brick.left;
    for (size_t k = 0; k < kStreamParts; ++k) {
      kept_[k] += sign * brick.left * brick.cells[k];
      met_[k] += sign * brick.inside * brick.cells[k];
    }
  }
  double mean() const { return left_ / inside_; }
  std::vector<double> rates(size_t bricks) const;

 private:
  std::array<double, kStreamParts> kept_ = {}, met_ = {};
  double inside_ = 0, left_ = 0;
};

// Of each part the share that is left of what was met in it and in its neighbours, as many as come
// to a brick; where they met nothing, by the next ones that did. A part of which nothing is known
// is rather like those beside it than like all: 14 million cells that were sampled by sixteen
// bricks had 0.122 % RMS error with the mean there, 0.072 % with this.
std::vector<double> Sums::rates(size_t bricks) const {
  const size_t reach = kStreamParts / (2 * bricks);
  std::vector<double> rates;
  for (size_t k = 0; k < kStreamParts; ++k) {
    double kept = kept_[k], all = met_[k];
    const auto add = [&](size_t part) {
      kept += kept_[part];
      all += met_[part];
    };
    for (size_t away = 1; away < kStreamParts && (away <= reach || !(all > 0)); ++away) {
      if (away <= k) add(k - away);
      if (k + away < kStreamParts) add(k + away);
    }
    rates.push_back(std::max(kept / all, kLeastRate * mean()));
  }
  return rates;
}

// Times `left`, and no more than all: so that the mean is `ratio`.
double scaleFor(const std::vector<double>& left, double ratio) {
  const auto mean = [&](double scale) {
    double sum = 0;
    for (double part : left) sum += std::min(scale * part, 1.0);
    return sum / static_cast<double>(left.size());
  };
  double low = 0, high = 1 / *std::min_element(left.begin(), left.end());
  for (int k = 0; k < 50; ++k) (mean((low + high) / 2) < ratio ? low : high) = (low + high) / 2;
  return high;
}

double meanWhere(const BrickLeft& brick, const std::vector<double>& rates) {
  double sum = 0, cells = 0;
  for (size_t k = 0; k < kStreamParts; ++k) {
    sum += brick.cells[k] * rates[k];
    cells += brick.cells[k];
  }
  return sum / cells;
}

// Each brick is foretold by the others: once by those near in the stream, once by all. On meshes
// where all do it better, sampled rates gave 1.05 to 2.7 times the errors without a sample at
// ratios of 0.3 to 0.7; on a layered one where those near do it better by far, a tenth.
bool foretellEachOther(const std::vector<BrickLeft>& bricks, Sums others, double scale) {
  double by_near = 0, by_all = 0;
  for (const BrickLeft& brick : bricks) {
    others.add(brick, -1);
    const auto off = [&](double rate) {
      const double left = std::min(scale * brick.left / brick.inside, 1.0);
      const double difference = std::min(scale * rate, 1.0) - left;
      return brick.inside * difference * difference;
    };
    by_near += off(meanWhere(brick, others.rates(bricks.size())));
    by_all += off(others.mean());
    others.add(brick);
  }
  return by_near < by_all;
}

}  // namespace

std::vector<double> sampledRates(const std::vector<BrickLeft>& bricks, double ratio) {
  Sums all;
  for (const BrickLeft& brick : bricks) all.add(brick);
  if (bricks.size() < kLeastBricks || !(all.mean() > 0)) return {};
  std::vector<double> rates = all.rates(bricks.size());
  const double scale = scaleFor(rates, ratio);
  if (!foretellEachOther(bricks, all, scale)) return {ratio};
  for (double& rate : rates) rate = std::min(scale * rate, 1.0);
  return rates;
}

}  // namespace tetstream
