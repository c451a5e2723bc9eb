// What the fuzz targets share: how a promise that was broken is told, and a writer that looks at
// every event of what it is given.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tetstream/tetstream.h"

// A broken promise ends the process, as libFuzzer and the driver want it.
#define PROMISE(condition, ...)                                    \
  do {                                                             \
    if (!(condition)) {                                            \
      std::fprintf(stderr, "%s:%d: not so: ", __FILE__, __LINE__); \
      std::fprintf(stderr, __VA_ARGS__);                           \
      std::fputc('\n', stderr);                                    \
      std::abort();                                                \
    }                                                              \
  } while (false)

namespace fuzz {

// A failure has a sentence and is none of the library's own defects.
inline void checkFailure(tetstream_status status, const char* message) {
  if (status >= 0) return;
  PROMISE(message && *message, "%s without a sentence", tetstream_status_name(status));
  PROMISE(status != TETSTREAM_INTERNAL, "%s", message);
}

// Takes a stream as a writer's callbacks do, and checks what tetstream.h promises of batches.
class EventChecker {
 public:
  // Stops the run after so many cells: what is compressed well may be long.
  static constexpr int64_t kMostCells = 1 << 18;

  tetstream_writer_callbacks callbacks() {
    return {sizeof(tetstream_writer_callbacks), this, open, put, nullptr, nullptr};
  }
  int64_t vertices() const { return static_cast<int64_t>(state_.size()); }
  int64_t cells() const { return cells_; }

 private:
  enum : unsigned char { kActive, kFinalized };

  static int32_t open(void* user, const tetstream_stream_info* info) {
    auto& self = *static_cast<EventChecker*>(user);
    self.fields_ = info->field_count;
    self.cell_arrays_ = info->cell_data_count;
    return 0;
  }
  static int32_t put(void* user, const tetstream_batch* batch) {
    return static_cast<EventChecker*>(user)->take(*batch);
  }

  int32_t take(const tetstream_batch& b) {
    PROMISE(b.vertex_count >= 0 && b.cell_count >= 0 && b.finalized_count >= 0, "negative counts");
    PROMISE(b.vertex_count == 0 || b.positions, "vertices without positions");
    for (int32_t i = 0; b.vertex_count > 0 && i < fields_; ++i)
      PROMISE(b.fields[i], "vertices without field %d", i);
    for (int32_t i = 0; b.cell_count > 0 && i < cell_arrays_; ++i)
      PROMISE(b.cell_data[i], "cells without array %d", i);
    state_.resize(state_.size() + static_cast<size_t>(b.vertex_count), kActive);
    for (int64_t c = 0; c < b.cell_count; ++c) takeCell(b, c);
    for (int64_t i = 0; i < b.finalized_count; ++i) finalize(b.finalized[i]);
    for (int64_t i = 0; i < 3 * b.face_count; ++i) checkKnown(b.faces[i], "a face");
    return cells_ > kMostCells;
  }

  void takeCell(const tetstream_batch& b, int64_t c) {
    const int64_t* corners = b.cells + 4 * c;
    for (int j = 0; j < 4; ++j) {
      checkKnown(corners[j], "a cell");
      PROMISE(state_[static_cast<size_t>(corners[j])] == kActive,
              "cell %lld uses vertex %lld, which was finalized", static_cast<long long>(cells_),
              static_cast<long long>(corners[j]));
    }
    const int uses = b.last_uses ? b.last_uses[c] : 0;
    PROMISE(uses < 16, "last uses 0x%02x", static_cast<unsigned>(uses));
    for (int j = 0; j < 4; ++j)
      if (uses >> j & 1) state_[static_cast<size_t>(corners[j])] = kFinalized;
    ++cells_;
  }

  void finalize(int64_t vertex) {
    checkKnown(vertex, "a finalization");
    state_[static_cast<size_t>(vertex)] = kFinalized;
  }

  void checkKnown(int64_t vertex, const char* what) const {
    PROMISE(vertex >= 0 && vertex < vertices(), "%s names vertex %lld of %lld", what,
            static_cast<long long>(vertex), static_cast<long long>(vertices()));
  }

  std::vector<unsigned char> state_;
  int64_t cells_ = 0;
  int32_t fields_ = 0, cell_arrays_ = 0;
};

}  // namespace fuzz
