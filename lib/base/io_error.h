// base: what the system refused, as an Error. Depends on status.h.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "status.h"

namespace tetstream {

// "NAME: cannot WHAT: the system's word".
[[noreturn]] inline void failIo(const std::string& name, const char* what) {
  const int error = errno;
  fail(Status::kIo, "%s: cannot %s: %s", name.c_str(), what, std::strerror(error));
}

}  // namespace tetstream
