// format/medit: the fields of a MEDIT solution, beside a mesh or within it. Depends on
// medit_scan.h, mesh_intake.h.
#pragma once

#include "medit_scan.h"
#include "mesh_intake.h"

namespace tetstream {

// How many rows of a mesh solutions have to have, and where those of its tetrahedra went.
struct MeditRows {
  uint64_t points = 0, tetrahedra = 0;
  uint64_t first_tetrahedron = 0;  // rank
};

// Fields and cell data, which the format gives no names: they are numbered.
class MeditSolutions {
 public:
  // A section SolAtVertices or SolAtTetrahedra, after its keyword.
  void read(MeditScan& scan, MeshIntake& intake, const MeditRows& rows, bool of_cells);
  // All of them in a file of their own; other sections are left out.
  void readFile(MeditScan& scan, MeshIntake& intake, const MeditRows& rows);

 private:
  size_t fields_ = 0, cell_data_ = 0;  // so far
};

// Of the components of a symmetric matrix, xx, yy, zz, xy, yz and xz as elsewhere, each one's place
// in the file: xx, xy, yy, xz, yz, zz.
constexpr int kMeditSymmetric[6] = {0, 2, 5, 1, 4, 3};

constexpr const char* kMeditReference = "medit:ref";  // labels, as others call them, too

// PATH.sol or PATH.solb for PATH.mesh, PATH.solb or PATH.sol for PATH.meshb; null: neither is
// there.
std::unique_ptr<ByteSource> openMeditSolution(const std::string& mesh_path);
bool exists(const std::string& path);
// Whatever PATH ends with, another ending.
std::string withExtension(const std::string& path, const char* extension);

}  // namespace tetstream
