// tests: a folder for files, and what is in it.
#pragma once

#include <dirent.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <cstdlib>
#include <set>
#include <string>

#include "bytes.h"

namespace tetstream::test {

using Names = std::set<std::string>;

// A folder of its own, gone with the test.
class Folder {
 public:
  Folder() {
    std::string name = ::testing::TempDir() + "tetstream-base.XXXXXX";
    if (!::mkdtemp(name.data())) std::abort();
    path = name;
  }
  ~Folder() {
    for (const std::string& name : names()) ::unlink((path + "/" + name).c_str());
    ::rmdir(path.c_str());
  }
  Names names() const {
    Names found;
    DIR* dir = ::opendir(path.c_str());
    while (const dirent* entry = ::readdir(dir))
      if (entry->d_name[0] != '.') found.insert(entry->d_name);
    ::closedir(dir);
    return found;
  }
  std::string file(const std::string& name) const { return path + "/" + name; }
  std::string path;
};

inline std::string contents(ByteSource& source) {
  std::string all;
  char block[7];
  while (const size_t got = source.read(block, sizeof block)) all.append(block, got);
  return all;
}
inline std::string contents(const std::string& path) {
  return contents(*openFile(path));
}

inline void writeFile(const std::string& path, const std::string& text) {
  const auto sink = createFile(path);
  sink->write(text.data(), text.size());
  sink->commit();
}

}  // namespace tetstream::test
