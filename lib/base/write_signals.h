// base: writes that fail where a signal would end the process. Depends on nothing.
#pragma once

#include <csignal>

namespace tetstream {

// While this lives, SIGPIPE (nobody reads the pipe or socket any more) and SIGXFSZ (the file would
// exceed the process's limit) do not reach the thread, to which they are sent by its own writes:
// those fail, with EPIPE and EFBIG. Leaves errno as it is.
class WriteSignalsHeld {
 public:
  WriteSignalsHeld() noexcept;
  ~WriteSignalsHeld();
  WriteSignalsHeld(const WriteSignalsHeld&) = delete;
  WriteSignalsHeld& operator=(const WriteSignalsHeld&) = delete;

 private:
  sigset_t held_, before_, mask_;
};

}  // namespace tetstream
