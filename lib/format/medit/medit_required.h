// format/medit: edges and triangles that are required: their vertices are locked. Depends on
// medit_scan.h, gather.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "medit_scan.h"
#include "mesh_intake.h"
#include "row_spool.h"

namespace tetstream {

// They are told by their numbers in the sections of all edges and of all triangles, which come
// before; where there are several, numbers go on from one to the next.
class MeditRequired {
 public:
  explicit MeditRequired(const std::string& temp_dir)
      : edges_(sizeof(Edge), temp_dir, kSpooledInSequence) {}

  // By its ends, as the file numbers them.
  void addEdge(int64_t a, int64_t b) {
    const Edge edge = {a, b};
    edges_.append(&edge, 1);
  }
  // Faces of the intake, from that one on.
  void addTriangles(uint64_t first_face, uint64_t count) {
    triangles_.push_back({first_face, count});
    triangle_count_ += count;
  }
  void readEdges(MeditScan& scan, MeshIntake& intake) {
    readNumbers(scan, intake, "edges", edges_.rows(), required_edges_);
  }
  void readTriangles(MeditScan& scan, MeshIntake& intake) {
    readNumbers(scan, intake, "triangles", triangle_count_, required_triangles_);
  }
  // Once all vertices and triangles have come; throws kBadData for one that is no vertex.
  void lock(const FileScan& file, MeshIntake& intake);

 private:
  using Edge = std::array<int64_t, 2>;
  struct Section {
    uint64_t first_face, count;
  };
  static void readNumbers(MeditScan& scan, MeshIntake& intake, const std::string& things,
                          uint64_t count, std::vector<bool>& required);
  template <class LockVertex>
  void lockEdges(LockVertex lockVertex);
  template <class LockVertex>
  void lockTriangles(MeshSpool& mesh, LockVertex lockVertex);

  RowSpool edges_;
  std::vector<Section> triangles_;
  uint64_t triangle_count_ = 0;
  std::vector<bool> required_edges_, required_triangles_;  // of those that had come
};

}  // namespace tetstream
