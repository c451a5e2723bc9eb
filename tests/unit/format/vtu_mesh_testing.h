// Shared by the tests of formats that are read as a VtuMesh: sentences, notes, a file's text.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "vtu_read.h"

namespace tetstream::test {

// Of many files: two tetrahedra that share a face.
inline const std::vector<int64_t> kTwoCells = {0, 1, 2, 3, 1, 2, 3, 4};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline bool hasNote(const VtuMesh& mesh, const std::string& text) {
  return std::any_of(mesh.notes.begin(), mesh.notes.end(),
                     [&](const std::string& note) { return has(note, text); });
}

// The labels of faces by their corners, ascending.
using LabelsOfFaces = std::map<std::vector<int64_t>, int64_t>;
inline LabelsOfFaces labelsOfFaces(const VtuMesh& mesh) {
  LabelsOfFaces labels;
  for (size_t i = 0; i < mesh.face_labels.size(); ++i) {
    std::vector<int64_t> corners(&mesh.faces[3 * i], &mesh.faces[3 * i] + 3);
    std::sort(corners.begin(), corners.end());
    labels[corners] = mesh.face_labels[i];
  }
  return labels;
}

// A text with `to` in place of the first `from`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  return at == std::string::npos ? "not found: " + from : text.replace(at, from.size(), to);
}

}  // namespace tetstream::test
