// format/tets: the bytes of `.tets`, as reader and writer share them; tetstream-formats(5) has the
// tables. Depends on schema.h, status.h.
//
// A file is a row of sections. Each has a head of 64 bytes with its own checksum and a body with
// another one, and is a multiple of 64 bytes long, so that every column of an uncompressed chunk
// stands on a multiple of 64 in the file and can be used where it lies. All numbers are little
// endian; the structs below are the bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "memory.h"
#include "schema.h"

namespace tetstream::tets {

constexpr bool kHostFits = std::endian::native == std::endian::little;
constexpr uint32_t kVersion = 1;
constexpr uint32_t kByteOrderMark = 0x01020304;
constexpr size_t kAlign = 64;

// Limits of the format. They bound what a reader allocates for a chunk that lies about its size.
constexpr uint32_t kMaxRows = 65536;              // of each kind in one chunk
constexpr size_t kMaxPayload = size_t{64} << 20;  // bytes of a chunk's columns
constexpr uint32_t kMaxColumns = 1024;            // fields; cell arrays
constexpr size_t kMaxHeaderBytes = 1 << 20;       // the header section
constexpr size_t kMaxEntryBytes = 1024;           // of an index entry, with what later versions add
constexpr uint32_t kIndexEntries = 1024;          // of one index section

// As many zeros; a vector that grows by itself would take twice the room.
inline void makeZeros(std::vector<unsigned char>& bytes, size_t count) {
  bytes.clear();
  if (count > bytes.capacity()) {
    bytes = {};
    bytes.reserve(count + count / 8);
    askForPages(bytes.data(), count);
  }
  bytes.resize(count);
}

constexpr size_t alignUp(size_t bytes) {
  return (bytes + (kAlign - 1)) & ~(kAlign - 1);
}

inline void append(std::vector<unsigned char>& out, const void* data, size_t bytes) {
  const unsigned char* in = static_cast<const unsigned char*>(data);
  out.insert(out.end(), in, in + bytes);
}

// ------------------------------------------------------------------------------ section heads

constexpr char kHeader[] = "HEAD", kChunk[] = "CHNK", kIndex[] = "INDX", kTotals[] = "STAT",
               kEnd[] = "END ";

constexpr uint32_t kMustUnderstand = 1;  // flag of any section: who does not know it must stop

constexpr uint32_t kChunkLocked = 1u << 8;  // flags of chunks
constexpr uint32_t kChunkLastUses = 1u << 9;
constexpr uint32_t kChunkWideCells = 1u << 10;  // int64 ids; else int32, minus the first vertex
constexpr uint32_t kCodecShift = 16, kCodecMask = 0xffu << kCodecShift;
constexpr uint32_t kCodecNone = 0, kCodecZstd = 1;

struct SectionHead {
  unsigned char marker[4];
  char id[4];
  uint64_t length;  // of the whole section, a multiple of 64
  uint64_t rank;    // of the section in the file
  uint32_t flags;
  uint32_t value;  // header: version; chunk: stored bytes of the columns; index: entries
  unsigned char own[24];
  uint32_t body_checksum;  // CRC-32 of the bytes after the head
  uint32_t head_checksum;  // CRC-32 of the bytes before

