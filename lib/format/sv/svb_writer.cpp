// format/sv: writes .svb, little endian. Four words per vertex: x y z and one number more; no cell
// data, no names, no explicit finalization. What does not fit is left out, and noted.
#include "status.h"
#include "sv_format.h"
#include "sv_open.h"
#include "sv_sink.h"
#include "svb_layout.h"

namespace tetstream {

namespace {

using Bytes = std::vector<unsigned char>;

class SvbEncoder final : public SvEncoder {
 public:
  SvbEncoder(std::unique_ptr<ByteSink> sink, const WriteOptions& options)
      : sink_(std::move(sink)), note_(options.note) {}

  void begin(const Schema& schema) override {
    schema_ = schema;
    chooseField();
    needFit(schema_.vertex_count);
    writeHeader();
  }

  void write(SvBlock& block) override {
    out_.clear();
    size_t vertex = 0, cell = 0;
    for (SvKind kind : block.kinds) {
      switch (kind) {
        case SvKind::kVertex:
          addVertex(block.rows, vertex++);
          break;
        case SvKind::kCell:
          addCell(block.rows.cell(cell++));
          break;
        case SvKind::kFinalize:
          ++not_finalized_;
          break;
      }
      if (elements_ == kSvbBlock) closeBlock();
    }
    sink_->write(out_.data(), out_.size());
  }

  void finish(int64_t vertex_count, int64_t cell_count) override {
    out_.clear();
    closeBlock();  // also an empty one, as the format's first writer does
    sink_->write(out_.data(), out_.size());
    if (sink_->seekable() && (schema_.vertex_count < 0 || schema_.cell_count < 0)) {
      out_.clear();
      addCount(vertex_count);
      addCount(cell_count);
      sink_->writeAt(kSvbCountsAt, out_.data(), out_.size());
    }
    if (not_finalized_ > 0)
      note(
          textOf(".svb finalizes vertices with their last cell only; %lld others stay active to "
                 "the end of the file",
                 static_cast<long long>(not_finalized_)));
    sink_->commit();
  }

 private:
  void note(const std::string& text) const {
    if (note_) note_(sink_->name() + ": " + text);
  }

  // The one number that fits beside x y z: the first float field of one component, else the first
  // int32 field of one component.
  void chooseField() {
    for (bool floats : {true, false})
      for (size_t i = 0; i < schema_.fields.size() && field_ < 0; ++i) {
        const Column& c = schema_.fields[i];
        if (c.components == 1 && (floats ? isFloat(c.type) : c.type == ScalarType::kInt32))
          field_ = static_cast<int>(i);
      }
    for (size_t i = 0; i < schema_.fields.size(); ++i)
      if (static_cast<int>(i) != field_)
        note("field \"" + schema_.fields[i].name +
             "\" is left out: .svb has room for one scalar, " + "float32 or int32");
    for (const Column& c : schema_.cell_data)
      note("cell array \"" + c.name + "\" is left out: .svb has no cell data");
    if (schema_.position_type == ScalarType::kFloat64) note("positions are rounded to float32");
    if (field_ >= 0 && column().type == ScalarType::kFloat64)
      note("field \"" + column().name + "\" is rounded to float32");
  }

  const Column& column() const { return schema_.fields[static_cast<size_t>(field_)]; }
  bool floatField() const { return field_ >= 0 && isFloat(column().type); }

  void needFit(int64_t vertex_count) const {
    if (vertex_count > INT32_MAX)
      fail(Status::kUnsupported, "%s: .svb can number %d vertices, the mesh has more",
           sink_->name().c_str(), INT32_MAX);
  }

  static void addWord(Bytes& to, uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8)
      to.push_back(static_cast<unsigned char>(word >> shift));
  }
  static void addInt(Bytes& to, int64_t value) {
    addWord(to, static_cast<uint32_t>(static_cast<int32_t>(value)));
  }
  void addCount(int64_t count) { addInt(out_, count > INT32_MAX ? -1 : count); }  // -1: unknown
  void addFloat(double value) {
    const float narrow = static_cast<float>(value);
    uint32_t word;
    std::memcpy(&word, &narrow, sizeof word);
    addWord(out_, word);
  }

