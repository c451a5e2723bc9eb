// Shared by the tests of indexed text and binary formats: faces, and files that claim too much.
#pragma once

#include <string>
#include <vector>

#include "sv_testing.h"

namespace tetstream::test {

struct TestFace {
  int64_t a, b, c, label;
  bool operator==(const TestFace&) const = default;
};

inline std::vector<TestFace> facesOf(Input& input) {
  const auto count = static_cast<size_t>(std::max<int64_t>(input.schema().face_count, 0));
  std::vector<int64_t> corners(3 * count), labels(count);
  if (count > 0) input.indexed->readFaces(0, count, corners.data(), labels.data());
  std::vector<TestFace> faces;
  for (size_t i = 0; i < count; ++i)
    faces.push_back({corners[3 * i], corners[3 * i + 1], corners[3 * i + 2], labels[i]});
  return faces;
}

inline Input openText(Open open, const std::string& text, ReadOptions options = {},
                      std::vector<std::string>* notes = nullptr) {
  if (notes) options.note = [notes](const std::string& note) { notes->push_back(note); };
  // note: the bytes need not outlive the opening of a format that is read at once.
  return open(openMemory(text.data(), text.size(), "mesh"), options);
}

// The sentence of the error, or "".
inline std::string problemOf(Open open, const std::string& text, ReadOptions options = {}) {
  try {
    openText(open, text, std::move(options));
  } catch (const Error& error) {
    return error.text();
  }
  return "";
}

inline bool anyNote(const std::vector<std::string>& notes, const std::string& part) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(part) != note.npos; });
}

// A mesh with all kinds of columns, its cells using every vertex.
inline SvMesh indexedMesh(const Schema& schema, int cells) {
  SvMesh m = randomStream(schema, cells, 7);
  m.events.clear();
  for (size_t v = 0; v < m.vertexCount(); ++v) m.events.push_back({'v', static_cast<int64_t>(v)});
  for (size_t c = 0; c < m.cells.size(); ++c) m.events.push_back({'c', static_cast<int64_t>(c)});
  std::fill(m.last_uses.begin(), m.last_uses.end(), uint8_t{0});
  return m;
}

inline double volumeOf(const SvMesh& m, size_t cell) {
  double e[3][3];
  for (size_t j = 0; j < 3; ++j)
    for (size_t k = 0; k < 3; ++k)
      e[j][k] = m.positions[3 * static_cast<size_t>(m.cells[cell][j + 1]) + k] -
                m.positions[3 * static_cast<size_t>(m.cells[cell][0]) + k];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
          e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

}  // namespace tetstream::test
