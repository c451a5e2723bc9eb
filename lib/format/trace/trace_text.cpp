// format/trace: a vertex map and a log of collapses as lines of numbers with commas between them,
// after a line of names (RFC 4180).
#include <utility>

#include "text_number.h"
#include "trace_files.h"
#include "trace_rows.h"

namespace tetstream {

namespace {

class TextRows {
 public:
  explicit TextRows(std::unique_ptr<ByteSink> bytes)
      : bytes_(std::move(bytes)), buffer_(std::make_unique<BufferedSink>(*bytes_)) {}

  void begin(const TraceColumns& columns) {
    for (const char* name : columns.names) addName(name);
    for (const Column& c : columns.fields)
      for (int k = 0; k < c.components; ++k)
        addName(c.components == 1 ? c.name : c.name + ":" + std::to_string(k));
    endRow();
  }
  void add(int64_t value) {
    separate();
    printInteger(value, line_);
  }
  void add(double value) {
    separate();
    printNumber(&value, ScalarType::kFloat64, line_);
  }
  void endRow() {
    line_ += '\n';
    buffer_->write(line_.data(), line_.size());
    line_.clear();
  }
  void finish() {
    buffer_->flush();
    bytes_->commit();
  }

 private:
  void addName(const std::string& name) {
    separate();
    line_ += '"';
    for (char c : name) line_.append(c == '"' ? 2 : 1, c);
    line_ += '"';
  }
  void separate() {
    if (!line_.empty()) line_ += ',';
  }

  std::unique_ptr<ByteSink> bytes_;
  std::unique_ptr<BufferedSink> buffer_;
  std::string line_;
};

}  // namespace

std::unique_ptr<MapSink> createMapText(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<MapFile<TextRows>>(TextRows(std::move(bytes)));
}

std::unique_ptr<LogSink> createLogText(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<LogFile<TextRows>>(TextRows(std::move(bytes)));
}

}  // namespace tetstream
