// format/sv: reads .svb, the binary form of the streaming volume meshes of M. Isenburg, in both
// byte orders.
#include <algorithm>

#include "status.h"
#include "sv_format.h"
#include "sv_open.h"
#include "svb_indexed.h"
#include "svb_layout.h"

namespace tetstream {

namespace {

constexpr int64_t kMaxCommentBytes = 1 << 20;

// The header, read word by word.
class SvbHeader {
 public:
  explicit SvbHeader(SvBytes& bytes) : bytes_(bytes) {
    need(4);
    const unsigned char* b = bytes_.data();
    if (b[0] != kSvbVersion)
      fail(Status::kBadData, "%s: byte 0 is %d, an .svb file has its version there, %d",
           bytes_.name().c_str(), b[0], kSvbVersion);
    if (b[1] > 1)
      fail(Status::kBadData, "%s: byte 1 is %d, the byte order is 0 or 1", bytes_.name().c_str(),
           b[1]);
    if (b[2] != 0 || b[3] != 0)
      fail(Status::kUnsupported, "%s: the file is compressed, which no reader of .svb knows",
           bytes_.name().c_str());
    swapped_ = (b[1] == 1) != kHostIsBigEndian;
    bytes_.drop(4);
    skipComments();
    readCounts();
  }

  bool swapped() const { return swapped_; }
  const Schema& schema() const { return schema_; }

 private:
  void need(size_t count) {
    if (!bytes_.want(count))
      fail(Status::kBadData, "%s: the file ends at byte %llu, within the header",
           bytes_.name().c_str(), static_cast<unsigned long long>(bytes_.offset() + bytes_.size()));
  }

  int32_t takeInt() {
    need(4);
    const int32_t value = static_cast<int32_t>(svbWord(bytes_.data(), swapped_));
    bytes_.drop(4);
    return value;
  }

  // An int of the header within its range; else the sentence names its byte.
  int32_t takeIntIn(const char* what, int64_t least, int64_t most) {
    const uint64_t place = bytes_.offset();
    const int32_t value = takeInt();
    if (value < least || value > most)
      fail(Status::kBadData, "%s: byte %llu: %s is %d, %lld to %lld are possible",
           bytes_.name().c_str(), static_cast<unsigned long long>(place), what, value,
           static_cast<long long>(least), static_cast<long long>(most));
    return value;
  }

  void skipComments() {
    const int32_t count = takeIntIn("the number of comments", 0, INT32_MAX);
    for (int32_t i = 0; i < count; ++i) {
      size_t left = static_cast<size_t>(takeIntIn("a comment's length", 0, kMaxCommentBytes));
      while (left > 0) {
        need(1);
        const size_t part = std::min(left, bytes_.size());
        bytes_.drop(part);
        left -= part;
      }
    }
  }

  void readCounts() {
    schema_.vertex_count = takeIntIn("nverts", -1, INT32_MAX);
    schema_.cell_count = takeIntIn("ncells", -1, INT32_MAX);
    const int floats = takeIntIn("v_pnum_f", 3, kSvbWords);
    const int ints = takeIntIn("v_pnum_i", 0, static_cast<int64_t>(kSvbWords) - floats);
    if (floats == 4) schema_.fields.push_back({"scalar", 1, ScalarType::kFloat32});
    if (ints == 1) schema_.fields.push_back({"label0", 1, ScalarType::kInt32});
    std::vector<double> low, high;
    takeBox(floats, false, low, high);
    if (ints > 0) takeBox(ints, true, low, high);
    if (low.size() != schema_.boxSize()) return;
    for (size_t i = 0; i < low.size(); ++i)
      if (!(low[i] <= high[i])) return;  // not a box: as good as none
    schema_.box_min = std::move(low);
    schema_.box_max = std::move(high);
  }

  void takeBox(int count, bool ints, std::vector<double>& low, std::vector<double>& high) {
    const uint64_t place = bytes_.offset();
    need(1);
    const int flag = *bytes_.data();
    bytes_.drop(1);
    if (flag > 1)
      fail(Status::kBadData, "%s: byte %llu is %d, the flag of a box is 0 or 1",
           bytes_.name().c_str(), static_cast<unsigned long long>(place), flag);
    if (flag == 0) return;
    for (std::vector<double>* box : {&low, &high})
      for (int i = 0; i < count; ++i) {
        const int32_t word = takeInt();
        float value;
        std::memcpy(&value, &word, sizeof value);
        box->push_back(ints ? word : value);
      }
  }

