// run: which file an error comes from. Depends on stream.
#pragma once

#include <string>

#include "source.h"
#include "status.h"

namespace tetstream {

// Whether a sentence begins with a file's name.
inline bool beginsWithName(const std::string& text, const std::string& name) {
  return text.starts_with(name + ":") || text.starts_with(name + ",");
}

// What work() returns. Errors in the data of a stream, which knows no file, tell the input's name.
template <class Work>
auto readNamed(const Input& input, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    const bool is_told = input.name.empty() || beginsWithName(error.text(), input.name);
    if (error.status() != Status::kBadData || is_told) throw;
    throw Error(error.status(), input.name + ": " + error.text());
  }
}

}  // namespace tetstream
