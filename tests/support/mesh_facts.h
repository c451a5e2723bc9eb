// tests/support: an independent look at a mesh: what its topology is and whether it is a valid one.
// Everything by brute force over simplices; nothing of the library's mesh room is used.
#pragma once

#include <array>
#include <string>

#include "test_mesh.h"

namespace tetstream::test {

struct MeshFacts {
  // Of the cells, and of the boundary: the faces of one cell.
  int64_t cells = 0, euler = 0, components = 0;
  int64_t boundary_faces = 0, boundary_euler = 0, boundary_components = 0;
  // What a manifold with boundary does not have.
  int64_t crowded_faces = 0;     // of more than two cells
  int64_t crowded_edges = 0;     // boundary edges that are not between two boundary faces
  int64_t pinched_vertices = 0;  // whose boundary faces are more than one fan, or whose cells are
                                 // not connected by faces
  int64_t duplicates = 0;        // cells with the same four vertices as another
  int64_t flat = 0;              // of volume zero, exactly
  int64_t folded = 0;            // faces whose two cells are on the same side, exactly
  int64_t positive = 0, negative = 0;
  double volume = 0;

  bool manifold() const { return crowded_faces + crowded_edges + pinched_vertices == 0; }
};

MeshFacts factsOf(const TestMesh& mesh);

// "" if both have the same topology and `after` no more of what is not valid than `before`, else
// what differs.
std::string topologyChange(const MeshFacts& before, const MeshFacts& after);

// The exact sign of a cell's volume, by arithmetic of its own.
int cellSign(const TestMesh& mesh, size_t cell);
double cellVolume(const TestMesh& mesh, size_t cell);

}  // namespace tetstream::test
