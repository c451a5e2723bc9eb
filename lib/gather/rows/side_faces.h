// gather/rows: faces with labels that a file names apart from its cells, each kept once. Depends on
// buckets.h, face_key.h, row_spool.h.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "buckets.h"
#include "face_key.h"
#include "row_spool.h"

namespace tetstream {

class SideFaces {
 public:
  explicit SideFaces(const std::string& temp_dir);

  void add(const int64_t corners[3], int64_t label);
  // After the last: of those with the same corners the first one stays. Returns how many were left
  // out for that.
  uint64_t finish();

  uint64_t count() const { return kept_.rows(); }
  void read(uint64_t first, size_t count, int64_t* corners, int64_t* labels);

 private:
  struct Row {
    FaceKey key;
    uint64_t rank;
    std::array<int64_t, 3> corners;
    int64_t label;
    bool operator<(const Row& other) const {
      return key != other.key ? key < other.key : rank < other.rank;
    }
  };
  struct Kept {
    int64_t corners[3], label;
  };

  Buckets<Row> rows_;
  RowSpool kept_;
  uint64_t added_ = 0;
};

}  // namespace tetstream
