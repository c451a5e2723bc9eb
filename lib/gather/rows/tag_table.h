// gather/rows: where the points and cells of a file went that numbers them at will. Depends on
// row_spool.h.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "row_spool.h"

namespace tetstream {

constexpr int64_t kMostTag = INT64_MAX / 2;  // of a cell or a point

// Ranks of tags. Most files count on, so what is kept are runs of tags whose ranks follow each
// other; when they are many, they are sorted in a temporary file. Memory does not grow with them,
// but for a number per 256 runs.
class TagTable {
 public:
  explicit TagTable(const std::string& temp_dir) : temp_dir_(temp_dir) {}

  // The tag's ranks are [first, first + count), count possibly 0.
  void add(int64_t tag, int64_t first, int64_t count = 1);
  // As many tags that follow each other, with a rank each.
  void addRun(int64_t tag, int64_t first, int64_t tags);
  // Before the first look, and before the next one if more tags came. Returns a tag that was added
  // twice in *twice, or true.
  bool finish(int64_t* twice);
  // Of tags that follow each other, with ranks that do. After finish.
  uint64_t runs() const { return spool_ ? spool_->rows() : runs_.size(); }

  // False: there is no such tag. Looks near each other are the fast ones.
  bool find(int64_t tag, int64_t* first, int64_t* count);
  bool find(int64_t tag, int64_t* rank) {
    if (tag >= last_.tag && tag - last_.tag < last_.tags) {
      *rank = last_.first + (tag - last_.tag) * last_.step;
      return true;
    }
    int64_t count;
    return find(tag, rank, &count);
  }
  // If all tags are of one run, with a rank each: those are [tag, tag + tags), the ranks begin at
  // `first`.
  bool isOneRun(int64_t* tag, int64_t* tags, int64_t* first) const;

 private:
  struct Run {
    int64_t tag = 0, first = 0, tags = 0, step = 0;  // ranks per tag
  };
  void addRun(const Run& more);
  void spill();
  void merge();
  void reopen();
  Run runAt(uint64_t index);
  uint64_t lastNotAbove(int64_t tag);

  std::string temp_dir_;
  std::vector<Run> runs_;
  bool is_finished_ = false;
  std::unique_ptr<SpoolFile> chunks_;  // sorted, each up to one of
  std::vector<uint64_t> chunk_ends_;   // in bytes
  std::unique_ptr<RowSpool> spool_;    // all runs, sorted
  std::vector<int64_t> samples_;       // the tag of every kSampledRuns-th run in it
  uint64_t at_ = 0;                    // of the run last found
  Run last_;
};

}  // namespace tetstream
