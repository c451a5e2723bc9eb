#include "sv_sink.h"

#include <cstring>
#include <optional>

#include "status.h"
#include "sv_open.h"

namespace tetstream {

namespace {

// The vertices that were given but not yet written, from the lowest rank on.
class PendingVertices {
 public:
  explicit PendingVertices(const Schema& schema) {
    strides_.push_back(3 * sizeOf(schema.position_type));
    for (const Column& c : schema.fields) strides_.push_back(c.bytesPerRow());
    for (size_t s : strides_) row_bytes_ += s;
  }

  int64_t first() const { return first_; }          // rank of the oldest
  int64_t end() const { return first_ + count(); }  // rank of the next to come
  int64_t count() const { return static_cast<int64_t>(final_.size() - head_); }
  bool isFinal(int64_t rank) const { return final_[place(rank)] != 0; }
  void setFinal(int64_t rank) { final_[place(rank)] = 1; }

  void add(const BatchView& batch) {
    dropOld();
    size_t at = rows_.size();
    rows_.resize(at + batch.vertex_count * row_bytes_);
    for (size_t row = 0; row < batch.vertex_count; ++row)
      for (size_t c = 0; c < strides_.size(); at += strides_[c++]) {
        const void* column = c == 0 ? batch.positions : batch.fields[c - 1];
        std::memcpy(&rows_[at], static_cast<const unsigned char*>(column) + row * strides_[c],
                    strides_[c]);
      }
    final_.resize(final_.size() + batch.vertex_count, 0);
  }

  void moveFirst(SvBlock& block) {
    const size_t row = block.rows.addVertices(1);
    const unsigned char* from = &rows_[head_ * row_bytes_];
    std::memcpy(block.rows.position(row), from, strides_[0]);
    from += strides_[0];
    for (size_t c = 1; c < strides_.size(); from += strides_[c++])
      std::memcpy(block.rows.field(c - 1, row), from, strides_[c]);
    block.kinds.push_back(SvKind::kVertex);
    ++head_;
    ++first_;
  }

 private:
  size_t place(int64_t rank) const { return head_ + static_cast<size_t>(rank - first_); }

  void dropOld() {  // once half of the rows are old: each row moves once on average
    if (head_ < final_.size() - head_) return;
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(head_ * row_bytes_));
    final_.erase(final_.begin(), final_.begin() + static_cast<std::ptrdiff_t>(head_));
    head_ = 0;
  }

  std::vector<size_t> strides_;
  size_t row_bytes_ = 0, head_ = 0;
  int64_t first_ = 0;
  std::vector<unsigned char> rows_, final_;
};

class SvSink final : public Sink {
 public:
  SvSink(std::unique_ptr<SvEncoder> encoder, DroppedMarks dropped, bool post_order)
      : encoder_(std::move(encoder)), dropped_(std::move(dropped)), post_order_(post_order) {}

  void begin(const Schema& schema) override {
    checkSchema(schema);
    schema_ = schema;
    pending_.emplace(schema_);
    block_.emplace(schema_);
  }

  void put(const BatchView& batch) override {
    dropped_.look(batch);
    if (batch.vertex_count > 0) pending_->add(batch);
    for (size_t i = 0; i < batch.cell_count; ++i) {
      const uint8_t last_uses = batch.last_uses ? batch.last_uses[i] : 0;
      if (post_order_)
        putPostOrder(batch, i, last_uses);
      else
        putPreOrder(batch, i, last_uses);
      flushIfFull();
    }
    for (size_t i = 0; i < batch.finalized_count; ++i) {
      finalize(batch.finalized[i]);
      flushIfFull();
    }
    flush();
  }

  void finish() override {
    introduce(pending_->end() - 1);
    flush();
    checkCounts();
    if (!begun_) {
      schema_.vertex_count = schema_.cell_count = 0;
      encoder_->begin(schema_);
    }
    encoder_->finish(pending_->end(), cells_);
  }

 private:
  void putPreOrder(const BatchView& batch, size_t i, uint8_t last_uses) {
    const int64_t* ranks = batch.cells + 4 * i;
    for (int j = 0; j < 4; ++j) introduce(checked(ranks[j], "used"));
    const int64_t count = pending_->first();
    int64_t* refs = addCell(batch, i);
    for (int j = 0; j < 4; ++j) refs[j] = last_uses >> j & 1 ? ranks[j] - count : ranks[j] + 1;
  }

