#include "side_faces.h"

#include <algorithm>
#include <cstring>

#include "mix.h"

namespace tetstream {

constexpr size_t kBuckets = 32;  // of two million faces each has 4 MB

SideFaces::SideFaces(const std::string& temp_dir)
    : rows_(kBuckets, temp_dir), kept_(sizeof(Kept), temp_dir, {4, 32 << 10}) {}

void SideFaces::add(const int64_t corners[3], int64_t label) {
  Row row = {{}, added_++, {}, label};
  std::copy_n(corners, 3, row.corners.begin());
  row.key = row.corners;
  std::sort(row.key.begin(), row.key.end());
  const uint64_t hash =
      mix(static_cast<uint64_t>(row.key[0]) ^
          mix(static_cast<uint64_t>(row.key[1]) ^ mix(static_cast<uint64_t>(row.key[2]))));
  rows_.add(static_cast<size_t>(hash % kBuckets), row);
}

uint64_t SideFaces::finish() {
  Account account;
  for (size_t bucket = 0; bucket < rows_.count(); ++bucket) {
    const Array<Row> rows = rows_.take(bucket, account);
    for (size_t i = 0; i < rows.size(); ++i) {
      if (i > 0 && rows[i].key == rows[i - 1].key) continue;
      Kept kept = {{}, rows[i].label};
      std::copy_n(rows[i].corners.begin(), 3, kept.corners);
      kept_.append(&kept, 1);
    }
  }
  kept_.finish();
  return added_ - kept_.rows();
}

void SideFaces::read(uint64_t first, size_t count, int64_t* corners, int64_t* labels) {
  for (size_t i = 0; i < count; ++i) {
    Kept kept;
    std::memcpy(&kept, kept_.row(first + i), sizeof kept);
    std::copy_n(kept.corners, 3, corners + 3 * i);
    labels[i] = kept.label;
  }
}

}  // namespace tetstream
