// run: an input as a stream: as it is, or brought into an order. Depends on layout, run.h.
#pragma once

#include <memory>
#include <vector>

#include "ordered_source.h"
#include "run.h"

namespace tetstream {

// An indexed mesh has to be ordered; a stream is where an order is asked for, or where its front,
// as far as it is known, is wider than need be.
class Ordering {
 public:
  // Orders, which may take long; `progress` is told, with the temporary files' bytes to come.
  // `measured`: fields whose values have to be finite, which is seen to where points are ordered;
  // empty: none.
  Ordering(Input& input, const RunOptions& options, const ProgressFunction& progress,
           std::vector<bool> measured = {});

  static std::string wordsForNone(const Schema& schema);  // of a stream that stays as it is

  Source& source() const { return *source_; }
  bool isOrdered() const { return ordered_ != nullptr; }
  // As of an Input; what was ordered is in memory and in files.
  bool staysWithCaller() const { return stays_with_caller_; }
  const std::shared_ptr<Waiting>& waiting() const { return waiting_; }
  double share() const;                                  // of the time of a run
  const std::string& chosen() const { return chosen_; }  // "spatial, along z"
  int64_t unusedVertices() const { return ordered_ ? ordered_->unusedVertices() : 0; }
  uint64_t diskBytes() const;  // of temporary files at once, at most

 private:
  IndexedSource* indexedOf(Input& input, const RunOptions& options, const Tell& tell);

  std::unique_ptr<IndexedSource> spooled_;
  uint64_t spooled_bytes_ = 0;
  std::unique_ptr<OrderedSource> ordered_;
  Source* source_ = nullptr;
  bool stays_with_caller_ = false;
  std::shared_ptr<Waiting> waiting_;
  std::string chosen_;
};

}  // namespace tetstream
