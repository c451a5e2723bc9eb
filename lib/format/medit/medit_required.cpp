#include "medit_required.h"

#include "status.h"

namespace tetstream {

void MeditRequired::readNumbers(MeditScan& scan, MeshIntake& intake, const std::string& things,
                                uint64_t count, std::vector<bool>& required) {
  const std::string what = "required " + things;
  const uint64_t rows = scan.rows(1, 0, what.c_str());
  if (count == 0 && rows > 0)
    intake.leaveOut(what + ", before which no " + things + " come,", rows);
  if (rows > 0) required.resize(static_cast<size_t>(count));
  for (uint64_t i = 0; i < rows; ++i) {
    int64_t number;
    scan.integers(&number, 1, what.c_str());
    if (count == 0) continue;
    if (number < 1 || static_cast<uint64_t>(number) > count)
      scan.file().failBad(textOf("number %lld of %s, where there are 1 to %llu",
                                 static_cast<long long>(number), what.c_str(),
                                 static_cast<unsigned long long>(count)));
    required[static_cast<size_t>(number - 1)] = true;
  }
}

void MeditRequired::lock(const FileScan& file, MeshIntake& intake) {
  MeshSpool& mesh = intake.mesh();
  const auto lockVertex = [&](int64_t vertex) {
    if (vertex < 1 || static_cast<uint64_t>(vertex) > mesh.pointCount())
      file.failBad(textOf("a required edge or triangle has vertex %lld, where there are 1 to %llu",
                          static_cast<long long>(vertex),
                          static_cast<unsigned long long>(mesh.pointCount())));
    mesh.lock(static_cast<uint64_t>(vertex - 1));
  };
  if (edges_.rows() > 0)
    intake.note(required_edges_.empty() ? "the section Edges is left out"
                                        : "edges are left out but for the locks of required ones");
  lockEdges(lockVertex);
  lockTriangles(mesh, lockVertex);
}

template <class LockVertex>
void MeditRequired::lockEdges(LockVertex lockVertex) {
  edges_.finish();
  for (size_t i = 0; i < required_edges_.size(); ++i) {
    if (!required_edges_[i]) continue;
    const Edge edge = *static_cast<const Edge*>(edges_.row(i));
    for (const int64_t end : edge) lockVertex(end);
  }
}

template <class LockVertex>
void MeditRequired::lockTriangles(MeshSpool& mesh, LockVertex lockVertex) {
  if (required_triangles_.empty()) return;
  mesh.finishFaces();
  size_t number = 0;
  for (const Section& section : triangles_)
    for (uint64_t i = 0; i < section.count && number < required_triangles_.size(); ++i, ++number) {
      if (!required_triangles_[number]) continue;
      int64_t corners[3], label;
      mesh.readFaces(section.first_face + i, 1, corners, &label);
      for (const int64_t corner : corners) lockVertex(corner + 1);
    }
}

}  // namespace tetstream
