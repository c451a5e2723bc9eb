#include "msh_mesh.h"

#include <algorithm>
#include <cstdlib>

#include "status.h"

namespace tetstream {

std::string notThere(int64_t element, int64_t node) {
  return "element " + std::to_string(element) + " uses node " + std::to_string(node) +
         ", which is not there";
}

void MshMesh::beginNodes() {
  if (intake) file.failBad("a second section of nodes");  // of another kind
  intake = std::make_unique<MeshIntake>(file, options, hints.position_type);
  const auto addLabels = [this](const std::string& name) {
    if (name.empty()) return;
    const auto type = hints.cell_data.find(name);
    intake->addLabels(name.c_str(),
                      type != hints.cell_data.end() && type->second == ScalarType::kInt64,
                      hints.labels_named);
  };
  addLabels(hints.physical);
  if (hints.entity != hints.physical) addLabels(hints.entity);
}

void MshMesh::endNodes() {
  int64_t twice;
  if (!points->finish(&twice)) file.failBad("node " + std::to_string(twice) + " is there twice");
}

void MshMesh::finishCells() {
  addPlacedTags();
  int64_t twice;
  if (!cells.finish(&twice)) file.failBad("element " + std::to_string(twice) + " is there twice");
}

void MshMesh::checkTag(int64_t tag) const {
  if (tag < 0 || tag > kMostTag) file.failBad(std::to_string(tag) + " is no tag");
}

// In version 2, an element of an entity that is in several groups is there once for each, one right
// after the other, with a number of its own. Those of a negative group are the other way round.
bool MshMesh::isLastInAnotherGroup(CellShape shape, const int64_t* corners, int64_t group,
                                   int64_t entity) const {
  return shape == last_.shape && entity == last_.entity && group != last_.group &&
         std::is_permutation(corners, corners + cornersOf(shape), last_.corners);
}

void MshMesh::addFace(CellKind kind, const int64_t* corners, int64_t group, int64_t entity) {
  constexpr const char* kWithoutLabel = "triangles without a label";
  if (group != 0 && face_labels == FaceLabels::kEntities) {
    intake->leaveOutFaces(kWithoutLabel);
    face_labels = FaceLabels::kGroups;
  }
  const int64_t label = face_labels == FaceLabels::kGroups ? group : entity;
  if (label == 0) return intake->leaveOut(kWithoutLabel);
  intake->addFace(kind, corners, label);
}

void MshMesh::addCell(CellKind kind, const int64_t* nodes, int64_t tag, int64_t group,
                      int64_t entity) {
  const int dimension = dimensionOf(kind.shape);
  if (dimension < 2) return intake->leaveOut(dimension == 0 ? "elements of one point" : "lines");
  int64_t corners[kMostCorners];
  for (int k = 0; k < cornersOf(kind.shape); ++k)
    if (!points->find(nodes[k], &corners[k])) file.failBad(notThere(tag, nodes[k]));
  if (isLastInAnotherGroup(kind.shape, corners, group, entity)) {
    intake->leaveOut("elements that are there once more, in another physical group,");
    further_groups.emplace(dimension, std::abs(std::max(group, -INT64_MAX)));
    if (dimension == 3) cells.add(tag, last_.first, last_.count);
    return;
  }
  last_ = {kind.shape, {}, group, entity, 0, 0};
  std::copy(corners, corners + cornersOf(kind.shape), last_.corners);
  if (dimension == 2) return addFace(kind, corners, group, entity);
  const int64_t both[] = {group, entity};
  const int64_t* labels = hints.physical.empty() ? both + 1 : both;
  last_.first = static_cast<int64_t>(intake->cellCount());
  last_.count = static_cast<int64_t>(intake->addCell(kind, corners, labels, tag));
  cells.add(tag, last_.first, last_.count);
}

}  // namespace tetstream
