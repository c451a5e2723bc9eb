#include "tag_table.h"

#include <algorithm>
#include <queue>

namespace tetstream {

namespace {

constexpr size_t kHeldRuns = 1 << 18;    // 8 MiB
constexpr size_t kSampledRuns = 1 << 8;  // one block of the spool, 8 KiB
constexpr size_t kMergeRuns = 1 << 19;   // held by all chunks together while they are merged
constexpr SpoolShape kLooked = {1024, kSampledRuns * 32};

}  // namespace

void TagTable::add(int64_t tag, int64_t first, int64_t count) {
  addRun({tag, first, 1, count});
}

void TagTable::addRun(int64_t tag, int64_t first, int64_t tags) {
  if (tags > 0) addRun({tag, first, tags, 1});
}

void TagTable::addRun(const Run& more) {
  if (is_finished_) reopen();
  if (!runs_.empty()) {
    Run& run = runs_.back();
    if (more.tag == run.tag + run.tags && more.first == run.first + run.tags * run.step &&
        more.step == run.step) {
      run.tags += more.tags;
      return;
    }
  }
  if (runs_.size() == kHeldRuns) spill();
  runs_.push_back(more);
}

void TagTable::spill() {
  if (!chunks_) chunks_ = std::make_unique<SpoolFile>(temp_dir_);
  std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.tag < b.tag; });
  chunks_->append(runs_.data(), runs_.size() * sizeof(Run));
  chunk_ends_.push_back(chunks_->size());
  runs_.clear();
}

// Tags come after looks: those that were sorted in a file are one chunk of it.
void TagTable::reopen() {
  is_finished_ = false;
  at_ = 0;
  last_ = {};
  if (!spool_) return;
  chunks_ = std::make_unique<SpoolFile>(temp_dir_);
  std::vector<Run> some(4096);
  for (uint64_t at = 0; at < spool_->rows(); at += some.size()) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(some.size(), spool_->rows() - at));
    spool_->read(at, n, some.data());
    chunks_->append(some.data(), n * sizeof(Run));
  }
  chunk_ends_.push_back(chunks_->size());
  samples_.clear();
  spool_.reset();
}

void TagTable::merge() {
  struct Chunk {
    uint64_t next, end;  // bytes of the file
    std::vector<Run> held;
    size_t at = 0;
  };
  std::vector<Chunk> chunks;
  for (uint64_t begin = 0; uint64_t end : chunk_ends_) {
    chunks.push_back({begin, end, {}, 0});
    begin = end;
  }
  const size_t rows = std::clamp<size_t>(kMergeRuns / chunks.size(), 64, 4096);
  const auto fill = [&](Chunk& chunk) {
    const uint64_t left = (chunk.end - chunk.next) / sizeof(Run);
    chunk.held.resize(static_cast<size_t>(std::min<uint64_t>(rows, left)));
    chunk.at = 0;
    chunks_->readAt(chunk.next, chunk.held.data(), chunk.held.size() * sizeof(Run));
    chunk.next += chunk.held.size() * sizeof(Run);
    return !chunk.held.empty();
  };
  const auto later = [&](size_t a, size_t b) {
    return chunks[a].held[chunks[a].at].tag > chunks[b].held[chunks[b].at].tag;
  };
  std::priority_queue<size_t, std::vector<size_t>, decltype(later)> heads(later);
  for (size_t i = 0; i < chunks.size(); ++i)
    if (fill(chunks[i])) heads.push(i);
  spool_ = std::make_unique<RowSpool>(sizeof(Run), temp_dir_, kLooked);
  while (!heads.empty()) {
    const size_t i = heads.top();
    heads.pop();
    const Run& run = chunks[i].held[chunks[i].at];
    if (spool_->rows() % kSampledRuns == 0) samples_.push_back(run.tag);
    spool_->append(&run, 1);
    if (++chunks[i].at < chunks[i].held.size() || fill(chunks[i])) heads.push(i);
  }
  spool_->finish();
  chunks_.reset();
  chunk_ends_.clear();
}

TagTable::Run TagTable::runAt(uint64_t index) {
  return spool_ ? *static_cast<const Run*>(spool_->row(index)) : runs_[static_cast<size_t>(index)];
}

bool TagTable::finish(int64_t* twice) {
  if (is_finished_) return true;
  if (chunks_) {
    spill();
    merge();
    runs_ = {};
  } else {
    std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.tag < b.tag; });
  }
  for (uint64_t i = 1; i < runs(); ++i) {
    const Run before = runAt(i - 1);
    *twice = runAt(i).tag;
    if (*twice < before.tag + before.tags) return false;
  }
  is_finished_ = true;
  return true;
}

bool TagTable::isOneRun(int64_t* tag, int64_t* tags, int64_t* first) const {
  if (spool_ || runs_.size() != 1 || runs_[0].step != 1) return false;
  *tag = runs_[0].tag;
  *tags = runs_[0].tags;
  *first = runs_[0].first;
  return true;
}

// Of the runs that begin at or before the tag, the last one; there is one.
uint64_t TagTable::lastNotAbove(int64_t tag) {
  uint64_t low = 0, high = runs();
  if (spool_) {
    const auto after = std::upper_bound(samples_.begin(), samples_.end(), tag);
    low = static_cast<uint64_t>(after - samples_.begin() - 1) * kSampledRuns;
    high = std::min(low + kSampledRuns, high);
  }
  while (high - low > 1) {
    const uint64_t middle = low + (high - low) / 2;
    (runAt(middle).tag <= tag ? low : high) = middle;
  }
  return low;
}

bool TagTable::find(int64_t tag, int64_t* first, int64_t* count) {
  if (tag < last_.tag || tag - last_.tag >= last_.tags) {
    if (runs() == 0 || tag < runAt(0).tag) return false;
    // note: the next run is where those look who come in order.
    if (at_ + 1 < runs()) last_ = runAt(++at_);
    if (tag < last_.tag || tag - last_.tag >= last_.tags) {
      at_ = lastNotAbove(tag);
      last_ = runAt(at_);
    }
    if (tag - last_.tag >= last_.tags) return false;
  }
  *first = last_.first + (tag - last_.tag) * last_.step;
  *count = last_.step;
  return true;
}

}  // namespace tetstream
