// Changes `.tets` files and, as a rule, makes their checksums right again: what is behind them is
// to be tried, too.
#include <cstdint>
#include <cstring>
#include <vector>

#include "checksum.h"
#include "tets_layout.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t capacity);

namespace {

using tetstream::tets::SectionHead;

// Calls take(head's place, length) for section after section, as far as their lengths make sense.
template <class Take>
void eachSection(const uint8_t* data, size_t size, Take take) {
  for (size_t at = 0; size - at >= sizeof(SectionHead);) {
    SectionHead head;
    std::memcpy(&head, data + at, sizeof head);
    if (head.length < sizeof head) return;
    const size_t length = head.length < size - at ? static_cast<size_t>(head.length) : size - at;
    take(at, length);
    at += length;
  }
}

void mendChecksums(uint8_t* data, size_t size) {
  eachSection(data, size, [data](size_t at, size_t length) {
    SectionHead head;
    std::memcpy(&head, data + at, sizeof head);
    const uint8_t* body = data + at + sizeof head;
    head.body_checksum = tetstream::checksum(0, body, length - sizeof head);
    head.head_checksum = tetstream::checksum(0, &head, sizeof head - sizeof head.head_checksum);
    std::memcpy(data + at, &head, sizeof head);
  });
}

// One section, of which the length stays: what stands behind it keeps its place.
void changeSection(uint8_t* data, size_t size, unsigned seed) {
  size_t sections = 0;
  eachSection(data, size, [&](size_t, size_t) { ++sections; });
  if (sections == 0) return;
  size_t chosen = seed / 64 % sections;
  eachSection(data, size, [&](size_t at, size_t length) {
    if (chosen-- != 0) return;
    // As a rule only the body, or, of the head, what follows the length.
    const size_t skip = seed % 4 ? sizeof(SectionHead) : 16;
    if (length > skip) LLVMFuzzerMutate(data + at + skip, length - skip, length - skip);
  });
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t capacity,
                                          unsigned seed) {
  if (seed % 64 < 48)
    changeSection(data, size, seed);
  else
    size = LLVMFuzzerMutate(data, size, capacity);
  if (seed % 8) mendChecksums(data, size);
  return size;
}
