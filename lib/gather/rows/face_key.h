// gather/rows: a face by its corners, whatever their order. Depends on mix.h.
#pragma once

#include <algorithm>
#include <array>

#include "mix.h"

namespace tetstream {

using FaceKey = std::array<int64_t, 3>;  // the corners, ascending

inline FaceKey faceKey(const int64_t corners[3]) {
  FaceKey key = {corners[0], corners[1], corners[2]};
  std::sort(key.begin(), key.end());
  return key;
}

// Of so many buckets, the one of all faces with these corners.
inline size_t bucketOf(const FaceKey& key, size_t buckets) {
  const uint64_t hash =
      mix(static_cast<uint64_t>(key[0]) ^
          mix(static_cast<uint64_t>(key[1]) ^ mix(static_cast<uint64_t>(key[2]))));
  return static_cast<size_t>(hash % buckets);
}

}  // namespace tetstream
