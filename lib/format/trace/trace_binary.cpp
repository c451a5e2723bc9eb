// format/trace: .tetmap and .tetlog: a header, rows of fixed length, an end. All numbers are little
// endian.
#include <bit>
#include <cstring>
#include <utility>

#include "checksum.h"
#include "trace_files.h"
#include "trace_rows.h"

namespace tetstream {

namespace {

constexpr size_t kAlign = 64;
constexpr uint64_t kRowsAt = 16;  // the place of the number of rows in the header
constexpr uint32_t kVersion = 1;
constexpr char kMapMarker[] = "\x89TMAP\r\n\x1a", kLogMarker[] = "\x89TLOG\r\n\x1a",
               kEndMarker[] = "\x89TEND\r\n\x1a";

// Bytes that are put together number by number.
class Words {
 public:
  void putMarker(const char* marker) { put(marker, 8); }
  void putText(const std::string& text) { put(text.data(), text.size()); }
  void put32(uint32_t value) { putNumber(value, 4); }
  void put64(int64_t value) { putNumber(static_cast<uint64_t>(value), 8); }
  void putFloat(double value) { putNumber(std::bit_cast<uint64_t>(value), 8); }
  void fillTo(size_t multiple) {
    bytes_.resize((bytes_.size() + multiple - 1) / multiple * multiple, 0);
  }
  const unsigned char* data() const { return bytes_.data(); }
  size_t size() const { return bytes_.size(); }
  void clear() { bytes_.clear(); }

 private:
  void put(const void* data, size_t size) {
    const auto* from = static_cast<const unsigned char*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
  }
  void putNumber(uint64_t value, int count) {
    for (int i = 0; i < count; ++i)
      bytes_.push_back(static_cast<unsigned char>(value >> (8 * i) & 0xff));
  }
  std::vector<unsigned char> bytes_;
};

// The number of rows stands in the header, where the writer can go back to it, and at the end,
// with a checksum of the rows.
class BinaryRows {
 public:
  BinaryRows(const char* marker, std::unique_ptr<ByteSink> bytes)
      : marker_(marker),
        bytes_(std::move(bytes)),
        buffer_(std::make_unique<BufferedSink>(*bytes_)) {}

  void begin(const TraceColumns& columns) {
    Words names;
    for (const Column& c : columns.fields) {
      names.put32(static_cast<uint32_t>(c.components));
      names.put32(static_cast<uint32_t>(c.name.size()));
      names.putText(c.name);
      names.fillTo(8);
    }
    const size_t header = (kAlign + names.size() + kAlign - 1) / kAlign * kAlign;
    const size_t numbers = std::size(columns.names) + columns.components();
    Words head;
    head.putMarker(marker_);
    head.put32(kVersion);
    head.put32(static_cast<uint32_t>(header));
    head.put64(-1);
    head.put32(static_cast<uint32_t>(8 * numbers));
    head.put32(static_cast<uint32_t>(columns.fields.size()));
    head.fillTo(kAlign);
    names.fillTo(kAlign);
    write(head);
    write(names);
  }

  void add(int64_t number) { row_.put64(number); }
  void add(double number) { row_.putFloat(number); }
  void endRow() {
    sum_ = checksum(sum_, row_.data(), row_.size());
    write(row_);
    row_.clear();
    ++count_;
  }

  void finish() {
    Words end, count;
    end.putMarker(kEndMarker);
    end.put64(count_);
    end.put32(sum_);
    end.fillTo(32);
    write(end);
    buffer_->flush();
    count.put64(count_);
    if (bytes_->seekable()) bytes_->writeAt(kRowsAt, count.data(), count.size());
    bytes_->commit();
  }

 private:
  void write(const Words& words) { buffer_->write(words.data(), words.size()); }

  const char* marker_;
  std::unique_ptr<ByteSink> bytes_;
  std::unique_ptr<BufferedSink> buffer_;
  Words row_;
  int64_t count_ = 0;
  uint32_t sum_ = 0;
};

}  // namespace

std::unique_ptr<MapSink> createMapBinary(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<MapFile<BinaryRows>>(BinaryRows(kMapMarker, std::move(bytes)));
}

std::unique_ptr<LogSink> createLogBinary(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<LogFile<BinaryRows>>(BinaryRows(kLogMarker, std::move(bytes)));
}

}  // namespace tetstream
