// tests: the error that something ends with.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "status.h"

namespace tetstream::test {

// kOk and nothing where it ends without one.
inline std::pair<Status, std::string> thrownBy(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return {error.status(), error.text()};
  }
  return {Status::kOk, ""};
}

}  // namespace tetstream::test
