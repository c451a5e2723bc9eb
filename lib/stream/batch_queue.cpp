#include "batch_queue.h"

namespace tetstream {

void BatchQueue::ask(const Tasks& tasks) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_asked_ || !mayGoOn()) return;
    is_asked_ = true;
  }
  if (tasks.submit(this)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  is_asked_ = false;
}

void BatchQueue::close() {
  Lock lock(mutex_);
  is_over_ = true;
  changed_.wait(lock, [this] { return !is_busy_; });
  ring_.clear();
}

}  // namespace tetstream
