#include "sv_spool.h"

#include <algorithm>
#include <cstring>

#include "status.h"
#include "sv_check.h"

namespace tetstream {

namespace {

// Rows of several columns in one temporary file: blocks of some thousand rows, column after column
// within a block, so that a column is read by range and any number of columns needs one file.
class SpooledTable {
 public:
  SpooledTable(std::vector<size_t> strides, const std::string& temp_dir)
      : strides_(std::move(strides)), file_(temp_dir) {
    size_t row_bytes = 0;
    for (size_t s : strides_) row_bytes += s;
    block_rows_ = std::clamp<size_t>(kBlockBytes / row_bytes, 1, 4096);
    for (size_t s : strides_) {
      starts_.push_back(block_bytes_);
      block_bytes_ += s * block_rows_;
    }
    block_.resize(block_bytes_);
  }

  // Row by row: write every column of the new row, then next().
  void set(size_t column, const void* value) {
    std::memcpy(block_.data() + starts_[column] + rows_ % block_rows_ * strides_[column], value,
                strides_[column]);
  }
  void next() {
    if (++rows_ % block_rows_ == 0) file_.append(block_.data(), block_bytes_);
  }
  void close() {  // pads the last block
    if (rows_ % block_rows_ != 0) file_.append(block_.data(), block_bytes_);
    block_ = {};
  }

  void read(size_t column, uint64_t first, size_t count, void* out) {
    unsigned char* to = static_cast<unsigned char*>(out);
    const size_t stride = strides_[column];
    while (count > 0) {
      const size_t in_block = first % block_rows_;
      const size_t part = std::min(count, block_rows_ - in_block);
      file_.readAt(first / block_rows_ * block_bytes_ + starts_[column] + in_block * stride, to,
                   part * stride);
      to += part * stride;
      first += part;
      count -= part;
    }
  }

  uint64_t rows() const { return rows_; }

 private:
  static constexpr size_t kBlockBytes = 1 << 20;  // bounds the buffer, whatever the columns
  std::vector<size_t> strides_, starts_;
  size_t block_rows_ = 0, block_bytes_ = 0;
  std::vector<unsigned char> block_;
  uint64_t rows_ = 0;
  SpoolFile file_;
};

std::vector<size_t> stridesOf(size_t first, const std::vector<Column>& columns) {
  std::vector<size_t> strides = {first};
  for (const Column& c : columns) strides.push_back(c.bytesPerRow());
  return strides;
}

class SpooledMesh final : public IndexedSource {
 public:
  SpooledMesh(SvElements& elements, const std::string& temp_dir)
      : schema_(elements.schema()),
        vertices_(stridesOf(3 * sizeOf(schema_.position_type), schema_.fields), temp_dir),
        cells_(stridesOf(4 * sizeof(int64_t), schema_.cell_data), temp_dir) {
    SvBlock block(schema_);
    while (elements.read(block)) {
      checkSvPositions(elements, block);
      append(elements, block);
      block.clear(vertices_.rows());
    }
    vertices_.close();
    cells_.close();
    const int64_t vertex_count = static_cast<int64_t>(vertices_.rows());
    const int64_t cell_count = static_cast<int64_t>(cells_.rows());
    checkSvCounts(elements, vertex_count, cell_count);
    schema_.vertex_count = vertex_count;
    schema_.cell_count = cell_count;
  }

  const Schema& schema() const override { return schema_; }
  void readPositions(uint64_t first, size_t count, void* out) override {
    vertices_.read(0, first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    vertices_.read(1 + column, first, count, out);
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    cells_.read(0, first, count, out);
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    cells_.read(1 + column, first, count, out);
  }

 private:
  void append(SvElements& elements, SvBlock& block) {
    size_t vertex = 0, cell = 0;
    for (size_t i = 0; i < block.kinds.size(); ++i) {
      if (block.kinds[i] == SvKind::kVertex) {
        vertices_.set(0, block.rows.position(vertex));
        for (size_t c = 0; c < schema_.fields.size(); ++c)
          vertices_.set(1 + c, block.rows.field(c, vertex));
        vertices_.next();
        ++vertex;
        continue;
      }
      int64_t* ranks = block.rows.cell(cell);
      std::string problem;
      if (!svResolveIndexed(ranks, static_cast<int64_t>(vertices_.rows()), &problem))
        fail(Status::kBadData, "%s: %s", elements.where(block.places[i]).c_str(), problem.c_str());
      cells_.set(0, ranks);
      for (size_t c = 0; c < schema_.cell_data.size(); ++c)
        cells_.set(1 + c, block.rows.cellData(c, cell));
      cells_.next();
      ++cell;
    }
  }

  Schema schema_;
  SpooledTable vertices_, cells_;
};

}  // namespace

std::unique_ptr<IndexedSource> spoolSvElements(SvElements& elements, const std::string& temp_dir) {
  return std::make_unique<SpooledMesh>(elements, temp_dir);
}

}  // namespace tetstream
