// format/sv: writes .sva. Numbers are the shortest that read back the same.
#include <algorithm>

#include "sv_format.h"
#include "sv_sink.h"
#include "sva_header.h"
#include "text_number.h"

namespace tetstream {

namespace {

// The most characters of a number of that type, with the blank before it.
size_t longestNumber(ScalarType type) {
  switch (type) {
    case ScalarType::kFloat32:
      return 16;
    case ScalarType::kFloat64:
      return 25;
    case ScalarType::kInt32:
      return 12;
    case ScalarType::kInt64:
      return 21;
  }
  return 0;
}

size_t longestRow(size_t before, const std::vector<Column>& columns) {
  for (const Column& c : columns)
    before += static_cast<size_t>(c.components) * longestNumber(c.type);
  return before + 2;  // the tag and the newline
}

class SvaEncoder final : public SvEncoder {
 public:
  SvaEncoder(std::unique_ptr<ByteSink> sink, const WriteOptions& options)
      : sink_(std::move(sink)), note_(options.note) {}

  void begin(const Schema& schema) override {
    schema_ = schema;
    field_order_ = svaColumnOrder(schema_.fields);
    cell_order_ = svaColumnOrder(schema_.cell_data);
    const size_t longest =
        std::max(longestRow(3 * longestNumber(schema_.position_type), schema_.fields),
                 longestRow(4 * longestNumber(ScalarType::kInt64), schema_.cell_data));
    if (longest > 255 && note_)
      note_(sink_->name() +
            ": lines may be longer than the 255 characters that other readers of "
            ".sva take");
    const std::string header = printSvaHeader(schema_, sink_->seekable(), &counts_at_);
    sink_->write(header.data(), header.size());
  }

  void write(SvBlock& block) override {
    text_.clear();
    size_t vertex = 0, cell = 0, finalized = 0;
    for (SvKind kind : block.kinds) {
      switch (kind) {
        case SvKind::kVertex:
          printVertex(block.rows, vertex++);
          break;
        case SvKind::kCell:
          printCell(block.rows, cell++);
          break;
        case SvKind::kFinalize:
          text_ += "x ";
          printInteger(block.finalized[finalized++], text_);
      }
      text_ += '\n';
    }
    sink_->write(text_.data(), text_.size());
  }

  void finish(int64_t vertex_count, int64_t cell_count) override {
    if (counts_at_ >= 0) {
      const std::string counts = printSvaCounts(vertex_count, cell_count);
      sink_->writeAt(static_cast<uint64_t>(counts_at_), counts.data(), counts.size());
    }
    sink_->commit();
  }

 private:
  void printNumbers(const void* values, ScalarType type, int count) {
    const unsigned char* at = static_cast<const unsigned char*>(values);
    for (int i = 0; i < count; ++i, at += sizeOf(type)) {
      text_ += ' ';
      printNumber(at, type, text_);
    }
  }

  void printVertex(Batch& rows, size_t row) {
    text_ += 'v';
    printNumbers(rows.position(row), schema_.position_type, 3);
    for (size_t i : field_order_)
      printNumbers(rows.field(i, row), schema_.fields[i].type, schema_.fields[i].components);
  }

  void printCell(Batch& rows, size_t row) {
    text_ += 'c';
    printNumbers(rows.cell(row), ScalarType::kInt64, 4);
    for (size_t i : cell_order_)
      printNumbers(rows.cellData(i, row), schema_.cell_data[i].type,
                   schema_.cell_data[i].components);
  }

  std::unique_ptr<ByteSink> sink_;
  std::function<void(const std::string&)> note_;
  Schema schema_;
  std::vector<size_t> field_order_, cell_order_;
  int64_t counts_at_ = -1;
  std::string text_;
};

}  // namespace

std::unique_ptr<Sink> createSva(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  const DroppedMarks dropped(*bytes, options, ".sva");
  return makeSvSink(std::make_unique<SvaEncoder>(std::move(bytes), options), dropped, options);
}

}  // namespace tetstream