  SvBytes& bytes_;
  bool swapped_ = false;
  Schema schema_;
};

class SvbElements final : public SvElements {
 public:
  explicit SvbElements(std::unique_ptr<ByteSource> source)
      : bytes_(std::move(source)), header_(bytes_) {}

  SvBytes& bytes() { return bytes_; }
  bool swapped() const { return header_.swapped(); }
  const Schema& schema() const override { return header_.schema(); }
  std::string where(uint64_t place) const override {
    return textOf("%s: byte %llu", bytes_.name().c_str(), static_cast<unsigned long long>(place));
  }
  std::string whereEnd() const override { return where(bytes_.offset()) + ", the file's end"; }

  bool read(SvBlock& block) override {
    while (block.kinds.size() < kSvBlockElements)
      if (!readBlock(block)) break;
    return !block.kinds.empty();
  }

 private:
  // The next up to 32 elements; false at the end.
  bool readBlock(SvBlock& block) {
    constexpr size_t full = 4 + kSvbBlock * kSvbElementBytes;
    const bool whole = bytes_.want(full);
    const size_t size = whole ? full : bytes_.size();
    if (size == 0) return false;
    if (size % kSvbElementBytes != 4)
      fail(Status::kBadData, "%s: the file ends within an element",
           where(bytes_.offset() + size).c_str());
    const uint32_t descriptor = svbWord(bytes_.data(), header_.swapped());
    const size_t count = size / kSvbElementBytes;
    if (count < kSvbBlock && descriptor >> count != 0)
      fail(Status::kBadData, "%s: the file ends, but its last block announces a vertex more",
           where(bytes_.offset() + size).c_str());
    takeElements(descriptor, count, block);
    bytes_.drop(size);
    return count > 0;
  }

  void takeElements(uint32_t descriptor, size_t count, SvBlock& block) {
    const size_t vertices = static_cast<size_t>(__builtin_popcount(descriptor));
    size_t vertex = block.rows.addVertices(vertices);
    size_t cell = block.rows.addCells(count - vertices);
    const unsigned char* at = bytes_.data() + 4;
    for (size_t i = 0; i < count; ++i, at += kSvbElementBytes) {
      uint32_t words[kSvbWords];
      for (size_t w = 0; w < kSvbWords; ++w) words[w] = svbWord(at + 4 * w, header_.swapped());
      block.places.push_back(bytes_.offset() + 4 + i * kSvbElementBytes);
      if (descriptor >> i & 1) {
        block.kinds.push_back(SvKind::kVertex);
        std::memcpy(block.rows.position(vertex), words, 12);
        if (!schema().fields.empty()) std::memcpy(block.rows.field(0, vertex), words + 3, 4);
        ++vertex;
      } else {
        block.kinds.push_back(SvKind::kCell);
        int64_t* refs = block.rows.cell(cell++);
        for (size_t w = 0; w < kSvbWords; ++w) refs[w] = static_cast<int32_t>(words[w]);
      }
    }
  }

  SvBytes bytes_;
  SvbHeader header_;
};

}  // namespace

Input openSvb(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  auto elements = std::make_unique<SvbElements>(std::move(bytes));
  SvbScanner scanner(elements->swapped());
  const SvForm form = findSvForm(elements->bytes(), scanner, options.temp_dir);
  Input input;
  if (form != SvForm::kIndexed) {
    input.stream = makeSvStream(form, std::move(elements));
    return input;
  }
  checkSvCounts(*elements, scanner.vertexCount(), scanner.cellCount());
  Schema schema = elements->schema();
  schema.vertex_count = scanner.vertexCount();
  schema.cell_count = scanner.cellCount();
  elements->bytes().makeSeekable(options.temp_dir);
  const uint64_t body = elements->bytes().offset();
  input.indexed = openSvbIndexed(std::move(elements->bytes()), body, elements->swapped(), schema);
  return input;
}

}  // namespace tetstream
