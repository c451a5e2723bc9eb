// tests/support: domains made of unit cubes, six cells each: as simple or as nasty as a test needs.
#pragma once

#include <functional>

#include "test_mesh.h"

namespace tetstream::test {

using Keep = std::function<bool(int x, int y, int z)>;

// The cubes of an nx x ny x nz lattice for which keep says so, in lexicographic order, cells with
// positive volume, vertices in the order of their first use. `jitter` moves each vertex by up to
// that much along each axis; 0.1 turns no cell over.
TestMesh cubes(int nx, int ny, int nz, const Keep& keep, double jitter = 0,
               ScalarType type = ScalarType::kFloat64);
TestMesh fullGrid(int nx, int ny, int nz, double jitter = 0,
                  ScalarType type = ScalarType::kFloat64);

// A cube of n^3 with a crack: inside a square of the middle plane the cells on both sides have
// their own vertices, at the same places. n even, at least 4.
TestMesh slitGrid(int n);
TestMesh shellGrid(int n);  // a void of (n - 2)^3 inside
TestMesh ringGrid(int n);   // n x n x 1 cubes without the middle (n - 2)^2
// Two n^3 cubes that share nothing but an edge, or nothing but a vertex.
TestMesh cubesAtEdge(int n);
TestMesh cubesAtVertex(int n);
TestMesh apart(int n);  // two n^3 cubes with a gap between

// One cell, the corner of the unit cube.
TestMesh oneCell();

// f(position) as a field.
void addPositionField(TestMesh& mesh, const Column& column,
                      const std::function<double(double, double, double)>& f);

}  // namespace tetstream::test
