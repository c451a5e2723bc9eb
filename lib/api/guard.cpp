#include "guard.h"

#include <new>
#include <stdexcept>

namespace tetstream {

static_assert(static_cast<int32_t>(Status::kOk) == TETSTREAM_OK);
static_assert(static_cast<int32_t>(Status::kEnd) == TETSTREAM_END);
static_assert(static_cast<int32_t>(Status::kTargetMissed) == TETSTREAM_TARGET_MISSED);
static_assert(static_cast<int32_t>(Status::kBadArgument) == TETSTREAM_BAD_ARGUMENT);
static_assert(static_cast<int32_t>(Status::kBadState) == TETSTREAM_BAD_STATE);
static_assert(static_cast<int32_t>(Status::kNoMemory) == TETSTREAM_NO_MEMORY);
static_assert(static_cast<int32_t>(Status::kBadData) == TETSTREAM_BAD_DATA);
static_assert(static_cast<int32_t>(Status::kIo) == TETSTREAM_IO);
static_assert(static_cast<int32_t>(Status::kUnsupported) == TETSTREAM_UNSUPPORTED);
static_assert(static_cast<int32_t>(Status::kCancelled) == TETSTREAM_CANCELLED);
static_assert(static_cast<int32_t>(Status::kCallback) == TETSTREAM_CALLBACK);
static_assert(static_cast<int32_t>(Status::kInternal) == TETSTREAM_INTERNAL);

const char* stateWords(State state) noexcept {
  switch (state) {
    case State::kFailed:
      return "could not be created";
    case State::kReady:
      return "has not begun";
    case State::kRunning:
      return "has begun";
    case State::kFinished:
      return "has finished";
    case State::kBroken:
      return "failed before";
    case State::kDestroyed:
      return "was destroyed";
  }
  return "is in no known state";
}

void failState(const char* noun, State state) {
  fail(Status::kBadState, "the %s %s", noun, stateWords(state));
}

void failNull(const char* argument) {
  fail(Status::kBadArgument, "%s is NULL", argument);
}

void Message::set(const char* prefix, const char* text) noexcept {
  try {
    std::string whole = prefix ? std::string(prefix) + ": " : std::string();
    whole += text;
    text_.swap(whole);
    lost_ = false;
  } catch (...) {
    lost_ = true;
  }
}

const char* Message::text() const noexcept {
  return lost_ ? "the system has no memory left, not even for a message" : text_.c_str();
}

static tetstream_status classify(const char* function, Message& message) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    const Status status = error.status();
    const bool misuse = status == Status::kBadArgument || status == Status::kBadState;
    message.set(misuse ? function : nullptr, error.what());
    return static_cast<tetstream_status>(status);
  } catch (const std::bad_alloc&) {
    message.set(nullptr, "the system has no memory left");
    return TETSTREAM_NO_MEMORY;
  } catch (const std::length_error&) {
    message.set(nullptr, "an array does not fit into memory");
    return TETSTREAM_NO_MEMORY;
  } catch (const std::exception& error) {
    message.set("a defect of the library", error.what());
  } catch (...) {
    message.set(nullptr, "a defect of the library: an exception of unknown kind");
  }
  return TETSTREAM_INTERNAL;
}

tetstream_status caught(const char* function, Message* message) noexcept {
  Message unheard;
  return classify(function, message ? *message : unheard);
}

}  // namespace tetstream
