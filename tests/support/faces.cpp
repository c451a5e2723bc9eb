#include "faces.h"

#include <algorithm>
#include <cmath>

namespace tetstream::test {

std::map<Face, int> facesOf(const std::vector<int64_t>& cells) {
  std::map<Face, int> faces;
  for (size_t c = 0; c < cells.size() / 4; ++c)
    for (size_t j = 0; j < 4; ++j) {
      Face f;
      for (size_t k = 0; k < 3; ++k) f[k] = cells[4 * c + (j + 1 + k) % 4];
      std::sort(f.begin(), f.end());
      ++faces[f];
    }
  return faces;
}

int64_t sideOf(const TestMesh& mesh, const Face& face, const int (&n)[3], double tolerance) {
  for (int i = 0; i < 3; ++i)
    for (int high = 0; high < 2; ++high) {
      int on = 0;
      for (int64_t v : face)
        on += std::fabs(mesh.position(static_cast<size_t>(v), i) - (high ? n[i] : 0)) <= tolerance;
      if (on == 3) return 2 * i + 1 + high;
    }
  return 0;
}

FaceLabels sidesOf(const TestMesh& mesh, const int (&n)[3]) {
  FaceLabels labels;
  for (const auto& [face, cells] : facesOf(mesh.cells))
    if (cells == 1) labels[face] = sideOf(mesh, face, n);
  return labels;
}

FacedMesh::FacedMesh(TestMesh the_mesh, const FaceLabels& of_faces) : mesh(std::move(the_mesh)) {
  for (const auto& [face, label] : of_faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    labels.push_back(label);
  }
}

BatchView FacedMesh::view() {
  BatchView batch = mesh.view();
  batch.face_count = labels.size();
  batch.faces = corners.data();
  batch.face_labels = labels.data();
  batch.face_locks = locks.empty() ? nullptr : locks.data();
  return batch;
}

bool FacedStream::next(BatchView& batch) {
  if (!stream_.next(batch)) return false;
  corners_.clear();
  values_.clear();
  const std::vector<int64_t> cells(batch.cells, batch.cells + 4 * batch.cell_count);
  for (const auto& [face, count] : facesOf(cells)) {
    const auto found = labels_.find(face);
    if (found == labels_.end()) continue;
    corners_.insert(corners_.end(), face.begin(), face.end());
    values_.push_back(found->second);
    labels_.erase(found);
  }
  batch.face_count = values_.size();
  batch.faces = corners_.data();
  batch.face_labels = values_.data();
  return true;
}

}  // namespace tetstream::test
