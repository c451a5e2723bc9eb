#include "spectral_clusters.h"

#include <algorithm>
#include <cmath>

#include "connectivity.h"
#include "spectral.h"

namespace tetstream {

constexpr uint64_t kMostClusters = 0xffff;   // four of them fit a key
constexpr uint64_t kLeastSize = 8;           // vertices: smaller ones are ragged
constexpr uint64_t kBytesPerCluster = 2000;  // with what they share cells with
constexpr unsigned kBits = 16;
// Of the mean squared distance of neighbours: a gradient that they do not determine is none.
constexpr double kRidge = 1e-3;

static uint64_t clusterSize(uint64_t points, uint64_t memory_bytes) {
  const uint64_t most = std::clamp<uint64_t>(memory_bytes / kBytesPerCluster, 1, kMostClusters);
  return std::max(points / most + 1, kLeastSize);
}

SpectralClusters::SpectralClusters(IndexedSource& mesh, const RankedVertices::Budget& budget,
                                   const Tell& tell)
    : mesh_(mesh),
      size_(clusterSize(static_cast<uint64_t>(mesh.schema().vertex_count), budget.memory_bytes)) {
  const auto points = static_cast<uint64_t>(mesh.schema().vertex_count);
  clusters_.resize(static_cast<size_t>(points / size_ + 1));
  findCentres([&](double share) { tell(0.1 * share); });
  findValues(budget, [&](double share) { tell(0.1 + 0.9 * share); });
}

void SpectralClusters::findCentres(const Tell& tell) {
  const ScalarType type = mesh_.schema().position_type;
  std::vector<double> rows(3 * kRowsOfPiece);
  std::vector<double> count(clusters_.size());
  readInPieces(
      static_cast<uint64_t>(mesh_.schema().vertex_count), tell, [&](uint64_t first, size_t n) {
        mesh_.readPositions(first, n, rows.data());
        for (size_t i = 0; i < n; ++i) {
          const auto c = static_cast<size_t>((first + i) / size_);
          const double weight = 1 / ++count[c];
          for (size_t k = 0; k < 3; ++k)
            clusters_[c].centre[k] += weight * (tetstream::valueAt(rows.data(), type, 3 * i + k) -
                                                clusters_[c].centre[k]);
        }
      });
}

// Cells across clusters, each set of clusters once.
void SpectralClusters::findValues(const RankedVertices::Budget& budget, const Tell& tell) {
  ExternalSort sort(0, budget.memory_bytes / 4, budget.account, budget.temp_dir);
  readAllCells(
      mesh_, [&](double share) { tell(0.5 * share); },
      [&](uint64_t, size_t count, const int64_t* corners) {
        for (size_t i = 0; i < count; ++i) {
          uint64_t of[4];
          for (size_t j = 0; j < 4; ++j) of[j] = static_cast<uint64_t>(corners[4 * i + j]) / size_;
          std::sort(of, of + 4);
          if (of[0] == of[3]) continue;
          sort.add(((of[0] << kBits | of[1]) << kBits | of[2]) << kBits | of[3]);
        }
      });
  sort.finish();
  disk_ = sort.diskBytes();
  Connectivity graph(budget.account);
  graph.vertices = static_cast<uint32_t>(clusters_.size());
  uint64_t key, last = ~uint64_t{0};
  while (sort.next(&key)) {
    if (key == last) continue;
    last = key;
    if (graph.corners.size() < 4 * size_t{graph.cells} + 4)
      graph.corners.resize(2 * graph.corners.size() + 4096);
    for (unsigned j = 0; j < 4; ++j)
      graph.corners[4 * size_t{graph.cells} + j] =
          static_cast<uint32_t>(key >> ((3 - j) * kBits) & kMostClusters);
    ++graph.cells;
  }
  graph.corners.resize(4 * size_t{graph.cells});
  Array<float> value(budget.account);
  findSpectralValues(
      graph, budget.account, [&] { tell(0.75); }, value);
  for (size_t c = 0; c < clusters_.size(); ++c) clusters_[c].value = static_cast<double>(value[c]);
  fitGradients(graph.corners);
}

namespace {

// Sums of a least-squares fit in space: of d d^T and of d times what rises along d.
struct Fit {
  double m[3][3] = {}, b[3] = {};
  void add(const double d[3], double rise) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] += d[i] * d[j];
      b[i] += d[i] * rise;
    }
  }
  // By elimination, which the ridge keeps away from nothing.
  void solve(double g[3]) {
    const double ridge = kRidge * (m[0][0] + m[1][1] + m[2][2]);
    for (int i = 0; i < 3; ++i) g[i] = 0;
    if (!(ridge > 0) || !std::isfinite(ridge)) return;
    for (int i = 0; i < 3; ++i) m[i][i] += ridge;
    for (int p = 0; p < 3; ++p)
      for (int i = p + 1; i < 3; ++i) {
        const double factor = m[i][p] / m[p][p];
        for (int j = p; j < 3; ++j) m[i][j] -= factor * m[p][j];
        b[i] -= factor * b[p];
      }
    for (int p = 2; p >= 0; --p) {
      g[p] = b[p];
      for (int j = p + 1; j < 3; ++j) g[p] -= m[p][j] * g[j];
      g[p] /= m[p][p];
    }
  }
};

}  // namespace

void SpectralClusters::fitGradients(const Array<uint32_t>& corners) {
  std::vector<Fit> fits(clusters_.size());
  for (size_t c = 0; c < corners.size(); c += 4)
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j) {
        const Cluster &a = clusters_[corners[c + i]], &b = clusters_[corners[c + j]];
        if (&a == &b) continue;
        double d[3];
        for (int k = 0; k < 3; ++k) d[k] = b.centre[k] - a.centre[k];
        fits[corners[c + i]].add(d, b.value - a.value);
      }
  for (size_t c = 0; c < clusters_.size(); ++c) fits[c].solve(clusters_[c].gradient);
}

double SpectralClusters::valueAt(uint64_t point, const double place[3]) const {
  const Cluster& cluster = clusters_[static_cast<size_t>(point / size_)];
  double value = cluster.value;
  for (int k = 0; k < 3; ++k) value += cluster.gradient[k] * (place[k] - cluster.centre[k]);
  return value;
}

}  // namespace tetstream
