// stream: whether integers are ids and no labels. Depends on base.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace tetstream {

// A label is one of many cells, or it tells nothing of the domain: ids are those of single cells,
// or of what these were cut from, six out of a hexahedron. Faces with a label may be few.
constexpr uint32_t kFewestCellsOfALabel = 8;
constexpr uint32_t kFewestFacesOfALabel = 2;

// Takes all rows of an array, or those of a connected part of the mesh. Some labels are looked at,
// each with all its rows, so that memory does not grow with the rows.
class IdCensus {
 public:
  explicit IdCensus(uint64_t rows, uint32_t fewest = kFewestCellsOfALabel)
      : rows_(rows), one_in_(rows / kLabelsThatTell + 1), fewest_(fewest) {}
  void add(const int64_t* row, int components);
  // Whether most rows have labels of fewer rows than that. Sixteen labels are no ids, however few
  // rows there are.
  bool areIds() const;

 private:
  static constexpr uint64_t kLabelsThatTell = 4096;
  static constexpr size_t kNeverIds = 16;
  uint64_t rows_, one_in_;
  uint32_t fewest_;
  std::unordered_map<uint64_t, uint32_t> rows_of_;  // a label, as its components mixed
};

}  // namespace tetstream