  void putPostOrder(const BatchView& batch, size_t i, uint8_t last_uses) {
    const int64_t* ranks = batch.cells + 4 * i;
    for (int j = 0; j < 4; ++j) checkNotWritten(checked(ranks[j], "used"), "used");
    int64_t* refs = addCell(batch, i);
    for (int j = 0; j < 4; ++j) {
      refs[j] = ranks[j] + 1;
      if (last_uses >> j & 1) pending_->setFinal(ranks[j]);
    }
    moveFinal();
  }

  void finalize(int64_t rank) {
    checked(rank, "finalized");
    if (post_order_) {
      checkNotWritten(rank, "finalized");
      pending_->setFinal(rank);
      moveFinal();
      return;
    }
    introduce(rank);
    block_->kinds.push_back(SvKind::kFinalize);
    block_->finalized.push_back(rank + 1);
  }

  // Writes the vertices up to that rank which are not yet written.
  void introduce(int64_t rank) {
    while (pending_->first() <= rank) {
      pending_->moveFirst(*block_);
      flushIfFull();
    }
  }

  // Post-order: what is final from the lowest rank on. The first element must be a cell, as it
  // tells the order of the file.
  void moveFinal() {
    if (cells_ == 0) return;
    while (pending_->count() > 0 && pending_->isFinal(pending_->first())) {
      pending_->moveFirst(*block_);
      flushIfFull();
    }
  }

  int64_t* addCell(const BatchView& batch, size_t i) {
    const size_t row = block_->rows.addCells(1);
    for (size_t c = 0; c < schema_.cell_data.size(); ++c) {
      const size_t stride = schema_.cell_data[c].bytesPerRow();
      std::memcpy(block_->rows.cellData(c, row),
                  static_cast<const unsigned char*>(batch.cell_data[c]) + i * stride, stride);
    }
    block_->kinds.push_back(SvKind::kCell);
    ++cells_;
    return block_->rows.cell(row);
  }

  int64_t checked(int64_t rank, const char* verb) const {
    if (rank < 0 || rank >= pending_->end())
      fail(Status::kBadData, "after cell %lld: vertex %lld is %s, but only %lld vertices came",
           static_cast<long long>(cells_), static_cast<long long>(rank), verb,
           static_cast<long long>(pending_->end()));
    return rank;
  }

  void checkNotWritten(int64_t rank, const char* verb) const {
    if (rank < pending_->first())
      fail(Status::kBadData, "after cell %lld: vertex %lld is %s again, but was finalized",
           static_cast<long long>(cells_), static_cast<long long>(rank), verb);
  }

  void flushIfFull() {
    if (block_->kinds.size() >= kSvBlockElements) flush();
  }

  void flush() {
    if (block_->kinds.empty()) return;
    checkPositions();
    if (!begun_) encoder_->begin(schema_);
    begun_ = true;
    encoder_->write(*block_);
    block_->clear(static_cast<uint64_t>(pending_->first()));
  }

  void checkCounts() const {
    const int64_t vertices = pending_->end();
    if ((schema_.vertex_count >= 0 && schema_.vertex_count != vertices) ||
        (schema_.cell_count >= 0 && schema_.cell_count != cells_))
      fail(Status::kBadData,
           "the stream has %lld vertices and %lld cells, but announced %lld and %lld",
           static_cast<long long>(vertices), static_cast<long long>(cells_),
           static_cast<long long>(schema_.vertex_count),
           static_cast<long long>(schema_.cell_count));
  }

  void checkPositions() {
    const size_t count = block_->rows.vertexCount();
    if (count == 0) return;
    const size_t bad =
        firstNotFinite(block_->rows.position(0), schema_.position_type, 3 * count) / 3;
    if (bad < count)
      fail(Status::kBadData, "vertex %llu has a position that is not a finite number",
           static_cast<unsigned long long>(block_->rows.firstVertex() + bad));
  }

  std::unique_ptr<SvEncoder> encoder_;
  DroppedMarks dropped_;
  bool post_order_;
  Schema schema_;
  std::optional<PendingVertices> pending_;
  std::optional<SvBlock> block_;
  int64_t cells_ = 0;
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<Sink> makeSvSink(std::unique_ptr<SvEncoder> encoder, DroppedMarks dropped,
                                 const WriteOptions& options) {
  return std::make_unique<SvSink>(std::move(encoder), std::move(dropped), options.post_order);
}

}  // namespace tetstream
