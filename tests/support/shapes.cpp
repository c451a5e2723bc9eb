#include "shapes.h"

#include <cmath>

#include "random.h"

namespace tetstream::test {

// Kuhn's split: the six monotone paths from corner 0 to corner 7 of a cube (bits: x, y, z), each
// with positive volume.
static const int kPaths[6][4] = {{0, 1, 3, 7}, {0, 1, 7, 5}, {0, 2, 7, 3},
                                 {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 7, 6}};

TestMesh cubes(int nx, int ny, int nz, const Keep& keep, double jitter, ScalarType type) {
  Random random(7);
  std::vector<double> positions;
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x)
        for (int at : {x, y, z})
          positions.push_back(at + jitter * (2.0 * random.below(1001) / 1000.0 - 1.0));
  std::vector<int64_t> cells;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        if (!keep(x, y, z)) continue;
        for (const auto& path : kPaths)
          for (int corner : path)
            cells.push_back(
                (x + (corner & 1)) +
                static_cast<int64_t>(nx + 1) *
                    ((y + (corner >> 1 & 1)) + static_cast<int64_t>(ny + 1) * (z + (corner >> 2))));
      }
  return inStreamOrder(makeMesh(type, positions, cells));
}

TestMesh fullGrid(int nx, int ny, int nz, double jitter, ScalarType type) {
  return cubes(
      nx, ny, nz, [](int, int, int) { return true; }, jitter, type);
}

TestMesh slitGrid(int n) {
  TestMesh mesh = fullGrid(n, n, n);
  const double middle = n / 2;
  std::vector<double> positions;
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(mesh.position(v, i));
  std::vector<int64_t> twin(mesh.vertexCount(), -1);
  const auto inSlit = [&](size_t v) {
    return mesh.position(v, 0) == middle && mesh.position(v, 1) > 1 &&
           mesh.position(v, 1) < n - 1 && mesh.position(v, 2) > 1 && mesh.position(v, 2) < n - 1;
  };
  for (size_t v = 0; v < twin.size(); ++v) {
    if (!inSlit(v)) continue;
    twin[v] = static_cast<int64_t>(positions.size() / 3);
    for (int i = 0; i < 3; ++i) positions.push_back(mesh.position(v, i));
  }
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    double sum = 0;
    for (size_t j = 0; j < 4; ++j)
      sum += mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), 0);
    for (size_t j = 0; sum > 4 * middle && j < 4; ++j) {
      int64_t& v = mesh.cells[4 * c + j];
      if (twin[static_cast<size_t>(v)] >= 0) v = twin[static_cast<size_t>(v)];
    }
  }
  return inStreamOrder(makeMesh(ScalarType::kFloat64, positions, mesh.cells));
}

TestMesh shellGrid(int n) {
  return cubes(n, n, n, [n](int x, int y, int z) {
    const auto inside = [n](int i) { return i > 0 && i < n - 1; };
    return !(inside(x) && inside(y) && inside(z));
  });
}

TestMesh ringGrid(int n) {
  return cubes(n, n, 1,
               [n](int x, int y, int) { return x == 0 || y == 0 || x == n - 1 || y == n - 1; });
}

TestMesh cubesAtEdge(int n) {
  return cubes(2 * n, 2 * n, n, [n](int x, int y, int) { return (x < n) == (y < n); });
}

TestMesh cubesAtVertex(int n) {
  return cubes(2 * n, 2 * n, 2 * n,
               [n](int x, int y, int z) { return (x < n) == (y < n) && (y < n) == (z < n); });
}

TestMesh apart(int n) {
  return cubes(2 * n + 1, n, n, [n](int x, int, int) { return x != n; });
}

TestMesh oneCell() {
  return makeMesh(ScalarType::kFloat64, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 3});
}

void addPositionField(TestMesh& mesh, const Column& column,
                      const std::function<double(double, double, double)>& f) {
  mesh.addField(column, [&](size_t v, int component) {
    return (component + 1) * f(mesh.position(v, 0), mesh.position(v, 1), mesh.position(v, 2));
  });
}

}  // namespace tetstream::test
