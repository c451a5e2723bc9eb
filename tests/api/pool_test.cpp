// A pool of the caller's: the same bytes whatever it does with the work, on its threads alone.
#include <dirent.h>

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "check.h"
#include "tetstream/tetstream.h"

namespace {

struct Piece {
  void (*work)(void*);
  void* argument;
};

// Threads that take what comes, or (kLater) what is there when they are let go, or nothing.
class Pool {
 public:
  enum Manner { kThreads, kAtOnce, kRefuses, kEverySecond, kThrows, kLater };

  Pool(Manner manner, int threads) : manner_(manner) {
    if (manner == kThreads || manner == kEverySecond)
      for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  }
  ~Pool() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      over_ = true;
    }
    given_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    for (const Piece& piece : queue_) piece.work(piece.argument);  // late
  }

  static int32_t submit(void* user, void (*work)(void*), void* argument) {
    return static_cast<Pool*>(user)->take({work, argument});
  }
  std::atomic<int> taken{0};
  std::atomic<bool> other_caller{false};

 private:
  int32_t take(Piece piece) {
    if (std::this_thread::get_id() != caller_) other_caller = true;
    if (manner_ == kThrows) throw std::runtime_error("of the caller's");
    if (manner_ == kRefuses || (manner_ == kEverySecond && ++asked_ % 2 == 0)) return 1;
    ++taken;
    if (manner_ == kAtOnce) {
      piece.work(piece.argument);
      return 0;
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      queue_.push_back(piece);
    }
    given_.notify_one();
    return 0;
  }

  void serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      given_.wait(lock, [this] { return over_ || !queue_.empty(); });
      if (queue_.empty()) return;
      const Piece piece = queue_.front();
      queue_.pop_front();
      lock.unlock();
      piece.work(piece.argument);
      lock.lock();
    }
  }

  const Manner manner_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<int> asked_{0};
  std::mutex mutex_;
  std::condition_variable given_;
  std::deque<Piece> queue_;
  bool over_ = false;
  std::vector<std::thread> threads_;
};

int threadsOfProcess() {
  int count = 0;
  if (DIR* folder = opendir("/proc/self/task")) {
    while (const dirent* entry = readdir(folder)) count += entry->d_name[0] != '.';
    closedir(folder);
  }
  return count;
}

std::atomic<int> most_threads;

int32_t progress(void*, const tetstream_progress*) {
  const int now = threadsOfProcess();
  if (now > most_threads) most_threads = now;
  return 0;
}

int64_t cellCount() {
  return std::getenv("TETSTREAM_SLOW") ? 6000 : 60000;
}

// NULL if it cannot be made. Nothing is counted here: runs are on several threads.
tetstream_options* optionsWith(const tetstream_pool_callbacks* pool, int64_t threads) {
  tetstream_options* options = nullptr;
  if (tetstream_options_create(&options) < 0 ||
      tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 0.5) < 0 ||
      tetstream_options_set_int64(options, TETSTREAM_OPTION_WINDOW, cellCount() / 15) < 0 ||
      tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, threads) < 0 ||
      (pool && tetstream_options_set_pool(options, pool) < 0)) {
    tetstream_options_destroy(options);
    return nullptr;
  }
  return options;
}

// The bytes of a run with these options, which are destroyed before it begins; none if it fails.
std::string simplified(tetstream_options* options) {
  tetstream_reader* reader = nullptr;
  tetstream_writer* writer = nullptr;
  tetstream_simplifier* simplifier = nullptr;
  const void* data = nullptr;
  size_t size = 0;
  bool good = options && tetstream_reader_generate("fluid", cellCount(), 1, &reader) >= 0 &&
              tetstream_writer_create_memory("tets", &writer) >= 0 &&
              tetstream_simplifier_create(options, writer, &simplifier) >= 0;
  tetstream_options_destroy(options);
  good = good && tetstream_simplifier_set_progress(simplifier, progress, nullptr) >= 0 &&
         tetstream_simplifier_run(simplifier, reader) == TETSTREAM_OK &&
         tetstream_writer_get_memory(writer, &data, &size) >= 0;
  std::string bytes(good ? static_cast<const char*>(data) : "", good ? size : 0);
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  return bytes;
}

tetstream_pool_callbacks tableOf(Pool& pool, int threads) {
  tetstream_pool_callbacks table = {};
  table.struct_size = sizeof table;
  table.user = &pool;
  table.threads = threads;
  table.submit = Pool::submit;
  return table;
}

std::string alone() {
  static const std::string bytes = simplified(optionsWith(nullptr, 1));
  CHECK(!bytes.empty());
  return bytes;
}

void a_pool_gives_the_bytes_of_one_thread() {
  for (int threads : {0, 1, 2, 3, 7})
    for (int64_t option : {0, 1, 2, 4}) {
      if (std::getenv("TETSTREAM_SLOW") && (threads % 2 == 1 || option % 2 == 1)) continue;
      Pool pool(Pool::kThreads, threads);
      const tetstream_pool_callbacks table = tableOf(pool, threads);
      CHECK(simplified(optionsWith(&table, option)) == alone());
      CHECK(!pool.other_caller);
      const bool is_used = option > 1 || (option == 0 && threads > 0);
      CHECK_EQUAL(pool.taken > 0, is_used);
    }
}

