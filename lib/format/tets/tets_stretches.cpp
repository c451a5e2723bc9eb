#include "tets_stretches.h"

#include <algorithm>

#include "checksum.h"

namespace tetstream::tets {

// A part has at least so many chunks, and at most this share of its cells is read only for the
// vertices that come before its own.
constexpr uint64_t kLeastChunks = 4;
constexpr double kMostOfOthers = 0.5;

// An index section, which ends before byte `end`: adds what it tells of its chunks, the last one
// first, and gives the place of the section before. False if it is not as it should be.
static bool readIndexAt(ByteSource& bytes, uint64_t place, uint64_t end, uint64_t* previous,
                        std::vector<IndexEntry>& chunks) {
  SectionHead head;
  if (place >= end || end - place < sizeof head ||
      bytes.readAt(place, &head, sizeof head) != sizeof head || faultOf(head) || !head.is(kIndex) ||
      head.length < sizeof head || head.length > end - place)
    return false;
  const IndexOwn own = head.get<IndexOwn>();
  if (head.value == 0 || head.value > kIndexEntries || own.entry_bytes < sizeof(IndexEntry) ||
      own.entry_bytes > kMaxEntryBytes || !bodyHolds(head, size_t{head.value} * own.entry_bytes))
    return false;
  std::vector<unsigned char> body(static_cast<size_t>(head.length - sizeof head));
  if (bytes.readAt(place + sizeof head, body.data(), body.size()) != body.size() ||
      checksum(0, body.data(), body.size()) != head.body_checksum)
    return false;
  for (size_t i = head.value; i-- > 0;) {
    chunks.emplace_back();
    std::memcpy(&chunks.back(), body.data() + i * own.entry_bytes, sizeof(IndexEntry));
  }
  *previous = own.previous;
  return true;
}

// Within the `size` bytes of a file.
static bool followEachOther(const std::vector<IndexEntry>& chunks, uint64_t size) {
  uint64_t vertices = 0, cells = 0, end = sizeof(SectionHead);
  for (const IndexEntry& chunk : chunks) {
    if (chunk.first_vertex != vertices || chunk.first_cell != cells || chunk.offset < end ||
        chunk.offset > size || chunk.length < sizeof(SectionHead) ||
        chunk.length > size - chunk.offset)
      return false;
    vertices += chunk.vertices;
    cells += chunk.cells;
    end = chunk.offset + chunk.length;
  }
  return true;
}

std::vector<IndexEntry> readIndex(ByteSource& bytes) {
  SectionHead head;
  const uint64_t size = bytes.size();
  if (size < sizeof head || bytes.readAt(size - sizeof head, &head, sizeof head) != sizeof head ||
      faultOf(head) || !head.is(kEnd))
    return {};
  std::vector<IndexEntry> chunks;  // from the last one on
  for (uint64_t place = head.get<EndOwn>().last_index, end = size, before = 0; place != 0;) {
    if (!readIndexAt(bytes, place, end, &before, chunks)) return {};
    end = place;
    place = before;
  }
  std::reverse(chunks.begin(), chunks.end());
  return followEachOther(chunks, size) ? chunks : std::vector<IndexEntry>();
}

// The first chunk for which it holds, as it does for all that follow.
template <class Holds>
static uint64_t firstThat(const std::vector<IndexEntry>& chunks, Holds holds) {
  const auto fails = [&](const IndexEntry& chunk) { return !holds(chunk); };
  return static_cast<uint64_t>(std::partition_point(chunks.begin(), chunks.end(), fails) -
                               chunks.begin());
}

// Its own chunks are [own, end).
static ChunkRange rangeOf(const std::vector<IndexEntry>& chunks, uint64_t own, uint64_t end,
                          uint64_t before) {
  const uint64_t own_vertex = chunks[own].first_vertex;
  const uint64_t least = own_vertex - std::min(before, own_vertex);
  const uint64_t first = std::min(own, firstThat(chunks, [least](const IndexEntry& chunk) {
                                    return chunk.first_vertex + chunk.vertices > least;
                                  }));
  const IndexEntry& chunk = chunks[first];
  return {first,
          end,
          chunk.offset,
          chunk.first_vertex,
          chunk.first_cell,
          own_vertex,
          chunks[own].first_cell};
}

std::vector<ChunkRange> cutChunks(const std::vector<IndexEntry>& chunks, size_t most,
                                  uint64_t before) {
  const uint64_t parts = std::min<uint64_t>(most, chunks.size() / kLeastChunks);
  if (parts < 2) return {};
  const IndexEntry& last = chunks.back();
  const auto cells = static_cast<double>(last.first_cell + last.cells);
  const auto vertices = static_cast<double>(last.first_vertex + last.vertices);
  const auto count = static_cast<double>(parts);
  // What comes before a part's own, in cells.
  const double others = cells * std::min(static_cast<double>(before) / vertices, 1.0);
  const double part = (cells + (count - 1) * others) / count;
  if (others > kMostOfOthers * part) return cutChunks(chunks, parts - 1, before);
  std::vector<ChunkRange> ranges;
  for (uint64_t k = 0, own = 0; k < parts; ++k) {
    const double until = part + static_cast<double>(k) * (part - others);
    const uint64_t end =
        k + 1 == parts ? chunks.size() : firstThat(chunks, [until](const IndexEntry& chunk) {
          return static_cast<double>(chunk.first_cell) >= until;
        });
    if (end <= own) return {};
    ranges.push_back(rangeOf(chunks, own, end, before));
    own = end;
  }
  return ranges;
}

}  // namespace tetstream::tets
