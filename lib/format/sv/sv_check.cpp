#include "sv_check.h"

#include <utility>

#include "status.h"

namespace tetstream {

void SvActive::introduce() {
  const int64_t in_page = end_ % kPageRanks;
  if (in_page == 0) {
    if (pages_.empty()) first_page_ = end_ / kPageRanks;
    pages_.push_back(spare_ ? std::move(spare_) : std::make_unique<Page>());
  }
  Page& page = *pages_.back();
  page.words[in_page / 64] |= uint64_t{1} << (in_page % 64);
  ++page.active;
  ++end_;
}

bool SvActive::contains(int64_t rank) const {
  const int64_t page = rank / kPageRanks - first_page_;
  if (page < 0 || page >= static_cast<int64_t>(pages_.size())) return false;
  const Page* p = pages_[static_cast<size_t>(page)].get();
  return p && (p->words[rank % kPageRanks / 64] >> (rank % 64) & 1);
}

void SvActive::finalize(int64_t rank) {
  std::unique_ptr<Page>& page = pages_[static_cast<size_t>(rank / kPageRanks - first_page_)];
  page->words[rank % kPageRanks / 64] &= ~(uint64_t{1} << (rank % 64));
  // The last page stays while vertices are still to be added to it.
  if (--page->active > 0 || end_ / kPageRanks == rank / kPageRanks) return;
  spare_ = std::move(page);
  while (!pages_.empty() && !pages_.front()) {
    pages_.pop_front();
    ++first_page_;
  }
}

bool svAllDiffer(const int64_t v[4]) {
  return v[0] != v[1] && v[0] != v[2] && v[0] != v[3] && v[1] != v[2] && v[1] != v[3] &&
         v[2] != v[3];
}

static std::string outOfRange(int64_t ref, int64_t count) {
  return textOf("the reference %lld is not to one of the %lld vertices before it",
                static_cast<long long>(ref), static_cast<long long>(count));
}

static std::string notDifferent(const int64_t ranks[4]) {
  return textOf("a cell needs four different vertices, this one has %lld %lld %lld %lld",
                static_cast<long long>(ranks[0]), static_cast<long long>(ranks[1]),
                static_cast<long long>(ranks[2]), static_cast<long long>(ranks[3]));
}

bool svResolveIndexed(int64_t refs[4], int64_t vertex_count, std::string* problem) {
  for (int j = 0; j < 4; ++j) {
    if (refs[j] < 1 || refs[j] > vertex_count) {
      *problem = outOfRange(refs[j], vertex_count);
      return false;
    }
    --refs[j];
  }
  if (svAllDiffer(refs)) return true;
  *problem = notDifferent(refs);
  return false;
}

bool SvCheck::resolve(int64_t* ref) {
  const int64_t count = introduced();
  const int64_t rank = *ref > 0 ? *ref - 1 : count + *ref;
  if (*ref == 0 || rank < 0 || rank >= count) {
    problem_ = outOfRange(*ref, count);
    return false;
  }
  if (!active_.contains(rank)) {
    problem_ = textOf("vertex %lld is used after it was finalized", static_cast<long long>(rank));
    return false;
  }
  *ref = rank;
  return true;
}

bool SvCheck::resolveCell(int64_t refs[4], uint8_t* last_uses) {
  uint8_t bits = 0;
  for (int j = 0; j < 4; ++j) {
    if (refs[j] < 0) bits |= static_cast<uint8_t>(1 << j);
    if (!resolve(&refs[j])) return false;
  }
  if (!svAllDiffer(refs)) {
    problem_ = notDifferent(refs);
    return false;
  }
  for (int j = 0; j < 4; ++j)
    if (bits >> j & 1) active_.finalize(refs[j]);
  *last_uses = bits;
  return true;
}

bool SvCheck::resolveFinalized(int64_t* ref) {
  if (!resolve(ref)) return false;
  active_.finalize(*ref);
  return true;
}

}  // namespace tetstream
