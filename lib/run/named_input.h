// run: which file an error comes from. Depends on stream.
#pragma once

#include "source.h"
#include "status.h"

namespace tetstream {

// What work() returns. Errors in the data of a stream, which knows no file, tell the input's name.
template <class Work>
auto readNamed(const Input& input, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    const bool is_told = error.text().find(input.name) != std::string::npos;  // also without a name
    if (error.status() != Status::kBadData || is_told) throw;
    throw Error(error.status(), input.name + ": " + error.text());
  }
}

}  // namespace tetstream
