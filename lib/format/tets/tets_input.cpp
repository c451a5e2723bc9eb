#include "tets_input.h"

#include <algorithm>

#include "checksum.h"
#include "status.h"
#include "tets_codec.h"

namespace tetstream::tets {

using ull = unsigned long long;

// How much is asked for at once where the length of the input is not known.
static constexpr size_t kStep = size_t{1} << 20;

// "section 2" or, for a chunk, "chunk 1"; `id` null: the head was not read.
static std::string sectionName(const char* id, uint64_t rank, uint64_t chunks) {
  if (id && std::memcmp(id, kChunk, 4) == 0) return textOf("chunk %llu", ull{chunks});
  if (id && std::memcmp(id, kHeader, 4) == 0) return "the header";
  return textOf("section %llu (%llu chunks stand before)", ull{rank}, ull{chunks});
}

SectionReader::SectionReader(std::unique_ptr<ByteSource> bytes)
    : bytes_(std::move(bytes)), body_(account_) {}

std::string SectionReader::place() const {
  return textOf("%s: %s at byte %llu", name().c_str(),
                sectionName(in_head_ ? nullptr : head_.id, sections_, chunks_).c_str(),
                ull{section_at_});
}

void SectionReader::failTruncated() const {
  if (offset_ == 0) fail(Status::kBadData, "%s: is empty, not a .tets stream", name().c_str());
  if (offset_ == section_at_)
    fail(Status::kBadData, "%s: ends at byte %llu, after %llu chunks, without an end marker",
         name().c_str(), ull{offset_}, ull{chunks_});
  fail(Status::kBadData, "%s: ends at byte %llu inside %s, which begins at byte %llu",
       name().c_str(), ull{offset_},
       sectionName(in_head_ ? nullptr : head_.id, sections_, chunks_).c_str(), ull{section_at_});
}

void SectionReader::readFully(void* out, size_t size) {
  unsigned char* to = static_cast<unsigned char*>(out);
  while (size > 0) {
    const size_t got = resumed_ ? bytes_->readAt(offset_, to, size) : bytes_->read(to, size);
    if (got == 0) failTruncated();
    to += got;
    size -= got;
    offset_ += got;
  }
}

const SectionHead& SectionReader::next() {
  if (offset_ > 0) ++sections_;
  section_at_ = offset_;
  in_head_ = true;
  readFully(&head_, sizeof head_);
  if (const char* fault = faultOf(head_)) {
    if (section_at_ == 0 && std::memcmp(head_.id, kHeader, 4) != 0)
      fail(Status::kBadData, "%s: is not a .tets stream: its first bytes are not the header's",
           name().c_str());
    fail(Status::kBadData, "%s: its head %s; the file is damaged", place().c_str(), fault);
  }
  in_head_ = false;
  if (head_.rank != sections_)
    fail(Status::kBadData, "%s: it was written as section %llu; sections are missing or swapped",
         place().c_str(), ull{head_.rank});
  return head_;
}

void SectionReader::checkBody(uint32_t sum) const {
  if (sum != head_.body_checksum)
    fail(Status::kBadData, "%s: its %zu bytes do not fit their checksum; the file is damaged",
         place().c_str(), bodyBytes());
}

// The caller has checked the length against what its head says and the limits of the format; on a
// pipe memory still grows only as bytes come.
const unsigned char* SectionReader::body() {
  const size_t size = bodyBytes();
  if (bytes_->seekable() && size > bytes_->size() - std::min(offset_, bytes_->size())) {
    offset_ = bytes_->size();
    failTruncated();
  }
  const size_t step = bytes_->seekable() ? size : kStep;
  for (size_t done = 0; done < size;) {
    const size_t count = std::min(size - done, std::max(step, done));
    body_.makeRoomFor(done + count);
    readFully(body_.data() + done, count);
    done += count;
  }
  checkBody(checksum(0, body_.data(), size));
  return body_.data();
}

void SectionReader::skipBody() {
  uint64_t left = head_.length - sizeof head_;
  uint32_t sum = 0;
  constexpr size_t kSkip = 1 << 16;
  if (body_.size() < kSkip) body_.resize(kSkip);
  while (left > 0) {
    const size_t count = static_cast<size_t>(std::min<uint64_t>(left, kSkip));
    readFully(body_.data(), count);
    sum = checksum(sum, body_.data(), count);
    left -= count;
  }
  checkBody(sum);
}

// A head that is damaged is found so by the next call.
void SectionReader::goTo(uint64_t place, uint64_t chunks) {
  SectionHead head = {};
  bytes_->readAt(place, &head, sizeof head);
  resumed_ = true;
  offset_ = place;
  sections_ = head.rank - 1;
  chunks_ = chunks;
}

// ----------------------------------------------------------------------- of header and chunks

Schema readHeader(SectionReader& in) {
  const SectionHead& head = in.next();
  if (!head.is(kHeader))
    fail(Status::kBadData, "%s: is not a .tets stream: the first section is no header",
         in.name().c_str());
  checkVersion(head, in.name());
  if (head.length > kMaxHeaderBytes)
    fail(Status::kBadData, "%s: the header claims %llu bytes, at most %zu are possible",
         in.name().c_str(), ull{head.length}, kMaxHeaderBytes);
  return decodeHeader(head, in.body(), in.bodyBytes(), in.name());
}

static void checkKnown(const SectionReader& in, uint32_t codec) {
  constexpr uint32_t known =
      kMustUnderstand | kChunkLocked | kChunkLastUses | kChunkWideCells | kCodecMask;
  const uint32_t flags = in.head().flags;
  if (flags & ~known)
    fail(Status::kUnsupported, "%s: it has flags 0x%08x, which this library does not know",
         in.place().c_str(), flags & ~known);
  if (codec != kCodecNone && codec != kCodecZstd)
    fail(Status::kUnsupported,
         "%s: it is compressed by method %u, which this library does not know", in.place().c_str(),
         codec);
  if (codec == kCodecZstd && !Codec::builtIn())
    fail(Status::kUnsupported,
         "%s: it is compressed with zstd, and this library was built without zstd",
         in.place().c_str());
}

uint32_t setShape(const SectionReader& in, const Schema& schema, ChunkShape& shape) {
  const SectionHead& head = in.head();
  const auto counts = head.get<ChunkOwn>();
  const uint32_t codec = (head.flags & kCodecMask) >> kCodecShift;
  shape.set(counts, head.flags);
  checkKnown(in, codec);
  const uint32_t most = std::max({counts.vertices, counts.cells, counts.finalized, counts.faces});
  if (most > kMaxRows || most == 0 || shape.payloadBytes() > kMaxPayload)
    fail(Status::kBadData,
         "%s: it claims %u vertices, %u cells, %u finalizations and %u faces in %zu bytes; each is "
         "at most %u, not all are 0, the bytes at most %zu",
         in.place().c_str(), counts.vertices, counts.cells, counts.finalized, counts.faces,
         shape.payloadBytes(), kMaxRows, kMaxPayload);
  const bool stored_fits =
      codec == kCodecNone ? head.value == shape.payloadBytes() : head.value <= kMaxPayload;
  if (!stored_fits || head.length != sizeof head + chunkStartBytes(schema) + alignUp(head.value))
    fail(Status::kBadData,
         "%s: it has %llu bytes, %u of them columns, which does not fit its counts",
         in.place().c_str(), ull{head.length}, head.value);
  return codec;
}

// ---------------------------------------------------------------------------- after damage

// Whether a section that is not behind the last one begins there.
bool SectionReader::headAt(uint64_t place, SectionHead* head) const {
  const bool had_it = !in_head_ && head_.rank == sections_;
  return bytes_->readAt(place, head, sizeof *head) == sizeof *head && !faultOf(*head) &&
         head->rank >= sections_ + had_it;
}

// The first one from `place` on. Where bytes are missing or too many it is on no multiple of 64.
bool SectionReader::findHead(uint64_t place, uint64_t* found, SectionHead* head) const {
  constexpr size_t kBlock = 1 << 16;
  const SectionHead any = makeHead(kChunk, 0);
  const unsigned char* const marker = any.marker;
  std::vector<unsigned char> block(kBlock);
  for (;; place += kBlock - sizeof head->marker) {
    const size_t got = bytes_->readAt(place, block.data(), block.size());
    if (got < sizeof *head) return false;
    for (auto at = block.begin(), end = at + static_cast<ptrdiff_t>(got);; ++at) {
      at = std::search(at, end, marker, marker + sizeof head->marker);
      if (at == end) break;
      *found = place + static_cast<uint64_t>(at - block.begin());
      if (headAt(*found, head)) return true;
    }
    if (got < block.size()) return false;
  }
}

bool SectionReader::resume() {
  resumed_ = true;
  SectionHead head;
  uint64_t found = section_at_;  // of a later section than the one that should stand there
  if (!headAt(found, &head)) {
    // Where the head is whole its section most likely has its length.
    found = section_at_ + head_.length;
    if ((in_head_ || head_.length > bytes_->size() || !headAt(found, &head)) &&
        !findHead(section_at_ + 1, &found, &head))
      return false;
  }
  offset_ = found;
  chunks_ += head.rank - sections_;  // as most of the sections that are passed over are
  sections_ = head.rank - 1;
  return true;
}

// ------------------------------------------------------------------------------ from the end

// Goes from head to head to say where a file without a proper end breaks off. The sequential reader
// would find the same, but only after all the work.
[[noreturn]] static void failWithoutEnd(ByteSource& bytes) {
  const std::string& name = bytes.name();
  const uint64_t size = bytes.size();
  uint64_t at = 0, chunks = 0;
  for (uint64_t rank = 0; at < size; ++rank) {
    SectionHead head;
    const size_t got = bytes.readAt(at, &head, sizeof head);
    if (got < sizeof head)
      fail(Status::kBadData, "%s: ends at byte %llu inside %s, which begins at byte %llu",
           name.c_str(), ull{size}, sectionName(nullptr, rank, chunks).c_str(), ull{at});
    if (const char* fault = faultOf(head))
      fail(Status::kBadData, "%s: %s at byte %llu: its head %s; the file is damaged", name.c_str(),
           sectionName(nullptr, rank, chunks).c_str(), ull{at}, fault);
    if (head.length > size - at)
      fail(Status::kBadData, "%s: ends at byte %llu inside %s, which begins at byte %llu",
           name.c_str(), ull{size}, sectionName(head.id, rank, chunks).c_str(), ull{at});
    at += head.length;
    if (head.is(kEnd) && at < size)
      fail(Status::kBadData, "%s: bytes follow the end marker, from byte %llu on", name.c_str(),
           ull{at});
    if (head.is(kChunk)) ++chunks;
  }
  fail(Status::kBadData, "%s: ends at byte %llu, after %llu chunks, without an end marker",
       name.c_str(), ull{size}, ull{chunks});
}

Totals decodeTotals(const Schema& schema, const unsigned char* body, Box* box) {
  Totals totals;
  const size_t box_bytes = schema.boxSize() * sizeof(double);
  std::memcpy(&totals, body, sizeof totals);
  std::memcpy(box->min.data(), body + sizeof totals, box_bytes);
  std::memcpy(box->max.data(), body + sizeof totals + box_bytes, box_bytes);
  return totals;
}

// Gives the totals that the end marker points to; false if something is not as it should be.
static bool readTotals(ByteSource& bytes, const Schema& schema, Totals* totals, Box* box) {
  SectionHead end, head;
  const uint64_t size = bytes.size();
  if (size < 2 * sizeof end || bytes.readAt(size - sizeof end, &end, sizeof end) != sizeof end ||
      faultOf(end) || !end.is(kEnd))
    return false;
  const EndOwn own = end.get<EndOwn>();
  if (own.file_bytes != size || own.totals > size - sizeof head ||
      bytes.readAt(own.totals, &head, sizeof head) != sizeof head || faultOf(head) ||
      !head.is(kTotals) || !bodyHolds(head, totalsBytes(schema)))
    return false;
  std::vector<unsigned char> body(static_cast<size_t>(head.length - sizeof head));
  if (bytes.readAt(own.totals + sizeof head, body.data(), body.size()) != body.size() ||
      checksum(0, body.data(), body.size()) != head.body_checksum)
    return false;
  *totals = decodeTotals(schema, body.data(), box);
  return true;
}

void completeFromEnd(ByteSource& bytes, Schema& schema) {
  Totals totals;
  Box box(schema.boxSize());
  // Totals that are damaged in a file that is whole otherwise are left to the sequential reader.
  if (!readTotals(bytes, schema, &totals, &box)) {
    SectionHead end;
    const uint64_t at = bytes.size() - std::min<uint64_t>(bytes.size(), sizeof end);
    const bool whole = bytes.readAt(at, &end, sizeof end) == sizeof end && !faultOf(end) &&
                       end.is(kEnd) && end.get<EndOwn>().file_bytes == bytes.size();
    if (!whole) failWithoutEnd(bytes);
    return;
  }
  const auto complete = [](int64_t& value, int64_t known) {
    if (value < 0 && known >= 0) value = known;
  };
  if ((schema.vertex_count >= 0 && schema.vertex_count != totals.vertices) ||
      (schema.cell_count >= 0 && schema.cell_count != totals.cells))
    fail(Status::kBadData,
         "%s: the header has %lld vertices and %lld cells, the totals at its end %lld and %lld",
         bytes.name().c_str(), static_cast<long long>(schema.vertex_count),
         static_cast<long long>(schema.cell_count), static_cast<long long>(totals.vertices),
         static_cast<long long>(totals.cells));
  complete(schema.vertex_count, totals.vertices);
  complete(schema.cell_count, totals.cells);
  complete(schema.front_width, totals.front_width);
  complete(schema.front_span, totals.front_span);
  complete(schema.front_cells, totals.front_cells);
  if (!schema.hasBox() && totals.vertices > 0) {
    schema.box_min = box.min;
    schema.box_max = box.max;
  }
}

}  // namespace tetstream::tets
