#include "waiting.h"

#include <poll.h>

#include <cerrno>

namespace tetstream {

bool Waiting::forBytes(int fd) const {
  // Looks anew each time: whether it was ended, and at what `fd` is now, which the handler of a
  // signal may have put in its place.
  while (!is_over_.load(std::memory_order_relaxed)) {
    pollfd end = {fd, POLLIN, 0};
    const int ready = ::poll(&end, 1, kMilliseconds);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
    meanwhile();
  }
  return false;
}

}  // namespace tetstream
