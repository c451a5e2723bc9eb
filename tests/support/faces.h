// tests/support: faces of cells with labels, and streams that bring them.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "test_mesh.h"

namespace tetstream::test {

// Every face, and the number of cells that have it.
std::map<Face, int> facesOf(const std::vector<int64_t>& cells);

using FaceLabels = std::map<Face, int64_t>;

// The sides of a full grid of n[0] x n[1] x n[2] cubes: 1 to 6; 0 for a face that lies in none.
int64_t sideOf(const TestMesh& mesh, const Face& face, const int (&n)[3], double tolerance = 0);
FaceLabels sidesOf(const TestMesh& mesh, const int (&n)[3]);

// An indexed mesh with such faces as one batch, which refers to both.
struct FacedMesh {
  FacedMesh(TestMesh the_mesh, const FaceLabels& labels);
  TestMesh mesh;
  std::vector<int64_t> corners, labels;
  std::vector<uint8_t> locks;  // empty: none
  BatchView view();
};

// Each batch of a stream with the labelled faces of its cells.
class FacedStream final : public Source {
 public:
  FacedStream(const TestMesh& mesh, const Cut& cut, FaceLabels labels)
      : stream_(mesh, cut), labels_(std::move(labels)) {}
  const Schema& schema() const override { return stream_.schema(); }
  bool next(BatchView& batch) override;

 private:
  MeshStream stream_;
  FaceLabels labels_;
  std::vector<int64_t> corners_, values_;
};

}  // namespace tetstream::test