void what_a_pool_does_with_the_work_changes_nothing() {
  for (Pool::Manner manner :
       {Pool::kAtOnce, Pool::kRefuses, Pool::kEverySecond, Pool::kThrows, Pool::kLater}) {
    Pool pool(manner, 2);
    const tetstream_pool_callbacks table = tableOf(pool, 3);
    CHECK(simplified(optionsWith(&table, 0)) == alone());
    CHECK(!pool.other_caller);
  }
}

// Where the options go before the work.
void a_pool_stays_with_what_was_made_with_it() {
  Pool pool(Pool::kAtOnce, 2);
  const tetstream_pool_callbacks table = tableOf(pool, 2);
  tetstream_options* options = optionsWith(&table, 0);
  if (std::getenv("TETSTREAM_SLOW"))
    CHECK_EQUAL(tetstream_options_parse(options, "boundary-samples", "20000"), TETSTREAM_OK);
  tetstream_comparison* comparison = nullptr;
  tetstream_diagram* diagram = nullptr;
  CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_diagram_create(options, 100, 100, &diagram), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_pool(options, nullptr), TETSTREAM_OK);
  tetstream_options_destroy(options);
  tetstream_reader* readers[3] = {};
  for (tetstream_reader*& reader : readers)
    CHECK_EQUAL(tetstream_reader_generate("ball", 3000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_read(comparison, readers[0], readers[1], nullptr, nullptr),
              TETSTREAM_OK);
  CHECK(pool.taken > 0);
  CHECK_EQUAL(tetstream_diagram_read(diagram, readers[2], TETSTREAM_PAGE_LAYOUT, nullptr, nullptr),
              TETSTREAM_OK);
  for (tetstream_reader* reader : readers) tetstream_reader_destroy(reader);
  tetstream_diagram_destroy(diagram);
  tetstream_comparison_destroy(comparison);
}

void the_library_starts_no_thread_beside_a_pool() {
  Pool pool(Pool::kThreads, 2);
  const tetstream_pool_callbacks table = tableOf(pool, 2);
  const int before = threadsOfProcess();
  most_threads = 0;
  simplified(optionsWith(&table, 4));
  CHECK_EQUAL(most_threads, before);
}

void a_pool_may_run_the_library_on_its_own_threads() {
  Pool pool(Pool::kThreads, 2);
  struct Job {
    Pool* pool;
    std::string bytes[2];
    std::atomic<int> done{0};
  } job;
  job.pool = &pool;
  const auto work = [](void* argument) {
    Job& j = *static_cast<Job*>(argument);
    const tetstream_pool_callbacks table = tableOf(*j.pool, 2);
    static std::atomic<int> number{0};
    j.bytes[number++] = simplified(optionsWith(&table, 0));
    ++j.done;
  };
  for (int i = 0; i < 2; ++i) CHECK_EQUAL(Pool::submit(&pool, work, &job), 0);
  while (job.done < 2) std::this_thread::yield();
  CHECK(job.bytes[0] == alone());
  CHECK(job.bytes[1] == alone());
}

void a_pool_that_is_not_one_is_refused() {
  Pool pool(Pool::kThreads, 1);
  tetstream_options* options = optionsWith(nullptr, 0);
  tetstream_pool_callbacks table = tableOf(pool, 1);
  table.struct_size = 8;
  CHECK_EQUAL(tetstream_options_set_pool(options, &table), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "struct_size");
  table = tableOf(pool, 1025);
  CHECK_EQUAL(tetstream_options_set_pool(options, &table), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "1025 threads");
  table = tableOf(pool, -1);
  CHECK_EQUAL(tetstream_options_set_pool(options, &table), TETSTREAM_BAD_ARGUMENT);
  table = tableOf(pool, 1);
  table.submit = nullptr;
  CHECK_EQUAL(tetstream_options_set_pool(options, &table), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "submit");
  CHECK_EQUAL(tetstream_options_set_pool(nullptr, &table), TETSTREAM_BAD_ARGUMENT);

  table = tableOf(pool, 1);  // and NULL takes it back
  CHECK_EQUAL(tetstream_options_set_pool(options, &table), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_pool(options, nullptr), TETSTREAM_OK);
  CHECK(simplified(options) == alone());
  CHECK_EQUAL(pool.taken, 0);
}

}  // namespace

int main() {
  RUN_CASE(a_pool_gives_the_bytes_of_one_thread);
  RUN_CASE(what_a_pool_does_with_the_work_changes_nothing);
  RUN_CASE(a_pool_stays_with_what_was_made_with_it);
  RUN_CASE(the_library_starts_no_thread_beside_a_pool);
  RUN_CASE(a_pool_may_run_the_library_on_its_own_threads);
  RUN_CASE(a_pool_that_is_not_one_is_refused);
  return check_end();
}