  bool is(const char* name) const { return std::memcmp(id, name, 4) == 0; }
  template <class T>
  T get() const {
    static_assert(sizeof(T) == sizeof own);
    T out;
    std::memcpy(&out, own, sizeof out);
    return out;
  }
  template <class T>
  void set(const T& in) {
    static_assert(sizeof(T) == sizeof own);
    std::memcpy(own, &in, sizeof in);
  }
};
static_assert(sizeof(SectionHead) == kAlign);

struct HeaderOwn {
  uint32_t byte_order, position_type, fields, cell_arrays;
  uint32_t box_offset;   // in the body
  uint32_t label_names;  // behind the box
};
struct ChunkOwn {
  uint64_t first_vertex;
  uint32_t vertices, cells, finalized, faces;
};
struct IndexOwn {
  uint64_t previous;  // byte of the index section before; 0: none
  uint64_t first_chunk;
  uint32_t entry_bytes, reserved;
};
struct EndOwn {
  uint64_t totals, last_index, file_bytes;  // bytes; last_index 0: none
};

SectionHead makeHead(const char* id, uint32_t flags);
// Sets length, rank and both checksums, and puts the head before the body: `section` is 64 bytes of
// room and the body, padded here to a multiple of 64.
void seal(SectionHead& head, uint64_t rank, std::vector<unsigned char>& section);
// Whether the body is long enough for `bytes` and not absurdly longer: later versions may append.
inline bool bodyHolds(const SectionHead& head, size_t bytes) {
  return head.length - sizeof head >= bytes && head.length <= bytes + kMaxHeaderBytes;
}
// What is wrong with a head, in words that go on from "its head "; null: nothing.
const char* faultOf(const SectionHead& head);

// ---------------------------------------------------------------------------------- the bodies

struct HeaderStart {  // then a record per field, per cell array, the box, a record per label name
  int64_t vertices, cells, front_width, front_span, front_cells;  // -1: not known
  uint32_t box_known, time_known;
  int64_t faces;  // labelled; 0: none, or not known
  double time;
};
static_assert(sizeof(HeaderStart) == 64);

struct ColumnRecord {  // then the name, then zeros up to record_bytes
  uint32_t record_bytes, type, components, name_bytes;
};

struct LabelNameRecord {  // then the name, then zeros up to record_bytes
  uint32_t record_bytes, name_bytes;
  int32_t array;  // which cell array; -1: labelled faces
  uint32_t reserved;
  int64_t label;
};
static_assert(sizeof(LabelNameRecord) == 24);

struct ChunkStart {  // then the box: minima, maxima; zeros up to 64; then the columns
  uint64_t first_cell, reserved;
};

struct IndexEntry {
  uint64_t offset, length, first_vertex, first_cell;
  uint32_t vertices, cells, finalized, faces;
  double box_min[3], box_max[3];
};
static_assert(sizeof(IndexEntry) == 96);

struct Totals {  // then the box
  int64_t vertices, cells, finalized, faces, chunks, front_width, front_span, front_cells;
};
static_assert(sizeof(Totals) == 64);

std::vector<unsigned char> encodeHeader(const Schema& schema);
// Of the names of labels, in their order, those for which the header has room.
size_t labelNamesThatFit(const Schema& schema);
// Throws kUnsupported for a version from the future. To be asked before anything else of the
// header.
void checkVersion(const SectionHead& head, const std::string& name);
// The header's section -> schema. Throws kBadData; `name` is the file's.
Schema decodeHeader(const SectionHead& head, const unsigned char* body, size_t size,
                    const std::string& name);

inline size_t chunkStartBytes(const Schema& schema) {
  return alignUp(sizeof(ChunkStart) + 2 * sizeof(double) * schema.boxSize());
}
inline size_t totalsBytes(const Schema& schema) {
  return alignUp(sizeof(Totals) + 2 * sizeof(double) * schema.boxSize());
}

// A box that grows; empty: +inf, -inf.
struct Box {
  std::vector<double> min, max;
  explicit Box(size_t size);
  void clear();
  void add(const Box& other);
};

// ------------------------------------------------------------------------ the columns of a chunk

struct ColumnPlace {
  size_t offset = 0;  // in the payload, a multiple of 64
  size_t bytes = 0;   // without padding; 0: the chunk has no such column
  size_t rows = 0;
  uint32_t components = 1;
  uint32_t width = 1;  // bytes of one number
  bool ids = false;    // vertex ids: the codec stores differences
  size_t bytesPerRow() const { return size_t{components} * width; }
};

// Where the columns of a chunk stand: always in this order, each on a multiple of 64.
class ChunkShape {
 public:
  explicit ChunkShape(const Schema& schema);
  void set(const ChunkOwn& counts, uint32_t flags);

  size_t positions() const { return 0; }
  size_t field(size_t i) const { return 1 + i; }
  size_t locked() const { return 1 + fields_; }
  size_t cells() const { return 2 + fields_; }
  size_t lastUses() const { return 3 + fields_; }
  size_t cellArray(size_t i) const { return 4 + fields_ + i; }
  size_t finalized() const { return 4 + fields_ + cell_arrays_; }
  size_t finalizedAfter() const { return 5 + fields_ + cell_arrays_; }
  size_t faces() const { return 6 + fields_ + cell_arrays_; }
  size_t faceLabels() const { return 7 + fields_ + cell_arrays_; }
  size_t facesAfter() const { return 8 + fields_ + cell_arrays_; }

  const std::vector<ColumnPlace>& columns() const { return columns_; }
  const ColumnPlace& operator[](size_t column) const { return columns_[column]; }
  size_t payloadBytes() const { return payload_bytes_; }

 private:
  size_t fields_, cell_arrays_, payload_bytes_ = 0;
  std::vector<ColumnPlace> columns_;
};

}  // namespace tetstream::tets
