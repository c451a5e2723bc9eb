// structures MESH WINDOW [ROUNDS]: what the data structures cost by themselves, in processor time,
// medians of the rounds, all in turn: the map from ranks to slots on the events of the whole
// stream, and the ways to find the star of a vertex in a window of that many cells.
#include "structures.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <unordered_map>

#include "front.h"
#include "ordered_source.h"
#include "registry.h"
#include "status.h"

namespace tetstream::bench {
namespace {

void record(const BatchView& batch, Recording& to) {
  const size_t numbers = 3 * batch.vertex_count, place = to.positions.size();
  to.positions.resize(place + numbers);
  if (numbers)
    convertScalars(batch.positions, to.schema.position_type, to.positions.data() + place,
                   ScalarType::kFloat32, numbers);
  to.vertices += batch.vertex_count;
  for (size_t i = 0; i < 4 * batch.cell_count; ++i)
    to.cells.push_back(static_cast<uint32_t>(batch.cells[i]));
  for (size_t c = 0; c < batch.cell_count; ++c)
    to.last_uses.push_back(batch.last_uses ? batch.last_uses[c] : 0);
  for (size_t i = 0; i < batch.finalized_count; ++i)
    to.finalized.emplace_back(to.cellCount(), static_cast<uint32_t>(batch.finalized[i]));
}

Recording recordingOf(const char* path) {
  Input input = needFormat("", path).open(openFile(path), {});
  std::unique_ptr<Source> ordered;
  if (!input.stream) ordered = std::make_unique<OrderedSource>(*input.indexed, OrderOptions());
  Source& source = ordered ? *ordered : *input.stream;
  Recording recording;
  recording.schema = source.schema();
  BatchView batch;
  while (source.next(batch)) record(batch, recording);
  if (recording.cellCount() == 0) fail(Status::kBadData, "there are no cells in %s", path);
  return recording;
}

// Takes what the standard containers take from an account.
template <class T>
struct Accounted {
  using value_type = T;
  explicit Accounted(Account& the_account) : account(&the_account) {}
  template <class U>
  Accounted(const Accounted<U>& other) : account(other.account) {}
  T* allocate(size_t count) {
    account->charge(count * sizeof(T));
    return std::allocator<T>().allocate(count);
  }
  void deallocate(T* at, size_t count) {
    account->release(count * sizeof(T));
    std::allocator<T>().deallocate(at, count);
  }
  template <class U>
  bool operator==(const Accounted<U>& other) const {
    return account == other.account;
  }
  Account* account;
};

// The same as a Front, with the hash of the standard library.
class Hash {
 public:
  Hash(Account& account, uint64_t expected) : map_(Entries(account)) { map_.reserve(expected); }
  void introduce(uint32_t slot) { map_.emplace(next_++, slot); }
  uint64_t introduced() const { return next_; }
  uint32_t find(uint64_t vertex) const {
    const auto found = map_.find(vertex);
    return found == map_.end() ? kNoSlot : found->second;
  }
  void finalize(uint64_t vertex) { map_.erase(vertex); }

 private:
  using Entries = Accounted<std::pair<const uint64_t, uint32_t>>;
  uint64_t next_ = 0;
  std::unordered_map<uint64_t, uint32_t, std::hash<uint64_t>, std::equal_to<uint64_t>, Entries>
      map_;
};

template <class Map>
void introduceUpTo(Map& map, uint64_t vertex) {
  while (map.introduced() <= vertex) map.introduce(static_cast<uint32_t>(map.introduced()));
}

// Returns the sum of the slots found, which is that of the ranks.
template <class Map>
uint64_t replay(const Recording& stream, Map& map) {
  uint64_t sum = 0;
  auto explicit_one = stream.finalized.begin();
  for (size_t c = 0; c < stream.cellCount(); ++c) {
    const uint32_t* v = &stream.cells[4 * c];
    for (int j = 0; j < 4; ++j) {
      introduceUpTo(map, v[j]);
      sum += map.find(v[j]);
    }
    for (int j = 0; j < 4; ++j)
      if (stream.last_uses[c] >> j & 1) map.finalize(v[j]);
    for (; explicit_one != stream.finalized.end() && explicit_one->first == c + 1; ++explicit_one) {
      introduceUpTo(map, explicit_one->second);
      map.finalize(explicit_one->second);
    }
  }
  return sum;
}

struct MapTimes {
  std::vector<double> ns;
  size_t bytes = 0;
};

template <class Map>
void timeMap(const Recording& stream, uint64_t expected, MapTimes& times) {
  uint64_t sum = 0;
  Account account;
  times.ns.push_back(nsOf([&] {
    Map map(account, expected);
    sum = replay(stream, map);
  }));
  times.bytes = account.peak();
  for (uint32_t v : stream.cells) sum -= v;
  if (sum != 0) fail(Status::kBadData, "a map found another slot than was introduced");
}

void printMap(const char* name, const Recording& stream, const MapTimes& times) {
  std::printf("| %s | %.1f | %.0f |\n", name,
              median(times.ns) / static_cast<double>(stream.cellCount()),
              static_cast<double>(times.bytes) / 1024);
}

}  // namespace

void compareMaps(const Recording& stream, int rounds) {
  Account account;
  Front front(account);
  replay(stream, front);
  const auto span = static_cast<uint64_t>(std::min<int64_t>(front.span(), 1 << 20));
  const auto width = static_cast<uint64_t>(front.width());
  MapTimes ring, growing_ring, hash, growing_hash;
  for (int i = 0; i < rounds; ++i) {
    timeMap<Front>(stream, span, ring);
    timeMap<Front>(stream, 0, growing_ring);
    timeMap<Hash>(stream, width, hash);
    timeMap<Hash>(stream, 0, growing_hash);
  }
  std::printf("%zu cells, %llu vertices; front: width %lld, span %lld\n\n", stream.cellCount(),
              static_cast<unsigned long long>(stream.vertices),
              static_cast<long long>(front.width()), static_cast<long long>(front.span()));
  std::printf("| map | ns / cell | peak KB |\n| --- | --- | --- |\n");
  printMap("circular array, span known", stream, ring);
  printMap("circular array, growing", stream, growing_ring);
  printMap("hash, width known", stream, hash);
  printMap("hash, growing", stream, growing_hash);
}

}  // namespace tetstream::bench

int main(int argc, char** argv) {
  const long window = argc > 2 ? std::atol(argv[2]) : 0;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 9;
  if (argc > 4 || window < 1 || rounds < 1) {
    std::fputs("usage: structures MESH WINDOW [ROUNDS]\n", stderr);
    return 1;
  }
  try {
    const auto stream = tetstream::bench::recordingOf(argv[1]);
    tetstream::bench::compareMaps(stream, rounds);
    std::puts("");
    tetstream::bench::compareStars(stream, static_cast<size_t>(window), rounds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "structures: %s\n", error.what());
    return 1;
  }
  return 0;
}
