// format: a vertex map and a log of collapses as lines of numbers with commas between them, after a
// line of names (RFC 4180).
#include "sva_number.h"
#include "trace_files.h"

namespace tetstream {

namespace {

class Lines {
 public:
  explicit Lines(std::unique_ptr<ByteSink> bytes)
      : bytes_(std::move(bytes)), buffer_(std::make_unique<BufferedSink>(*bytes_)) {}

  void add(int64_t value) {
    separate();
    printInteger(value, line_);
  }
  void add(double value) {
    separate();
    printNumber(&value, ScalarType::kFloat64, line_);
  }
  void add(const std::string& name) {
    separate();
    line_ += '"';
    for (char c : name) line_.append(c == '"' ? 2 : 1, c);
    line_ += '"';
  }
  void endLine() {
    line_ += '\n';
    buffer_->write(line_.data(), line_.size());
    line_.clear();
  }
  void finish() {
    buffer_->flush();
    bytes_->commit();
  }

 private:
  void separate() {
    if (!line_.empty()) line_ += ',';
  }

  std::unique_ptr<ByteSink> bytes_;
  std::unique_ptr<BufferedSink> buffer_;
  std::string line_;
};

class MapText final : public MapSink {
 public:
  explicit MapText(std::unique_ptr<ByteSink> bytes) : lines_(std::move(bytes)) {}
  void begin() override {
    for (const char* name : {"vertex", "cell", "w0", "w1", "w2", "w3"})
      lines_.add(std::string(name));
    lines_.endLine();
  }
  void put(const MapRows& rows) override {
    for (size_t i = 0; i < rows.count; ++i) {
      lines_.add(rows.vertices[i]);
      lines_.add(rows.cells[i]);
      for (size_t k = 0; k < 4; ++k) lines_.add(rows.weights[4 * i + k]);
      lines_.endLine();
    }
  }
  void finish() override { lines_.finish(); }

 private:
  Lines lines_;
};

class LogText final : public LogSink {
 public:
  explicit LogText(std::unique_ptr<ByteSink> bytes) : lines_(std::move(bytes)) {}
  void begin(const Schema& input) override {
    for (const char* name : {"kept", "removed", "x", "y", "z", "error"})
      lines_.add(std::string(name));
    for (const Column& c : input.fields) {
      if (!isFloat(c.type)) continue;
      for (int k = 0; k < c.components; ++k)
        lines_.add(c.components == 1 ? c.name : c.name + ":" + std::to_string(k));
      values_ += static_cast<size_t>(c.components);
    }
    lines_.endLine();
  }
  void put(const LogRows& rows) override {
    for (size_t i = 0; i < rows.count; ++i) {
      lines_.add(rows.kept[i]);
      lines_.add(rows.removed[i]);
      for (size_t k = 0; k < 3; ++k) lines_.add(rows.positions[3 * i + k]);
      lines_.add(rows.errors[i]);
      for (size_t k = 0; k < values_; ++k) lines_.add(rows.values[values_ * i + k]);
      lines_.endLine();
    }
  }
  void finish() override { lines_.finish(); }

 private:
  Lines lines_;
  size_t values_ = 0;
};

}  // namespace

std::unique_ptr<MapSink> createMapText(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<MapText>(std::move(bytes));
}

std::unique_ptr<LogSink> createLogText(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<LogText>(std::move(bytes));
}

}  // namespace tetstream
