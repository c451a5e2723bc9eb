#include "medit_required.h"

#include "status.h"

namespace tetstream {

void MeditRequired::readNumbers(MeditScan& scan, MeshIntake& intake, const std::string& things,
                                uint64_t count, std::vector<uint64_t>& numbers) {
  const std::string what = "required " + things;
  const uint64_t rows = scan.rows(1, 0, what.c_str());
  if (count == 0 && rows > 0)
    intake.leaveOut(what + ", before which no " + things + " come,", rows);
  for (uint64_t i = 0; i < rows; ++i) {
    int64_t number;
    scan.integers(&number, 1, what.c_str());
    if (count == 0) continue;
    if (number < 1 || static_cast<uint64_t>(number) > count)
      scan.file().failBad(textOf("number %lld of %s, where there are 1 to %llu",
                                 static_cast<long long>(number), things.c_str(),
                                 static_cast<unsigned long long>(count)));
    numbers.push_back(static_cast<uint64_t>(number - 1));
  }
}

void MeditRequired::lock(const FileScan& file, MeshSpool& mesh) const {
  const auto lockPoint = [&](int64_t point) {
    if (point < 0 || static_cast<uint64_t>(point) >= mesh.pointCount())
      file.failBad(textOf("a required edge or triangle has vertex %lld, where there are 1 to %llu",
                          static_cast<long long>(point + 1),
                          static_cast<unsigned long long>(mesh.pointCount())));
    mesh.lock(static_cast<uint64_t>(point));
  };
  for (const uint64_t edge : required_edges_)
    for (const int64_t end : edges_[edge]) lockPoint(end);
  if (required_triangles_.empty()) return;
  mesh.finishFaces();
  for (const uint64_t triangle : required_triangles_) {
    int64_t corners[3], label;
    mesh.readFaces(first_face_ + triangle, 1, corners, &label);
    for (const int64_t corner : corners) lockPoint(corner);
  }
}

}  // namespace tetstream
