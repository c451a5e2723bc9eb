#include "svb_indexed.h"

#include <algorithm>
#include <cstring>

#include "status.h"
#include "sv_check.h"
#include "svb_layout.h"

namespace tetstream {

// --------------------------------------------------------------------------------- scanner

static constexpr size_t kBlockWords = 1 + kSvbBlock * kSvbWords;

SvForm SvbScanner::takeWord(uint32_t word) {
  const size_t number = word_;
  word_ = (word_ + 1) % kBlockWords;
  if (number == 0) {
    descriptor_ = word;
    return SvForm::kUndecided;
  }
  const size_t element = (number - 1) / kSvbWords;
  const bool first_word = (number - 1) % kSvbWords == 0;
  if (descriptor_ >> element & 1) {
    if (first_word && cells_ > 0) return SvForm::kPreOrder;
    vertices_ += first_word;
    return SvForm::kUndecided;
  }
  if (vertices_ == 0) return SvForm::kPostOrder;
  cells_ += first_word;
  return static_cast<int32_t>(word) > 0 ? SvForm::kUndecided : SvForm::kPreOrder;
}

SvForm SvbScanner::feed(const unsigned char* data, size_t size) {
  while (size > 0 && (part_size_ > 0 || size < 4)) {
    part_[part_size_++] = *data++;
    --size;
    if (part_size_ < 4) continue;
    part_size_ = 0;
    const SvForm form = takeWord(svbWord(part_, swapped_));
    if (form != SvForm::kUndecided) return form;
  }
  for (; size >= 4; size -= 4, data += 4) {
    const SvForm form = takeWord(svbWord(data, swapped_));
    if (form != SvForm::kUndecided) return form;
  }
  while (size-- > 0) part_[part_size_++] = *data++;
  return SvForm::kUndecided;
}

SvForm SvbScanner::end() {
  // A file that ends within an element, or before what its last descriptor announces, is given to
  // the stream's reader, which says so.
  const size_t elements = word_ == 0 ? kSvbBlock : (word_ - 1) / kSvbWords;
  const bool cut = part_size_ > 0 || (word_ != 0 && (word_ - 1) % kSvbWords != 0) ||
                   (elements < kSvbBlock && descriptor_ >> elements != 0);
  return cells_ > 0 && !cut ? SvForm::kIndexed : SvForm::kPreOrder;
}

// --------------------------------------------------------------------------------- source

namespace {

class SvbIndexed final : public IndexedSource {
 public:
  SvbIndexed(SvBytes bytes, uint64_t body, bool swapped, const Schema& schema)
      : bytes_(std::move(bytes)), body_(body), swapped_(swapped), schema_(schema) {}

  const Schema& schema() const override { return schema_; }

  void readPositions(uint64_t first, size_t count, void* out) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    readElements(first, count, [&](uint64_t element, const uint32_t* words) {
      float position[3];
      std::memcpy(position, words, sizeof position);
      if (firstNotFinite(position, ScalarType::kFloat32, 3) < 3)
        failAt(element, textOf("vertex %llu has a position that is not a finite number",
                               static_cast<unsigned long long>(element)));
      std::memcpy(to, position, sizeof position);
      to += sizeof position;
    });
  }

  void readField(size_t, uint64_t first, size_t count, void* out) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    readElements(first, count, [&](uint64_t, const uint32_t* words) {
      std::memcpy(to, words + 3, 4);
      to += 4;
    });
  }

  void readCells(uint64_t first, size_t count, int64_t* out) override {
    const int64_t vertices = schema_.vertex_count;
    std::string problem;
    readElements(static_cast<uint64_t>(vertices) + first, count,
                 [&](uint64_t element, const uint32_t* words) {
                   for (size_t w = 0; w < kSvbWords; ++w) out[w] = static_cast<int32_t>(words[w]);
                   if (!svResolveIndexed(out, vertices, &problem)) failAt(element, problem);
                   out += kSvbWords;
                 });
  }

  void readCellData(size_t, uint64_t, size_t, void*) override {
    fail(Status::kInternal, "%s: .svb has no cell data", bytes_.name().c_str());
  }

 private:
  uint64_t placeOf(uint64_t element) const {
    return body_ + 4 * (element / kSvbBlock + 1) + kSvbElementBytes * element;
  }

  [[noreturn]] void failAt(uint64_t element, const std::string& text) const {
    fail(Status::kBadData, "%s: byte %llu: %s", bytes_.name().c_str(),
         static_cast<unsigned long long>(placeOf(element)), text.c_str());
  }

  template <class Take>
  void readElements(uint64_t first, size_t count, Take take) {
    unsigned char buffer[32 * (4 + kSvbBlock * kSvbElementBytes)];
    while (count > 0) {
      const uint64_t begin = placeOf(first);
      const size_t part = std::min(count, 31 * kSvbBlock);
      const size_t size = placeOf(first + part - 1) + kSvbElementBytes - begin;
      if (bytes_.readAt(begin, buffer, size) != size)
        failAt(first, "the file has become shorter while it was read");
      for (size_t i = 0; i < part; ++i) {
        const unsigned char* at = buffer + (placeOf(first + i) - begin);
        uint32_t words[kSvbWords];
        for (size_t w = 0; w < kSvbWords; ++w) words[w] = svbWord(at + 4 * w, swapped_);
        take(first + i, words);
      }
      first += part;
      count -= part;
    }
  }

  SvBytes bytes_;
  uint64_t body_;
  bool swapped_;
  Schema schema_;
};

}  // namespace

std::unique_ptr<IndexedSource> openSvbIndexed(SvBytes bytes, uint64_t body, bool swapped,
                                              const Schema& schema) {
  return std::make_unique<SvbIndexed>(std::move(bytes), body, swapped, schema);
}

}  // namespace tetstream
