#include "scattered.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "mix.h"

namespace tetstream {
namespace {

constexpr uint32_t kCellsThatTell = 2048;
constexpr size_t kPairsThatTell = 256;
// Of two cells by chance, and of neighbours beside that. Cells that are marked one here and one
// there differ in less.
constexpr double kLeastByChance = 0.25, kAsByChance = 0.8;

struct Face {
  std::array<uint32_t, 3> corners;
  uint32_t cell;
  bool operator<(const Face& other) const {
    return corners != other.corners ? corners < other.corners : cell < other.cell;
  }
};

uint64_t labelOf(const CellLabels& labels, uint32_t cell) {
  uint64_t label = 1;
  for (int i = 0; i < labels.count; ++i)
    label = mix(label + static_cast<uint64_t>(labels.rowOf(cell)[labels.columns[i]])) + 1;
  return label;
}

}  // namespace

std::vector<CellPair> someNeighbours(const Topology& mesh) {
  const uint32_t one_in = mesh.cellEnd() / kCellsThatTell + 1;
  std::vector<Face> faces;
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c)
    for (size_t j = 0; j < 4; ++j) {
      const uint32_t* t = mesh.corners(c);
      Face face = {{t[(j + 1) % 4], t[(j + 2) % 4], t[(j + 3) % 4]}, c};
      const uint32_t least = *std::min_element(face.corners.begin(), face.corners.end());
      if (mix(least + 1) % one_in != 0) continue;
      std::sort(face.corners.begin(), face.corners.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  std::vector<CellPair> pairs;
  for (size_t i = 1; i < faces.size(); ++i)
    if (faces[i - 1].corners == faces[i].corners)
      pairs.emplace_back(faces[i - 1].cell, faces[i].cell);
  return pairs;
}

bool areScattered(const CellLabels& labels, const std::vector<CellPair>& neighbours) {
  if (neighbours.size() < kPairsThatTell) return false;
  std::unordered_map<uint64_t, double> shares;
  const double one = 0.5 / static_cast<double>(neighbours.size());
  double differ = 0, alike_by_chance = 0;
  for (const auto& [a, b] : neighbours) {
    differ += labels.differ(a, b) ? 2 * one : 0;
    shares[labelOf(labels, a)] += one;
    shares[labelOf(labels, b)] += one;
  }
  for (const auto& [label, share] : shares) alike_by_chance += share * share;
  const double by_chance = 1 - alike_by_chance;
  return by_chance >= kLeastByChance && differ >= kAsByChance * by_chance;
}

}  // namespace tetstream