  void writeHeader() {
    out_.clear();
    for (unsigned char byte : {kSvbVersion, uint8_t{0}, uint8_t{0}, uint8_t{0}})
      out_.push_back(byte);
    addInt(out_, 0);  // comments: other readers may not survive any
    addCount(schema_.vertex_count);
    addCount(schema_.cell_count);
    addInt(out_, floatField() ? 4 : 3);
    addInt(out_, field_ >= 0 && !floatField() ? 1 : 0);
    addBoxes();
    sink_->write(out_.data(), out_.size());
  }

  void addBoxes() {
    size_t at = 3;  // of the field in the schema's box
    for (int i = 0; i < field_; ++i)
      at += static_cast<size_t>(schema_.fields[static_cast<size_t>(i)].components);
    const bool ints = field_ >= 0 && !floatField();
    const bool box =
        schema_.hasBox() &&
        (!ints || (schema_.box_min[at] >= INT32_MIN && schema_.box_max[at] <= INT32_MAX));
    out_.push_back(box);
    for (const std::vector<double>* bound : {&schema_.box_min, &schema_.box_max}) {
      if (!box) break;
      for (size_t i = 0; i < 3; ++i) addFloat((*bound)[i]);
      if (floatField()) addFloat((*bound)[at]);
    }
    if (!ints) return;
    out_.push_back(box);
    if (!box) return;
    addInt(out_, static_cast<int64_t>(schema_.box_min[at]));
    addInt(out_, static_cast<int64_t>(schema_.box_max[at]));
  }

  void startElement(bool is_vertex) {
    descriptor_ |= static_cast<uint32_t>(is_vertex) << elements_;
    ++elements_;
  }

  void addVertex(Batch& rows, size_t row) {
    needFit(++vertices_);
    startElement(true);
    float position[3];
    convertScalars(rows.position(row), schema_.position_type, position, ScalarType::kFloat32, 3);
    if (firstNotFinite(position, ScalarType::kFloat32, 3) < 3)
      fail(Status::kUnsupported, "%s: vertex %lld has a position too large for float32",
           sink_->name().c_str(), static_cast<long long>(vertices_ - 1));
    uint32_t words[kSvbWords] = {0, 0, 0, 0};
    std::memcpy(words, position, sizeof position);
    if (field_ >= 0)
      convertScalars(rows.field(static_cast<size_t>(field_), row), column().type, words + 3,
                     floatField() ? ScalarType::kFloat32 : ScalarType::kInt32, 1);
    for (uint32_t word : words) addWord(block_, word);
  }

  void addCell(const int64_t* refs) {
    startElement(false);
    for (size_t w = 0; w < kSvbWords; ++w) addInt(block_, refs[w]);
  }

  void closeBlock() {
    addWord(out_, descriptor_);
    out_.insert(out_.end(), block_.begin(), block_.end());
    block_.clear();
    descriptor_ = 0;
    elements_ = 0;
  }

  std::unique_ptr<ByteSink> sink_;
  std::function<void(const std::string&)> note_;
  Schema schema_;
  int field_ = -1;  // the field that is written
  Bytes out_;       // what the next write takes
  Bytes block_;     // the elements of the block that is not full yet
  uint32_t descriptor_ = 0;
  size_t elements_ = 0;  // in block_
  int64_t vertices_ = 0, not_finalized_ = 0;
};

}  // namespace

std::unique_ptr<Sink> createSvb(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  const DroppedMarks dropped(*bytes, options, ".svb");
  return makeSvSink(std::make_unique<SvbEncoder>(std::move(bytes), options), dropped, options);
}

}  // namespace tetstream
