// base: what messages call a file descriptor. Depends on nothing.
#pragma once

#include <string>

namespace tetstream {

inline std::string descriptorName(int fd) {
  constexpr const char* kStandard[] = {"standard input", "standard output", "standard error"};
  return fd >= 0 && fd <= 2 ? kStandard[fd] : "descriptor " + std::to_string(fd);
}

}  // namespace tetstream
