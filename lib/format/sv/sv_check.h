// format/sv: what makes the references of a streaming mesh (.sva, .svb) valid: in range, four
// different vertices, none used after it was finalized. Depends on nothing.
//
// Kept apart from the readers so that another table of active vertices can take its place.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

namespace tetstream {

// The vertices introduced and not yet finalized, one bit each, in pages of 4096 ranks. A page is
// there only while one of its vertices is active, so that memory follows the front; the table of
// pages, 8 bytes for 4096 ranks, begins at the lowest active page.
class SvActive {
 public:
  int64_t introduced() const { return end_; }
  void introduce();  // the next rank becomes active
  bool contains(int64_t rank) const;
  void finalize(int64_t rank);  // of an active vertex

 private:
  static constexpr int64_t kPageRanks = 4096;
  struct Page {
    int64_t active = 0;
    uint64_t words[kPageRanks / 64] = {};
  };
  std::deque<std::unique_ptr<Page>> pages_;  // null: no vertex of the page is active
  std::unique_ptr<Page> spare_;              // the last page given up, all bits 0
  int64_t first_page_ = 0;                   // number of pages_.front()
  int64_t end_ = 0;
};

bool svAllDiffer(const int64_t ranks[4]);

// The references of a cell where nothing is finalized, turned into ranks in place. False: *problem
// says what is wrong.
bool svResolveIndexed(int64_t refs[4], int64_t vertex_count, std::string* problem);

// Turns references as they stand in the file into ranks. A reference r > 0 is vertex r - 1; r < 0
// is vertex V + r, V being the number of vertices before, and its last use.
class SvCheck {
 public:
  void introduce() { active_.introduce(); }
  int64_t introduced() const { return active_.introduced(); }
  // In place; bit j of *last_uses is set where corner j was a last use. False: see problem().
  bool resolveCell(int64_t refs[4], uint8_t* last_uses);
  // A vertex named by an explicit finalization. False: see problem().
  bool resolveFinalized(int64_t* ref);
  const std::string& problem() const { return problem_; }

 private:
  bool resolve(int64_t* ref);
  SvActive active_;
  std::string problem_;
};

}  // namespace tetstream
