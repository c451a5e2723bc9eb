#include "side_files.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace fuzz {

namespace {

constexpr std::string_view kBetween = "\n@@@@\n";

struct FileNames {
  std::string_view format;
  std::vector<const char*> names;
};

const std::vector<FileNames>& table() {
  static const std::vector<FileNames> rows = {{"mesh", {"a.mesh", "a.sol"}},
                                              {"meshb", {"a.meshb", "a.solb"}},
                                              {"tetgen", {"a.node", "a.ele", "a.face"}},
                                              {"pvtu", {"a.pvtu", "0.vtu", "1.vtu"}},
                                              {"pvd", {"a.pvd", "0.vtu", "1.vtu", "a.pvtu"}},
                                              {"xdmf", {"a.xdmf", "a.h5", "a.bin"}}};
  return rows;
}

// In memory where there is such a place: fuzzing writes millions of files.
class Folder {
 public:
  Folder() {
    std::error_code none;
    const bool memory = std::filesystem::is_directory("/dev/shm", none);
    path_ = (memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) +
            "/tetstream-fuzz-" + std::to_string(::getpid());
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  std::string file(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace

const char* writeSideFiles(std::string_view input, std::string_view format) {
  for (const FileNames& row : table()) {
    if (row.format != format) continue;
    static const Folder folder;
    static std::string first;
    first = folder.file(row.names.front());
    bool is_there = true;
    for (const char* name : row.names) {
      const std::string path = folder.file(name);
      const size_t end = input.find(kBetween);
      if (is_there)
        std::ofstream(path, std::ios::binary) << input.substr(0, end);
      else
        ::unlink(path.c_str());
      is_there = end != std::string_view::npos;
      if (is_there) input.remove_prefix(end + kBetween.size());
    }
    return first.c_str();
  }
  return nullptr;
}

}  // namespace fuzz
