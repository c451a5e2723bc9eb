#include "final_place.h"

#include <unistd.h>

#include <climits>
#include <cstdlib>
#include <memory>

#include "status.h"

namespace tetstream {

constexpr int kMostLinks = 40;  // as the system follows

// Empty where there is none.
static std::string realPath(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), std::free);
  return real ? real.get() : "";
}

// What a link says; empty if the path is none.
static std::string linkAt(const std::string& path) {
  char text[PATH_MAX];
  const ssize_t size = ::readlink(path.c_str(), text, sizeof text);
  return size > 0 ? std::string(text, static_cast<size_t>(size)) : "";
}

// The number that a name in the folder of the process's descriptors is; -1 for others.
static int descriptorOf(const std::string& folder, const std::string& name) {
  const bool is_number =
      !name.empty() && name.size() < 10 && name.find_first_not_of("0123456789") == name.npos;
  const bool is_there = is_number && !folder.empty() && folder == realPath("/proc/self/fd");
  return is_there ? std::atoi(name.c_str()) : -1;
}

FinalPlace finalPlaceOf(const std::string& path) {
  std::string at = path;
  for (int links = 0; links < kMostLinks; ++links) {
    const size_t slash = at.find_last_of('/') + 1;
    const std::string folder = realPath(slash ? at.substr(0, slash) : "."), name = at.substr(slash);
    if (const int descriptor = descriptorOf(folder, name); descriptor >= 0)
      return {path, descriptor};
    const std::string link = linkAt(at);
    const auto inFolder = [&folder](const std::string& there) {
      return textOf("%s/%s", folder.c_str(), there.c_str());
    };
    if (link.empty()) return {folder.empty() ? at : inFolder(name), -1};
    at = link[0] == '/' ? link : inFolder(link);
  }
  return {path, -1};
}

}  // namespace tetstream
