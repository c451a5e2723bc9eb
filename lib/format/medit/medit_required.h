// format/medit: edges and triangles that are required: their vertices are locked. Depends on
// medit_scan.h, gather.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "medit_scan.h"
#include "mesh_intake.h"

namespace tetstream {

// They are told by their numbers in the sections of all edges and of all triangles, which come
// before.
class MeditRequired {
 public:
  // By its ends' ranks. All are kept: mostly there are but ridges.
  void addEdge(int64_t a, int64_t b) { edges_.push_back({a, b}); }
  // Faces of the intake, from that one on.
  void setTriangles(uint64_t first_face, uint64_t count) {
    first_face_ = first_face;
    triangle_count_ = count;
  }
  void readEdges(MeditScan& scan, MeshIntake& intake) {
    readNumbers(scan, intake, "edges", edges_.size(), required_edges_);
  }
  void readTriangles(MeditScan& scan, MeshIntake& intake) {
    readNumbers(scan, intake, "triangles", triangle_count_, required_triangles_);
  }
  // Once all vertices and triangles have come; throws kBadData for one that is no vertex.
  void lock(const FileScan& file, MeshSpool& mesh) const;

 private:
  static void readNumbers(MeditScan& scan, MeshIntake& intake, const std::string& things,
                          uint64_t count, std::vector<uint64_t>& numbers);

  std::vector<std::array<int64_t, 2>> edges_;
  uint64_t first_face_ = 0, triangle_count_ = 0;
  std::vector<uint64_t> required_edges_, required_triangles_;  // from 0
};

}  // namespace tetstream
