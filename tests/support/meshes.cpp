#include "meshes.h"

namespace tetstream::test {

Schema SmallMesh::schema() const {
  Schema s;
  s.position_type = ScalarType::kFloat64;
  s.fields = {{"f", 1, ScalarType::kFloat64}};
  s.vertex_count = static_cast<int64_t>(vertexCount());
  s.cell_count = static_cast<int64_t>(cellCount());
  return s;
}

BatchView SmallMesh::view() {
  fields_[0] = field.data();
  BatchView v;
  v.vertex_count = vertexCount();
  v.positions = positions.data();
  v.fields = fields_;
  v.cell_count = cellCount();
  v.cells = cells.data();
  return v;
}

SmallMesh gridMesh(int nx, int ny, int nz) {
  SmallMesh m;
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) {
        m.positions.insert(m.positions.end(), {double(x), double(y), double(z)});
        m.field.push_back(x + 2.0 * y + 3.0 * z);
      }
  // Kuhn's split: the six monotone paths from corner 0 to corner 7 of a cube (bits: x, y, z).
  static const int paths[6][4] = {{0, 1, 3, 7}, {0, 1, 7, 5}, {0, 2, 7, 3},
                                  {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 7, 6}};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (const auto& path : paths)
          for (int corner : path)
            m.cells.push_back((x + (corner & 1)) +
                              (nx + 1) * ((y + (corner >> 1 & 1)) +
                                          static_cast<int64_t>(ny + 1) * (z + (corner >> 2))));
  return m;
}

}  // namespace tetstream::test
