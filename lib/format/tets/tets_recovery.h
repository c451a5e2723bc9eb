// format/tets: what is whole of a `.tets` file that is damaged or was not finished. Depends on
// source.h, bytes.h.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bytes.h"
#include "source.h"

namespace tetstream::tets {

// What a reading that goes past damage has found.
struct Losses {
  uint64_t cells = 0;             // in chunks that are missing before others
  uint64_t places = 0;            // where it had to go on behind
  std::vector<std::string> told;  // the first of them, as sentences
  bool complete = false;          // the end marker was there

  void add(const std::string& sentence);
};

// Reads chunk by chunk as the reader does, going past what is damaged: a batch may then begin with
// a later vertex than the one before ended with, and cells may use vertices that did not come.
// Seekable bytes only. Throws if the header is damaged.
std::unique_ptr<Source> openTolerant(std::unique_ptr<ByteSource> bytes, Losses& losses);

// The same as a valid stream: without the cells that use missing vertices, the rest numbered anew.
// Of any bytes; what lies within a wrapping that is damaged, up to there. When it ends, `note` is
// told what is missing.
std::unique_ptr<Source> recover(std::unique_ptr<ByteSource> bytes, const std::string& temp_dir,
                                std::function<void(const std::string&)> note);

}  // namespace tetstream::tets
