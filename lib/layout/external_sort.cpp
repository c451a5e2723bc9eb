#include "external_sort.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace tetstream {

constexpr size_t kFanIn = 64;  // runs that are merged at once
constexpr size_t kLeastRows = 1024;
constexpr size_t kLeastBlock = 4 << 10, kLargestBlock = 256 << 10;
constexpr unsigned kDigitBits = 11, kDigits = (64 + kDigitBits - 1) / kDigitBits;

// ------------------------------------------------------------------------------ tree of losers

// Of runs in order, the record with the least key; the earlier run first where keys are equal.
class ExternalSort::Merge {
 public:
  Merge(const std::unique_ptr<RowSpool>* runs, size_t count)
      : runs_(runs), count_(count), leaves_(std::bit_ceil(count)) {
    heads_.resize(leaves_);
    losers_.assign(leaves_, 0);
    for (size_t i = 0; i < count_; ++i) advance(i);
    winner_ = build(1);
  }
  // The record; null at the end.
  const unsigned char* next() {
    if (started_) {
      advance(winner_);
      replay();
    }
    started_ = true;
    return heads_[winner_].record;
  }

 private:
  struct Head {
    const unsigned char* record = nullptr;  // null: the run is used up
    uint64_t key = 0, at = 0;
  };
  void advance(size_t run) {
    Head& head = heads_[run];
    head.record = head.at < runs_[run]->rows()
                      ? static_cast<const unsigned char*>(runs_[run]->row(head.at++))
                      : nullptr;
    if (head.record) std::memcpy(&head.key, head.record, sizeof head.key);
  }
  bool isBefore(size_t a, size_t b) const {
    const Head &x = heads_[a], &y = heads_[b];
    if (!x.record || !y.record) return x.record || (!y.record && a < b);
    return x.key != y.key ? x.key < y.key : a < b;
  }
  // Nodes from 1 on, those of the last level are the runs. Returns the winner below.
  size_t build(size_t node) {
    if (node >= leaves_) return node - leaves_;
    const size_t a = build(2 * node), b = build(2 * node + 1);
    losers_[node] = isBefore(a, b) ? b : a;
    return isBefore(a, b) ? a : b;
  }
  void replay() {
    for (size_t node = (winner_ + leaves_) / 2; node > 0; node /= 2)
      if (isBefore(losers_[node], winner_)) std::swap(losers_[node], winner_);
  }

  const std::unique_ptr<RowSpool>* runs_;
  size_t count_, leaves_, winner_ = 0;
  std::vector<Head> heads_;
  std::vector<size_t> losers_;  // of each node; those of the last level are the runs
  bool started_ = false;
};

// ------------------------------------------------------------------------------------- runs

// Two thirds of the memory are for a run, one third for a block of each run that is merged.
ExternalSort::ExternalSort(size_t payload_bytes, size_t memory_bytes, Account& account,
                           const std::string& temp_dir)
    : payload_bytes_(std::max<size_t>(payload_bytes, 1)),  // so that each has a place
      memory_bytes_(memory_bytes),
      rows_at_once_(std::clamp<size_t>(memory_bytes / 3 * 2 / (payload_bytes_ + 2 * sizeof(Entry)),
                                       kLeastRows, 0xffffffffu)),
      temp_dir_(temp_dir),
      entries_(account),
      scratch_(account),
      payloads_(account),
      record_(sizeof(uint64_t) + payload_bytes_) {}

ExternalSort::~ExternalSort() = default;

SpoolShape ExternalSort::shapeOfRun() const {
  return {1, std::clamp(memory_bytes_ / (3 * kFanIn), kLeastBlock, kLargestBlock)};
}

unsigned char* ExternalSort::add(uint64_t key) {
  if (count_ == rows_at_once_) flushRun();
  if (count_ == entries_.size()) {
    const size_t rows = std::min(std::max<size_t>(2 * count_, kLeastRows), rows_at_once_);
    entries_.resize(rows);
    payloads_.resize(checkedMultiply(rows, payload_bytes_));
  }
  entries_[count_] = {key, static_cast<uint32_t>(count_)};
  unsigned char* payload = payloads_.data() + payload_bytes_ * count_++;
  *payload = 0;  // of keys alone, nobody fills it
  return payload;
}

