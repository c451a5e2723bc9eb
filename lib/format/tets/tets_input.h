// format/tets: sections of a `.tets` file as they come. Depends on tets_layout.h, bytes.h,
// tets_codec.h.
#pragma once

#include <memory>

#include "bytes.h"
#include "memory.h"
#include "tets_layout.h"

namespace tetstream::tets {

// Reads sections from front to back and checks both checksums; messages name the place.
class SectionReader {
 public:
  explicit SectionReader(std::unique_ptr<ByteSource> bytes);

  // The next head. Then one of the two below, before the next one.
  const SectionHead& next();
  const unsigned char* body();  // the whole body, valid until the next call
  void skipBody();              // reads and checks it without keeping it

  const SectionHead& head() const { return head_; }
  size_t bodyBytes() const { return static_cast<size_t>(head_.length - sizeof head_); }
  uint64_t at() const { return section_at_; }  // where the section begins
  uint64_t offset() const { return offset_; }  // what was read so far
  ByteSource& bytes() { return *bytes_; }
  const std::string& name() const { return bytes_->name(); }
  // After a section that cannot be read: goes on with the next one that has a head, and of which
  // `rank` is higher; false if there is none. Seekable input only.
  bool resume();

  // Goes on with the section there, before which so many chunks stand. Seekable input only.
  void goTo(uint64_t place, uint64_t chunks);

  // Chunks are counted, for messages.
  void countChunk() { ++chunks_; }
  uint64_t chunks() const { return chunks_; }
  // "FILE: chunk 3 at byte 4096"
  std::string place() const;

 private:
  void readFully(void* out, size_t size);
  bool headAt(uint64_t place, SectionHead* head) const;
  bool findHead(uint64_t place, uint64_t* found, SectionHead* head) const;
  [[noreturn]] void failTruncated() const;
  void checkBody(uint32_t sum) const;

  std::unique_ptr<ByteSource> bytes_;
  SectionHead head_ = {};
  bool in_head_ = true, resumed_ = false;
  uint64_t section_at_ = 0, offset_ = 0, sections_ = 0, chunks_ = 0;
  Account account_;
  Array<unsigned char> body_;
};

// The schema that the first section tells. Throws kBadData, and kUnsupported for versions to come.
Schema readHeader(SectionReader& in);

// Before a chunk's body is read: sets the shape to what the head tells of it, and returns by which
// codec it is stored. Throws for what the head claims that cannot be, or that nobody here knows.
uint32_t setShape(const SectionReader& in, const Schema& schema, ChunkShape& shape);

// What the end of a seekable file tells before its events are read: the totals and the box, where
// the header does not have them. Throws kBadData, naming the place, if the file has no end.
void completeFromEnd(ByteSource& bytes, Schema& schema);

// Reads totals and box from a body of totalsBytes(schema).
Totals decodeTotals(const Schema& schema, const unsigned char* body, Box* box);

}  // namespace tetstream::tets
