// reading [--rounds N] FILE...: how fast indexed files are read, all columns from front to end,
// beside the plain reading of their bytes in the same minute; the best of N rounds, 5 unless said.
// Both with the file in the system's memory, and uncached, where the system gives it up when asked.
// reading --once THREADS FILE: one such reading; prints the processor seconds of opening, which
// scans what is no array where it lies, and of both, and the wall seconds of opening and of both.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

#include "memory.h"
#include "registry.h"
#include "status.h"
#include "tasks.h"

namespace tetstream {
namespace {

constexpr size_t kPlainBytes = 1 << 20;

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void readPlainly(const std::string& path) {
  const auto bytes = openFile(path);
  std::vector<char> block(kPlainBytes);
  while (bytes->read(block.data(), block.size()) > 0) {
  }
}

// Calls read(first, count) over all rows.
void forRows(int64_t rows, const std::function<void(uint64_t, size_t)>& read) {
  for (int64_t at = 0; at < rows; at += static_cast<int64_t>(kBatchCells))
    read(static_cast<uint64_t>(at),
         static_cast<size_t>(std::min<int64_t>(rows - at, static_cast<int64_t>(kBatchCells))));
}

std::unique_ptr<IndexedSource> openIndexed(const std::string& path, const Tasks* tasks = nullptr) {
  ReadOptions options;
  options.threads.tasks = tasks;
  options.path = path;
  Input input = needFormat("", path).open(openFile(path), options);
  if (!input.indexed) fail(Status::kBadArgument, "%s holds a stream", path.c_str());
  return std::move(input.indexed);
}

int64_t readColumns(IndexedSource& mesh) {
  const Schema& schema = mesh.schema();
  std::vector<double> room(kBatchCells * kMaxComponents);
  std::vector<int64_t> cells(kBatchCells * 4);
  forRows(schema.vertex_count,
          [&](uint64_t at, size_t n) { mesh.readPositions(at, n, room.data()); });
  for (size_t i = 0; i < schema.fields.size(); ++i)
    forRows(schema.vertex_count,
            [&](uint64_t at, size_t n) { mesh.readField(i, at, n, room.data()); });
  forRows(schema.cell_count, [&](uint64_t at, size_t n) { mesh.readCells(at, n, cells.data()); });
  for (size_t i = 0; i < schema.cell_data.size(); ++i)
    forRows(schema.cell_count,
            [&](uint64_t at, size_t n) { mesh.readCellData(i, at, n, room.data()); });
  return schema.cell_count;
}

void giveUpCached(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  ::fdatasync(fd);
  ::posix_fadvise(fd, 0, 0, POSIX_FADV_DONTNEED);
  ::close(fd);
}

void measure(const std::string& path, int rounds) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) fail(Status::kIo, "%s is not there", path.c_str());
  const double megabytes = static_cast<double>(info.st_size) / (1 << 20);
  int64_t cells = 0;
  double best[4] = {1e9, 1e9, 1e9, 1e9};  // plain, columns; both uncached
  for (int i = 0; i < rounds; ++i)
    for (int kind = 0; kind < 4; ++kind) {
      if (kind >= 2) giveUpCached(path);
      const double took = seconds([&] {
        if (kind % 2 == 0)
          readPlainly(path);
        else
          cells = readColumns(*openIndexed(path));
      });
      best[kind] = std::min(best[kind], took);
    }
  const size_t slash = path.find_last_of('/');
  std::printf("| %s | %lld | %.0f | %.0f | %.0f | %.2f | %.0f | %.0f | %.2f | %.1f |\n",
              path.substr(slash == path.npos ? 0 : slash + 1).c_str(),
              static_cast<long long>(cells), megabytes, megabytes / best[0], megabytes / best[1],
              best[0] / best[1], megabytes / best[2], megabytes / best[3], best[2] / best[3],
              static_cast<double>(peakResidentBytes()) / (1 << 20));
}

double processorSeconds() {
  rusage u;
  ::getrusage(RUSAGE_SELF, &u);
  return static_cast<double>(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

void readOnce(const std::string& path, size_t threads) {
  const double before = processorSeconds();
  double opened = 0;
  double wall_opened = 0;
  const double wall = seconds([&] {
    const Tasks tasks(threads);
    std::unique_ptr<IndexedSource> mesh;
    wall_opened = seconds([&] { mesh = openIndexed(path, &tasks); });
    opened = processorSeconds();
    readColumns(*mesh);
  });
  std::printf("%.4f %.4f %.4f %.4f\n", opened - before, processorSeconds() - before, wall_opened,
              wall);
}

}  // namespace
}  // namespace tetstream

int main(int argc, char** argv) {
  int rounds = 5, first = 1;
  const bool once = argc == 4 && std::strcmp(argv[1], "--once") == 0;
  if (argc > 2 && std::strcmp(argv[1], "--rounds") == 0) {
    rounds = std::atoi(argv[2]);
    first = 3;
  }
  if (!once)
    std::puts(
        "| file | cells | MB | plain MB/s | columns MB/s | columns / plain | uncached plain MB/s | "
        "uncached columns MB/s | columns / plain, uncached | peak MB |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
  try {
    if (once) tetstream::readOnce(argv[3], static_cast<size_t>(std::atoi(argv[2])));
    for (int i = first; i < argc && !once; ++i) tetstream::measure(argv[i], rounds);
  } catch (const tetstream::Error& error) {
    std::fprintf(stderr, "reading: %s\n", error.text().c_str());
    return 1;
  }
  return 0;
}
