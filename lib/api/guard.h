// api: how every function of the public header is written: one call of `guard`, which lets nothing
// out but a status, and leaves the sentence in the handle. Depends on tetstream.h, status.h,
// undisturbed.h.
#pragma once

#include <string>
#include <type_traits>

#include "status.h"
#include "tetstream/tetstream.h"
#include "undisturbed.h"

namespace tetstream {

// What may be done with a handle. The order has no meaning.
enum class State { kFailed, kReady, kRunning, kFinished, kBroken, kDestroyed };

const char* stateWords(State state) noexcept;

// The sentence for the last failure. Setting it never throws: when memory is short, the sentence
// is one about memory.
class Message {
 public:
  // "prefix: text", or the text alone if `prefix` is null.
  void set(const char* prefix, const char* text) noexcept;
  const char* text() const noexcept;

 private:
  std::string text_;
  bool lost_ = false;
};

// What all handles share. `busy` is true inside a call that runs callbacks of the caller's, which
// must not come back with the same handle.
struct Handle {
  mutable Message message;
  State state = State::kFailed;
  bool busy = false;
};

// To be called in a catch clause: stores the sentence (if there is a place) and gives the status.
// Misuse is told with the function's name; a defect of the data names its place by itself.
tetstream_status caught(const char* function, Message* message) noexcept;

[[noreturn]] void failState(const char* noun, State state);
[[noreturn]] void failNull(const char* argument);

inline void needPlace(const void* pointer, const char* argument) {
  if (!pointer) failNull(argument);
}

template <class H>
void needState(const H& handle, State state) {
  if (handle.state != state) failState(H::kNoun, handle.state);
}

// For a handle that another one's function is given: if it could not be created, says why.
template <class H>
void needCreated(const H& handle) {
  if (handle.state == State::kFailed)
    fail(Status::kBadState, "the %s could not be created: %s", H::kNoun, handle.message.text());
}

// A body gives a Status or nothing, which means kOk.
template <class Body, class... Arguments>
tetstream_status statusOf(Body&& body, Arguments&... arguments) {
  if constexpr (std::is_void_v<decltype(body(arguments...))>) {
    body(arguments...);
    return TETSTREAM_OK;
  } else {
    return static_cast<tetstream_status>(body(arguments...));
  }
}

// Runs body(*handle), whatever its state.
template <class H, class Body>
tetstream_status guardAny(const char* function, H* handle, Body&& body) noexcept {
  const Undisturbed undisturbed;
  try {
    needPlace(handle, "the handle");
    if (handle->busy)
      fail(Status::kBadState, "the %s is in use by a call that has not returned", H::kNoun);
    return statusOf(body, *handle);
  } catch (...) {
    return caught(function, handle ? &handle->message : nullptr);
  }
}

// The same for all but those that could not be created: they keep the sentence that says why.
template <class H, class Body>
tetstream_status guard(const char* function, H* handle, Body&& body) noexcept {
  if (handle && handle->state == State::kFailed) return TETSTREAM_BAD_STATE;
  return guardAny(function, handle, body);
}

// For functions without a handle.
template <class Body>
tetstream_status guard(Body&& body) noexcept {
  const Undisturbed undisturbed;
  try {
    return statusOf(body);
  } catch (...) {
    return caught(nullptr, nullptr);
  }
}

// Makes a handle at *place and runs body(**place). When that fails the handle stays, to be asked
// for its message.
template <class H, class Body>
tetstream_status guardCreate(const char* function, H** place, Body&& body) noexcept {
  if (!place) return TETSTREAM_BAD_ARGUMENT;
  *place = nullptr;
  return guard([&] {
    *place = new H;
    const auto outcome = guardAny(function, *place, [&](H& handle) {
      body(handle);
      handle.state = State::kReady;
    });
    return static_cast<Status>(outcome);
  });
}

// How every handle goes.
template <class H>
void destroy(H* handle) noexcept {
  const Undisturbed undisturbed;
  delete handle;
}

template <class H>
const char* messageOf(const H* handle) noexcept {
  return handle ? handle->message.text() : "there is no handle: it is NULL";
}

}  // namespace tetstream