// By digits, the lowest first; those that are the same everywhere are passed over.
void ExternalSort::sortRun() {
  constexpr size_t kValues = size_t{1} << kDigitBits;
  if (scratch_.size() < count_) scratch_.resize(entries_.size());
  std::vector<size_t> starts(kDigits * kValues);
  const auto digit = [](uint64_t key, unsigned d) {
    return key >> (d * kDigitBits) & (kValues - 1);
  };
  for (size_t i = 0; i < count_; ++i)
    for (unsigned d = 0; d < kDigits; ++d) ++starts[d * kValues + digit(entries_[i].key, d)];
  for (unsigned d = 0; d < kDigits; ++d) {
    size_t* start = &starts[d * kValues];
    if (count_ == 0 || start[digit(entries_[0].key, d)] == count_) continue;
    size_t sum = 0;
    for (size_t v = 0; v < kValues; ++v) sum += std::exchange(start[v], sum);
    for (size_t i = 0; i < count_; ++i) scratch_[start[digit(entries_[i].key, d)]++] = entries_[i];
    entries_.swap(scratch_);
  }
}

void ExternalSort::flushRun() {
  sortRun();
  auto run = std::make_unique<RowSpool>(record_.size(), temp_dir_, shapeOfRun());
  for (size_t i = 0; i < count_; ++i) {
    std::memcpy(record_.data(), &entries_[i].key, sizeof(uint64_t));
    std::memcpy(record_.data() + sizeof(uint64_t),
                payloads_.data() + payload_bytes_ * entries_[i].row, payload_bytes_);
    run->append(record_.data(), 1);
  }
  run->finish();
  countDisk(run->diskBytes());
  runs_.push_back(std::move(run));
  levels_.push_back(0);
  count_ = 0;
  mergeFullLevels();
}

// So many runs of a level are merged at once: their number, and that of open files, grows with the
// logarithm of the records only. Neighbours, so that equal keys stay as they came.
void ExternalSort::mergeFullLevels() {
  for (;;) {
    const size_t count = runs_.size(), first = count - std::min(count, kFanIn);
    if (count < kFanIn || levels_[first] != levels_.back()) return;
    mergeLast(first, levels_.back() + 1);
  }
}

void ExternalSort::mergeLast(size_t first, unsigned level) {
  std::unique_ptr<RowSpool> merged = mergeRuns(first, runs_.size() - first);
  runs_.resize(first);
  levels_.resize(first);
  runs_.push_back(std::move(merged));
  levels_.push_back(level);
}

std::unique_ptr<RowSpool> ExternalSort::mergeRuns(size_t first, size_t count) {
  auto merged = std::make_unique<RowSpool>(record_.size(), temp_dir_, shapeOfRun());
  Merge merge(&runs_[first], count);
  while (const unsigned char* record = merge.next()) merged->append(record, 1);
  merged->finish();
  countDisk(merged->diskBytes());
  for (size_t i = first; i < first + count; ++i) {
    on_disk_ -= runs_[i]->diskBytes();
    runs_[i].reset();
  }
  return merged;
}

void ExternalSort::countDisk(uint64_t more) {
  on_disk_ += more;
  most_on_disk_ = std::max(most_on_disk_, on_disk_);
}

// The last ones, which are the smallest, until the rest can be merged at once.
void ExternalSort::mergeUntilFew() {
  while (runs_.size() > kFanIn) mergeLast(runs_.size() - kFanIn, levels_.back());
}

void ExternalSort::finish() {
  if (runs_.empty()) {
    sortRun();
    return;
  }
  flushRun();
  entries_.resize(0);
  scratch_.resize(0);
  payloads_.resize(0);
  mergeUntilFew();
  merge_ = std::make_unique<Merge>(runs_.data(), runs_.size());
}

const unsigned char* ExternalSort::next(uint64_t* key) {
  if (merge_) {
    const unsigned char* record = merge_->next();
    if (!record) return nullptr;
    std::memcpy(key, record, sizeof *key);
    return record + sizeof *key;
  }
  if (at_ == count_) return nullptr;
  const Entry& entry = entries_[at_++];
  *key = entry.key;
  return payloads_.data() + payload_bytes_ * entry.row;
}

}  // namespace tetstream
