// file: many files of which only some are open at a time. Depends on bytes.h.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bytes.h"

namespace tetstream {

// Where a name in a file leads: beside the file, or anywhere if it is absolute.
std::string pathBeside(const std::string& file, const std::string& name);

class FilePool : public std::enable_shared_from_this<FilePool> {
 public:
  // What is no regular file is spooled, to `temp_dir`, and stays open: it cannot be read twice.
  // `unwraps`: gzip and zstd are taken off. Not of plain values, which may begin as they do.
  explicit FilePool(std::string temp_dir, bool unwraps = false)
      : temp_dir_(std::move(temp_dir)), unwraps_(unwraps) {}
  // The file, opened once to know its size and from then on when it is read.
  std::unique_ptr<ByteSource> add(const std::string& path);
  ByteSource& open(size_t file);

 private:
  std::string temp_dir_;
  bool unwraps_;
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<ByteSource>> files_;  // null: not open
  std::deque<size_t> opened_;                       // that may be closed, in this order
};

}  // namespace tetstream
