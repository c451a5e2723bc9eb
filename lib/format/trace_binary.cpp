// format: .tetmap and .tetlog: a header, rows of fixed length, an end. All numbers are little
// endian.
#include <zlib.h>

#include <bit>
#include <cstring>

#include "trace_files.h"

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
class RowFile {
 public:
  explicit RowFile(std::unique_ptr<ByteSink> bytes)
      : bytes_(std::move(bytes)), buffer_(std::make_unique<BufferedSink>(*bytes_)) {}

  void begin(const char* marker, size_t row_bytes, const std::vector<Column>& columns) {
    Words names;
    for (const Column& c : columns) {
      names.put32(static_cast<uint32_t>(c.components));
      names.put32(static_cast<uint32_t>(c.name.size()));
      names.putText(c.name);
      names.fillTo(8);
    }
    const size_t header = (kAlign + names.size() + kAlign - 1) / kAlign * kAlign;
    Words head;
    head.putMarker(marker);
    head.put32(kVersion);
    head.put32(static_cast<uint32_t>(header));
    head.put64(-1);
    head.put32(static_cast<uint32_t>(row_bytes));
    head.put32(static_cast<uint32_t>(columns.size()));
    head.fillTo(kAlign);
    names.fillTo(kAlign);
    buffer_->write(head.data(), head.size());
    buffer_->write(names.data(), names.size());
  }

  void put(const Words& rows, size_t count) {
    sum_ = static_cast<uint32_t>(crc32_z(sum_, rows.data(), rows.size()));
    buffer_->write(rows.data(), rows.size());
    rows_ += static_cast<int64_t>(count);
  }

  void finish() {
    Words end, rows;
    end.putMarker(kEndMarker);
    end.put64(rows_);
    end.put32(sum_);
    end.fillTo(32);
    buffer_->write(end.data(), end.size());
    buffer_->flush();
    rows.put64(rows_);
    if (bytes_->seekable()) bytes_->writeAt(kRowsAt, rows.data(), rows.size());
    bytes_->commit();
  }

 private:
  std::unique_ptr<ByteSink> bytes_;
  std::unique_ptr<BufferedSink> buffer_;
  int64_t rows_ = 0;
  uint32_t sum_ = 0;
};

class MapBinary final : public MapSink {
 public:
  explicit MapBinary(std::unique_ptr<ByteSink> bytes) : file_(std::move(bytes)) {}
  void begin() override { file_.begin(kMapMarker, 48, {}); }
  void put(const MapRows& rows) override {
    words_.clear();
    for (size_t i = 0; i < rows.count; ++i) {
      words_.put64(rows.vertices[i]);
      words_.put64(rows.cells[i]);
      for (size_t k = 0; k < 4; ++k) words_.putFloat(rows.weights[4 * i + k]);
    }
    file_.put(words_, rows.count);
  }
  void finish() override { file_.finish(); }

 private:
  RowFile file_;
  Words words_;
};

class LogBinary final : public LogSink {
 public:
  explicit LogBinary(std::unique_ptr<ByteSink> bytes) : file_(std::move(bytes)) {}
  void begin(const Schema& input) override {
    std::vector<Column> columns;
    for (const Column& c : input.fields) {
      if (!isFloat(c.type)) continue;
      columns.push_back(c);
      values_ += static_cast<size_t>(c.components);
    }
    file_.begin(kLogMarker, 48 + 8 * values_, columns);
  }
  void put(const LogRows& rows) override {
    words_.clear();
    for (size_t i = 0; i < rows.count; ++i) {
      words_.put64(rows.kept[i]);
      words_.put64(rows.removed[i]);
      for (size_t k = 0; k < 3; ++k) words_.putFloat(rows.positions[3 * i + k]);
      words_.putFloat(rows.errors[i]);
      for (size_t k = 0; k < values_; ++k) words_.putFloat(rows.values[values_ * i + k]);
    }
    file_.put(words_, rows.count);
  }
  void finish() override { file_.finish(); }

 private:
  RowFile file_;
  Words words_;
  size_t values_ = 0;
};

}  // namespace

std::unique_ptr<MapSink> createMapBinary(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<MapBinary>(std::move(bytes));
}

std::unique_ptr<LogSink> createLogBinary(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<LogBinary>(std::move(bytes));
}

}  // namespace tetstream
