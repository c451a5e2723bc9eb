#include "side_faces.h"

#include <algorithm>
#include <cstring>

namespace tetstream {

constexpr size_t kBuckets = 32;  // of two million faces each has 4 MB

SideFaces::SideFaces(const std::string& temp_dir)
    : rows_(kBuckets, temp_dir), kept_(sizeof(Kept), temp_dir, {4, 32 << 10}) {}

void SideFaces::add(const int64_t corners[3], int64_t label) {
  const FaceKey key = faceKey(corners);
  rows_.add(bucketOf(key, kBuckets), {key, added_++, {corners[0], corners[1], corners[2]}, label});
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
