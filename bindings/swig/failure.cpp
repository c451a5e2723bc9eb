#include "failure.h"

namespace tetstream::swig {

thread_local LibraryCall* LibraryCall::innermost_ = nullptr;

void LibraryCall::keep(std::exception_ptr thrown) noexcept {
  if (innermost_ && !innermost_->thrown_) innermost_->thrown_ = std::move(thrown);
}

std::string withoutFunction(tetstream_status status, const std::string& sentence) {
  const bool is_misuse = status == TETSTREAM_BAD_ARGUMENT || status == TETSTREAM_BAD_STATE;
  if (!is_misuse || sentence.rfind("tetstream_", 0) != 0) return sentence;
  const size_t colon = sentence.find(": ");
  return colon == std::string::npos ? sentence : sentence.substr(colon + 2);
}

void failArgument(const std::string& sentence) {
  throw Failure(TETSTREAM_BAD_ARGUMENT, sentence);
}

void check(tetstream_status status, const char* function) {
  if (status < 0)
    throw Failure(status, std::string(function) + ": " + tetstream_status_name(status));
}

}  // namespace tetstream::swig
