#include "fiedler.h"

#include <algorithm>
#include <cmath>

#include "random.h"

namespace tetstream {

namespace {

constexpr size_t kBlock = 4, kMost = 3 * kBlock;  // vectors of a block, of the space searched

// The space that is searched on one level: the vectors, their corrections and the last steps.
class Space {
 public:
  Space(LaplacianLevels& levels, size_t level, Account& account)
      : levels_(levels),
        level_(level),
        graph_(levels.graph(level)),
        blocks_{{Array<Four>(account), Array<Four>(account), Array<Four>(account)}},
        products_{{Array<Four>(account), Array<Four>(account), Array<Four>(account)}} {
    for (Array<Four>& block : blocks_) block.resize(graph_.vertices);
    for (Array<Four>& product : products_) product.resize(graph_.vertices);
  }

  Array<Four>& vectors() { return blocks_[0]; }
  const std::array<double, kBlock>& values() const { return values_; }

  // From the vectors of the next coarser level. They are made orthogonal, of length 1, and
  // eigenvectors as far as their own space goes. The noise stands in for vectors that are 0 there.
  void begin(const Array<Four>& coarse, const uint32_t* parent) {
    Random random(level_);
    const float noise = 1e-4f / std::sqrt(static_cast<float>(graph_.vertices));
    for (uint32_t i = 0; i < graph_.vertices; ++i) {
      blocks_[0][i] = coarse[parent[i]];
      for (size_t k = 0; k < kBlock; ++k)
        blocks_[0][i][k] += noise * (static_cast<float>(random.below(1 << 20)) * 0x1p-19f - 1);
    }
    centre(blocks_[0]);
    applyLaplacian(graph_, blocks_[0].data(), products_[0].data());
    size_ = kBlock;
    choose();
  }

  // One round. Returns the largest residual |A x - a x| / (a |x|) of the first three, before it.
  double improve() {
    const double residual = correct();
    centre(blocks_[1]);
    applyLaplacian(graph_, blocks_[1].data(), products_[1].data());
    size_ = size_ == kBlock ? 2 * kBlock : kMost;
    choose();
    return residual;
  }

 private:
  void centre(Array<Four>& block) const;
  double correct();
  void multiplyOut(std::vector<double>& gram, std::vector<double>& stiff) const;
  void choose();
  void combine(const std::vector<double>& weights);

