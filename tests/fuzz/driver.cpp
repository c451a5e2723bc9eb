// Runs a fuzz target without libFuzzer: on files, on all files of folders, and, with -runs=N, on N
// changed ones. The same seed gives the same runs. What a target was working on when it died lies
// in ./crash-TARGET, as a block of memory larger than -malloc_limit_mb does.
//   TARGET [-runs=N] [-seed=N] [-dict=FILE] [-max_len=N] [-malloc_limit_mb=N] FILE|FOLDER...
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "driver_memory.h"

extern "C" {
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t capacity);
// Of targets that have one.
__attribute__((weak)) size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t capacity,
                                                     unsigned seed);
}

namespace {

using Bytes = std::vector<uint8_t>;

struct Settings {
  long runs = 0;
  uint64_t seed = 1;
  size_t max_len = 1 << 16;
  std::vector<std::string> paths;
};

uint64_t random_state = 1;
std::vector<Bytes> words, seeds;
std::string program;

// splitmix64
uint64_t draw() {
  uint64_t z = random_state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

size_t drawBelow(size_t end) {
  return end ? static_cast<size_t>(draw() % end) : 0;
}

// ------------------------------------------------------------------------------ what is changed

// Numbers at which something may break, in 1 to 8 bytes.
void putNumber(uint8_t* data, size_t size) {
  static constexpr uint64_t kNumbers[] = {0,
                                          1,
                                          2,
                                          3,
                                          4,
                                          0x7f,
                                          0x80,
                                          0xff,
                                          0x7fff,
                                          0x8000,
                                          0xffff,
                                          0x7fffffff,
                                          0x80000000,
                                          0xffffffff,
                                          uint64_t{1} << 60,
                                          INT64_MAX,
                                          uint64_t{1} << 63,
                                          UINT64_MAX};
  const size_t width = size_t{1} << drawBelow(4);
  if (width > size) return;
  const uint64_t number = kNumbers[drawBelow(std::size(kNumbers))];
  std::memcpy(data + drawBelow(size - width + 1), &number, width);
}

// Another piece in the place of one.
size_t splice(uint8_t* data, size_t size, size_t capacity, const uint8_t* piece, size_t length) {
  const size_t at = drawBelow(size + 1), cut = drawBelow(2) ? drawBelow(size - at + 1) % 64 : 0;
  if (size - cut + length > capacity) return size;
  std::memmove(data + at + length, data + at + cut, size - at - cut);
  if (length) std::memcpy(data + at, piece, length);
  return size - cut + length;
}

size_t changeOnce(uint8_t* data, size_t size, size_t capacity) {
  Bytes piece;
  switch (drawBelow(8)) {
    case 0:
      if (size) data[drawBelow(size)] ^= static_cast<uint8_t>(1u << drawBelow(8));
      return size;
    case 1:
      if (size) data[drawBelow(size)] = static_cast<uint8_t>(draw());
      return size;
    case 2:
      putNumber(data, size);
      return size;
    case 3:  // cut off
      return drawBelow(4) ? size : drawBelow(size + 1);
    case 4:  // twice
      if (size) {
        const size_t at = drawBelow(size);
        piece.assign(data + at, data + at + drawBelow(size - at) % 256);
      }
      break;
    case 5:
      if (!words.empty()) piece = words[drawBelow(words.size())];
      break;
    case 6: {
      const std::string number = std::to_string(static_cast<int64_t>(draw() >> drawBelow(64)));
      piece.assign(number.begin(), number.end());
      break;
    }
    default:
      if (!seeds.empty()) {
        const Bytes& other = seeds[drawBelow(seeds.size())];
        const size_t at = drawBelow(other.size());
        piece.assign(other.begin() + static_cast<long>(at),
                     other.begin() + static_cast<long>(at + drawBelow(other.size() - at) % 512));
      }
  }
  return splice(data, size, capacity, piece.data(), piece.size());
}

// ------------------------------------------------------------------------------------- running

const Bytes* current = nullptr;

// Only what a signal's handler may do.
void keepCurrent(int signal) {
  const std::string path = "crash-" + program;
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (fd >= 0 && current) {
    if (::write(fd, current->data(), current->size()) < 0) _exit(1);
    ::close(fd);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// A block of its own, of just that size.
void runOn(const Bytes& bytes) {
  const Bytes exact(bytes);
  current = &exact;
  fuzz::watchAllocations(true);
  LLVMFuzzerTestOneInput(exact.data(), exact.size());
  fuzz::watchAllocations(false);
  current = nullptr;
}

Bytes readFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

void addSeeds(const std::string& path) {
  if (!std::filesystem::is_directory(path)) {
    seeds.push_back(readFile(path));
    return;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());  // for the same runs everywhere
  for (const auto& file : files) seeds.push_back(readFile(file));
}

// Lines NAME="word" of libFuzzer's dictionaries, with \xHH, \\ and \".
void readWords(const std::string& path) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const size_t begin = line.find('"'), end = line.rfind('"');
    if (line.empty() || line[0] == '#' || begin == end) continue;
    Bytes word;
    for (size_t i = begin + 1; i < end; ++i) {
      if (line[i] == '\\' && line[i + 1] == 'x') {
        word.push_back(static_cast<uint8_t>(std::stoi(line.substr(i + 2, 2), nullptr, 16)));
        i += 3;
      } else {
        if (line[i] == '\\') ++i;
        word.push_back(static_cast<uint8_t>(line[i]));
      }
    }
    words.push_back(word);
  }
}

Settings readArguments(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const size_t sign = word.find('=');
    const std::string name = word.substr(0, sign);
    const char* value = sign == std::string::npos ? "" : argv[i] + sign + 1;
    if (name == "-runs")
      settings.runs = std::atol(value);
    else if (name == "-seed")
      settings.seed = std::strtoull(value, nullptr, 10);
    else if (name == "-dict")
      readWords(value);
    else if (name == "-max_len")
      settings.max_len = std::strtoul(value, nullptr, 10);
    else if (name == "-malloc_limit_mb")
      fuzz::limitAllocations(std::strtoul(value, nullptr, 10) << 20);
    else
      settings.paths.push_back(word);
  }
  return settings;
}

void runChanged(const Settings& settings) {
  Bytes changed;
  for (long run = 0; run < settings.runs; ++run) {
    random_state = settings.seed + static_cast<uint64_t>(run) * 1000003;
    changed = seeds.empty() ? Bytes() : seeds[drawBelow(seeds.size())];
    size_t size = std::min(changed.size(), settings.max_len);
    changed.resize(settings.max_len);
    if (LLVMFuzzerCustomMutator)
      size = LLVMFuzzerCustomMutator(changed.data(), size, changed.size(),
                                     static_cast<unsigned>(draw()));
    else
      size = LLVMFuzzerMutate(changed.data(), size, changed.size());
    changed.resize(size);
    runOn(changed);
  }
}

}  // namespace

size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t capacity) {
  for (size_t left = 1 + drawBelow(4); left > 0; --left) size = changeOnce(data, size, capacity);
  return size;
}

int main(int argc, char** argv) {
  program = std::filesystem::path(argv[0]).filename().string();
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM})
    std::signal(signal, keepCurrent);
  const Settings settings = readArguments(argc, argv);
  for (const std::string& path : settings.paths) addSeeds(path);
  for (const Bytes& seed : seeds) runOn(seed);
  runChanged(settings);
  std::printf("%s: %zu files and %ld changed ones, largest block %zu bytes\n", program.c_str(),
              seeds.size(), settings.runs, fuzz::largestAllocation());
  return 0;
}
