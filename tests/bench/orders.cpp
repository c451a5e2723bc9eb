// orders MESH...: what front each order of a mesh's vertices gives, one Markdown table per mesh.
// Seconds are those of the processor, MB the memory beside the mesh, both of the ranks alone (none:
// of the measure). Principal directions are the eigenvectors of
// the covariance of the vertices, the longest one first.
#include <array>
#include <cstdio>
#include <numeric>
#include <vector>

#include "breadth_first.h"
#include "registry.h"
#include "spectral.h"
#include "status.h"
#include "structures.h"
#include "sweep_order.h"
#include "symmetric_eigen.h"

namespace tetstream::bench {
namespace {

struct Mesh {
  Account account;
  Connectivity connectivity{account};
  std::vector<double> positions;  // [vertices][3]
};

void readCells(IndexedSource& source, Connectivity& mesh) {
  mesh.corners.resize(4 * size_t{mesh.cells});
  std::vector<int64_t> rows(4 * size_t{mesh.cells});
  source.readCells(0, mesh.cells, rows.data());
  for (size_t i = 0; i < rows.size(); ++i) mesh.corners[i] = static_cast<uint32_t>(rows[i]);
}

void readPlaces(IndexedSource& source, Mesh& mesh) {
  Connectivity& to = mesh.connectivity;
  std::vector<double> rows(3 * size_t{to.vertices});
  mesh.positions.resize(rows.size());
  source.readPositions(0, to.vertices, rows.data());
  convertScalars(rows.data(), source.schema().position_type, mesh.positions.data(),
                 ScalarType::kFloat64, rows.size());
  to.places.resize(rows.size());
  for (size_t axis = 0; axis < 3; ++axis) {
    double low = mesh.positions[axis], high = low;
    for (size_t v = 0; v < to.vertices; ++v) {
      low = std::min(low, mesh.positions[3 * v + axis]);
      high = std::max(high, mesh.positions[3 * v + axis]);
    }
    for (size_t v = 0; v < to.vertices; ++v)
      to.places[axis * to.vertices + v] =
          high > low ? static_cast<float>((mesh.positions[3 * v + axis] - low) / (high - low)) : 0;
  }
}

void read(const char* path, Mesh& mesh) {
  const Input input = needFormat("", path).open(openFile(path), {});
  if (!input.indexed) fail(Status::kUnsupported, "%s is no indexed mesh", path);
  mesh.connectivity.vertices = static_cast<uint32_t>(input.schema().vertex_count);
  mesh.connectivity.cells = static_cast<uint32_t>(input.schema().cell_count);
  readCells(*input.indexed, mesh.connectivity);
  readPlaces(*input.indexed, mesh);
}

void print(const char* name, const OrderFront& front, double seconds, const Account& account) {
  std::printf("| %s | %lld | %lld | %.0f | %lld | %.2f | %.0f |\n", name,
              static_cast<long long>(front.front_width), static_cast<long long>(front.front_span),
              front.mean_width, static_cast<long long>(front.front_cells), seconds,
              static_cast<double>(account.peak()) / (1 << 20));
  std::fflush(stdout);
}

template <class Order>
void time(const char* name, const Mesh& mesh, Order order) {
  Account account, of_measure;
  Array<uint32_t> rank(account, mesh.connectivity.vertices);
  const double seconds = nsOf([&] { order(account, rank); }) * 1e-9;
  print(name, frontOfRanks(mesh.connectivity, rank, of_measure), seconds, account);
}

// Cells as they stand in the file.
void timeFileOrder(const Mesh& mesh) {
  Account account;
  StreamOrder order(account);
  const double seconds = nsOf([&] {
    order.cell_at.resize(mesh.connectivity.cells);
    std::iota(order.cell_at.data(), order.cell_at.data() + order.cell_at.size(), 0u);
    followCells(mesh.connectivity, account, order);
  });
  print("none", order, seconds * 1e-9, account);
}

template <class Key>
void sortBy(const std::vector<Key>& key, Array<uint32_t>& rank) {
  std::vector<uint32_t> order(key.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return key[a] < key[b]; });
  for (size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<uint32_t>(i);
}

Eigen covariance(const Mesh& mesh) {
  const size_t count = mesh.connectivity.vertices;
  double mean[3] = {}, sum[9] = {};
  for (size_t i = 0; i < 3 * count; ++i)
    mean[i % 3] += mesh.positions[i] / static_cast<double>(count);
  for (size_t v = 0; v < count; ++v)
    for (size_t i = 0; i < 9; ++i)
      sum[i] += (mesh.positions[3 * v + i / 3] - mean[i / 3]) *
                (mesh.positions[3 * v + i % 3] - mean[i % 3]);
  return symmetricEigen({sum, sum + 9}, 3);
}

void sweepAlong(const Mesh& mesh, const double* direction, Array<uint32_t>& rank) {
  std::vector<double> key(mesh.connectivity.vertices);
  for (size_t v = 0; v < key.size(); ++v)
    for (size_t i = 0; i < 3; ++i) key[v] += mesh.positions[3 * v + i] * direction[i];
  sortBy(key, rank);
}

// Hilbert's curve, 21 bits an axis, after Skilling 2004: the axes become the transposed index.
uint64_t hilbertKey(std::array<uint32_t, 3> at) {
  constexpr uint32_t kTop = 1u << 20;
  for (uint32_t q = kTop; q > 1; q >>= 1)
    for (uint32_t& x : at) {
      if (x & q) {
        at[0] ^= q - 1;
      } else {
        const uint32_t t = (at[0] ^ x) & (q - 1);
        at[0] ^= t;
        x ^= t;
      }
    }
  at[1] ^= at[0];
  at[2] ^= at[1];
  uint32_t t = 0;
  for (uint32_t q = kTop; q > 1; q >>= 1)
    if (at[2] & q) t ^= q - 1;
  uint64_t key = 0;
  for (uint32_t q = kTop; q > 0; q >>= 1)
    for (const uint32_t x : at) key = key << 1 | ((x ^ t) & q ? 1 : 0);
  return key;
}

void orderHilbert(const Mesh& mesh, Array<uint32_t>& rank) {
  const size_t count = mesh.connectivity.vertices;
  double low[3] = {}, size = 0;
  for (size_t i = 0; i < 3; ++i) {
    low[i] = mesh.positions[i];
    double high = low[i];
    for (size_t v = 0; v < count; ++v) {
      low[i] = std::min(low[i], mesh.positions[3 * v + i]);
      high = std::max(high, mesh.positions[3 * v + i]);
    }
    size = std::max(size, high - low[i]);
  }
  std::vector<uint64_t> key(count);
  for (size_t v = 0; v < count; ++v) {
    std::array<uint32_t, 3> at;
    for (size_t i = 0; i < 3; ++i)
      at[i] = static_cast<uint32_t>((mesh.positions[3 * v + i] - low[i]) / size * ((1 << 21) - 1));
    key[v] = hilbertKey(at);
  }
  sortBy(key, rank);
}

void compareOrders(const char* path) {
  Mesh mesh;
  read(path, mesh);
  const Connectivity& in = mesh.connectivity;
  const auto tell = [] {};
  std::printf("%s: %u cells, %u vertices\n\n", path, in.cells, in.vertices);
  std::printf("| order | width | span | mean width | front cells | s | MB |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
  timeFileOrder(mesh);
  for (int axis = 0; axis < 3; ++axis)
    time(axis == 0   ? "x"
         : axis == 1 ? "y"
                     : "z",
         mesh,
         [&](Account& account, Array<uint32_t>& rank) { rankAlong(in, axis, account, rank); });
  const Eigen directions = covariance(mesh);
  for (size_t i = 3; i-- > 0;)
    time(i == 2   ? "principal 1"
         : i == 1 ? "principal 2"
                  : "principal 3",
         mesh, [&](Account&, Array<uint32_t>& rank) {
           sweepAlong(mesh, &directions.vectors[3 * i], rank);
         });
  time("hilbert", mesh, [&](Account&, Array<uint32_t>& rank) { orderHilbert(mesh, rank); });
  time("breadth-first", mesh, [&](Account& account, Array<uint32_t>& rank) {
    orderBreadthFirst(in, account, tell, rank);
  });
  time("spectral", mesh,
       [&](Account& account, Array<uint32_t>& rank) { orderSpectral(in, account, tell, rank); });
  std::printf("\n");
}

}  // namespace
}  // namespace tetstream::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: orders MESH...\n", stderr);
    return 1;
  }
  try {
    for (int i = 1; i < argc; ++i) tetstream::bench::compareOrders(argv[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "orders: %s\n", error.what());
    return 1;
  }
  return 0;
}