  LaplacianLevels& levels_;
  size_t level_;
  const GraphView& graph_;
  std::array<Array<Four>, 3> blocks_, products_;  // and A times them
  std::array<double, kBlock> values_ = {};
  size_t size_ = kBlock;  // how many vectors of the space are in use
};

void Space::centre(Array<Four>& block) const {
  double sum[kBlock] = {};
  for (uint32_t i = 0; i < graph_.vertices; ++i)
    for (size_t k = 0; k < kBlock; ++k) sum[k] += static_cast<double>(block[i][k]);
  Four mean;
  for (size_t k = 0; k < kBlock; ++k) mean[k] = static_cast<float>(sum[k] / graph_.vertices);
  for (uint32_t i = 0; i < graph_.vertices; ++i) block[i] -= mean;
}

// Corrections: rough solutions for the residuals.
double Space::correct() {
  Four value;
  for (size_t k = 0; k < kBlock; ++k) value[k] = static_cast<float>(values_[k]);
  double squared[kBlock] = {};
  Array<Four>& residual = products_[1];
  for (uint32_t i = 0; i < graph_.vertices; ++i) {
    residual[i] = products_[0][i] - value * blocks_[0][i];
    for (size_t k = 0; k < kBlock; ++k)
      squared[k] += static_cast<double>(residual[i][k]) * static_cast<double>(residual[i][k]);
  }
  levels_.solveRoughly(level_, residual.data(), blocks_[1].data());
  double largest = 0;
  for (size_t k = 0; k + 1 < kBlock; ++k)
    if (values_[k] > 0) largest = std::max(largest, std::sqrt(squared[k]) / values_[k]);
  return largest;
}

// gram = S^T S, stiff = S^T A S, of the columns in use.
void Space::multiplyOut(std::vector<double>& gram, std::vector<double>& stiff) const {
  const size_t n = size_, blocks = n / kBlock;
  for (size_t a = 0; a < blocks; ++a)
    for (size_t b = 0; b < blocks; ++b)
      for (size_t k = 0; k < kBlock; ++k) {
        double g[kBlock] = {}, s[kBlock] = {};
        for (uint32_t i = 0; i < graph_.vertices; ++i) {
          const Four left = blocks_[a][i][k] * blocks_[b][i];
          const Four right = blocks_[a][i][k] * products_[b][i];
          for (size_t j = 0; j < kBlock; ++j) {
            g[j] += static_cast<double>(left[j]);
            s[j] += static_cast<double>(right[j]);
          }
        }
        for (size_t j = 0; j < kBlock; ++j) {
          gram[(a * kBlock + k) * n + b * kBlock + j] = g[j];
          stiff[(a * kBlock + k) * n + b * kBlock + j] = s[j];
        }
      }
}

// Rayleigh and Ritz: with B = V D^-1/2 of the gram matrix's eigenvectors, directions that are
// nearly dependent left out, the lowest eigenvectors of B^T S^T A S B.
void Space::choose() {
  constexpr double kDependent = 1e-5;  // of the space's most independent; float has 1e-7
  const size_t n = size_;
  std::vector<double> gram(n * n), stiff(n * n), length(n);
  multiplyOut(gram, stiff);
  for (size_t i = 0; i < n; ++i) length[i] = gram[i * n + i] > 0 ? std::sqrt(gram[i * n + i]) : 1;
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j) gram[i * n + j] /= length[i] * length[j];
  const Eigen basis = symmetricEigen(gram, n);
  std::vector<double> rows;  // of B^T, each a combination of the columns of S
  for (size_t k = 0; k < n; ++k) {
    if (basis.values[k] <= kDependent * basis.values[n - 1]) continue;
    for (size_t i = 0; i < n; ++i)
      rows.push_back(basis.vectors[k * n + i] / std::sqrt(basis.values[k]) / length[i]);
  }
  const size_t m = rows.size() / n;
  std::vector<double> projected(m * m, 0.0);
  for (size_t a = 0; a < m; ++a)
    for (size_t b = 0; b <= a; ++b) {
      double sum = 0;
      for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) sum += rows[a * n + i] * stiff[i * n + j] * rows[b * n + j];
      projected[a * m + b] = projected[b * m + a] = sum;
    }
  const Eigen found = symmetricEigen(projected, m);
  std::vector<double> weights(kBlock * n, 0.0);
  for (size_t k = 0; k < kBlock && k < m; ++k) {
    values_[k] = found.values[k];
    for (size_t a = 0; a < m; ++a)
      for (size_t i = 0; i < n; ++i)
        weights[k * n + i] += found.vectors[k * m + a] * rows[a * n + i];
  }
  combine(weights);
}

// The vectors become combinations of the columns in use; the last steps, the part of them that is
// not of the old vectors. weights: [kBlock][size_].
void Space::combine(const std::vector<double>& weights) {
  Four row[kMost] = {};
  for (size_t i = 0; i < size_; ++i)
    for (size_t k = 0; k < kBlock; ++k) row[i][k] = static_cast<float>(weights[k * size_ + i]);
  for (std::array<Array<Four>, 3>* of : {&blocks_, &products_}) {
    Four *x = (*of)[0].data(), *w = (*of)[1].data(), *p = (*of)[2].data();
    for (uint32_t i = 0; i < graph_.vertices; ++i) {
      Four step = {}, kept = {};
      for (size_t k = 0; k < kBlock; ++k) kept += x[i][k] * row[k];
      if (size_ > kBlock)
        for (size_t k = 0; k < kBlock; ++k) step += w[i][k] * row[kBlock + k];
      if (size_ > 2 * kBlock)
        for (size_t k = 0; k < kBlock; ++k) step += p[i][k] * row[2 * kBlock + k];
      p[i] = step;
      x[i] = kept + step;
    }
  }
}

}  // namespace

std::array<double, 4> lowestVectors(const GraphView& graph, Account& account,
                                    const std::function<void()>& tell, Array<Four>& x) {
  constexpr int kMostRounds = 30;  // some ten are enough
  constexpr double kEnough = 1e-2;
  LaplacianLevels levels(graph, account);
  size_t level = levels.count() - 1;
  x.resize(levels.graph(level).vertices);
  std::array<double, 4> values = levels.lowest(x.data());
  while (level-- > 0) {
    Space space(levels, level, account);
    space.begin(x, levels.parents(level));
    x.resize(0);
    for (int round = 0; round < kMostRounds; ++round) {
      tell();
      if (space.improve() < kEnough) break;
    }
    x.swap(space.vectors());
    values = space.values();
  }
  return values;
}

}  // namespace tetstream
