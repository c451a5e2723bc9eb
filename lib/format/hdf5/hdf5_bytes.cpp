#include "hdf5_bytes.h"

#ifdef TETSTREAM_WITH_HDF5
#include <algorithm>
#include <cstring>
#include <iterator>

#include "hdf5_filters.h"
#include "status.h"

namespace tetstream {

namespace {

// Chunks are decompressed whole; VTK's have some hundred kilobytes.
constexpr uint64_t kMaxBandBytes = uint64_t{256} << 20;

struct Dataset {
  Hdf5File& file;
  std::string what;
  Hdf5Id id, plan;
  Hdf5Shape shape;

  [[noreturn]] void fail(Status status, const char* why) const {
    tetstream::fail(status, "%s: %s %s", file.name().c_str(), what.c_str(), why);
  }
};

// In one piece of the file.
class ContiguousBytes final : public ValueBytes {
 public:
  explicit ContiguousBytes(Dataset dataset) : dataset_(std::move(dataset)) {
    begin_ = hdf5().Dget_offset(dataset_.id);
    dataset_.file.check(0, dataset_.what);
    if (begin_ == HADDR_UNDEF) dataset_.fail(Status::kBadData, "was never written");
  }

  void readAt(uint64_t offset, void* out, size_t size) override {
    const Hdf5Turn turn;
    if (dataset_.file.storage().readAt(begin_ + offset, out, size) < size)
      dataset_.fail(Status::kBadData, "is longer than the file");
  }

 private:
  Dataset dataset_;
  haddr_t begin_;
};

// In the dataset's head, which is in memory anyway.
class CompactBytes final : public ValueBytes {
 public:
  explicit CompactBytes(const Dataset& dataset)
      : bytes_(static_cast<size_t>(dataset.shape.rows * dataset.shape.components) *
               dataset.shape.element) {
    const Hdf5Functions& h = hdf5();
    const Hdf5Id type(dataset.file.check(h.Dget_type(dataset.id), dataset.what), h.Tclose);
    if (!bytes_.empty())
      dataset.file.check(h.Dread(dataset.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_.data()),
                         dataset.what);
  }

  void readAt(uint64_t offset, void* out, size_t size) override {
    std::memcpy(out, bytes_.data() + offset, size);
  }

 private:
  std::vector<unsigned char> bytes_;
};

// In chunks of some rows and columns, of which those of further directions are one. A band is what
// the chunks of the same rows hold, as rows.
class ChunkedBytes final : public ValueBytes {
 public:
  explicit ChunkedBytes(Dataset dataset) : dataset_(std::move(dataset)) {
    const Hdf5Shape& shape = dataset_.shape;
    readChunkSize();
    row_bytes_ = shape.components * shape.element;
    const uint64_t widest = std::max<uint64_t>(shape.components, chunk_[1]) * shape.element;
    if (widest > kMaxBandBytes || chunk_[0] > kMaxBandBytes / widest)
      dataset_.fail(Status::kUnsupported, "has chunks of more than 256 MiB");
    chunk_bytes_ = static_cast<size_t>(chunk_[0] * chunk_[1]) * shape.element;
    readFilters();
  }

  void readAt(uint64_t offset, void* out, size_t size) override {
    auto* to = static_cast<unsigned char*>(out);
    const uint64_t band_bytes = chunk_[0] * row_bytes_;
    while (size > 0) {
      const uint64_t band = offset / band_bytes, within = offset % band_bytes;
      if (band != held_) load(band);
      const size_t n = static_cast<size_t>(std::min<uint64_t>(size, band_bytes - within));
      std::memcpy(to, band_.data() + within, n);
      to += n;
      offset += n;
      size -= n;
    }
  }

 private:
  struct Filter {
    Hdf5Filter kind;
    size_t element;
  };

  void readChunkSize() {
    const Hdf5Functions& h = hdf5();
    hsize_t sizes[kMostHdf5Dimensions];
    const Hdf5Id space(dataset_.file.check(h.Dget_space(dataset_.id), dataset_.what), h.Sclose);
    dataset_.file.check(h.Sget_simple_extent_dims(space, sizes, nullptr), dataset_.what);
    const int dimensions = dataset_.file.check(
        h.Pget_chunk(dataset_.plan, kMostHdf5Dimensions, chunk_), dataset_.what);
    if (dimensions != dataset_.shape.dimensions || chunk_[0] == 0 || chunk_[1] == 0)
      dataset_.fail(Status::kBadData, "has chunks of other dimensions");
    for (int d = 2; d < dimensions; ++d)
      if (chunk_[d] != sizes[d])
        dataset_.fail(Status::kUnsupported, "has chunks that are cut in the third direction");
    if (chunk_[1] > kMaxBandBytes / std::max<uint64_t>(dataset_.shape.inner, 1))
      dataset_.fail(Status::kUnsupported, "has chunks of more than 256 MiB");
    chunk_[1] *= dataset_.shape.inner;
  }

  void readFilters() {
    const int count = dataset_.file.check(hdf5().Pget_nfilters(dataset_.plan), dataset_.what);
    for (int i = 0; i < count; ++i) {
      unsigned flags = 0, values[8] = {}, config = 0;
      size_t value_count = std::size(values);
      char name[64] = {};
      const H5Z_filter_t filter =
          dataset_.file.check(hdf5().Pget_filter2(dataset_.plan, static_cast<unsigned>(i), &flags,
                                                  &value_count, values, sizeof name, name, &config),
                              dataset_.what);
      switch (filter) {
        case H5Z_FILTER_DEFLATE:
          filters_.push_back({Hdf5Filter::kDeflate, 0});
          break;
        case H5Z_FILTER_SHUFFLE:
          filters_.push_back({Hdf5Filter::kShuffle, values[0]});
          break;
        case H5Z_FILTER_FLETCHER32:
          filters_.push_back({Hdf5Filter::kFletcher32, 0});
          break;
        default:
          tetstream::fail(
              Status::kUnsupported,
              "%s: %s has HDF5's filter %d (\"%.63s\"); deflate, shuffle and fletcher32 are read",
              dataset_.file.name().c_str(), dataset_.what.c_str(), static_cast<int>(filter), name);
      }
    }
  }

  void load(uint64_t band) {
    const Hdf5Turn turn;
    held_ = UINT64_MAX;  // should one of them be damaged
    const uint64_t columns = dataset_.shape.components;
    if (chunk_[1] == columns) {
      readChunk(band * chunk_[0], 0, band_);
    } else {
      band_.resize(static_cast<size_t>(chunk_[0] * row_bytes_));
      for (uint64_t column = 0; column < columns; column += chunk_[1]) {
        readChunk(band * chunk_[0], column, part_);
        copyColumns(column, std::min<uint64_t>(chunk_[1], columns - column));
      }
    }
    held_ = band;
  }

  void copyColumns(uint64_t column, uint64_t count) {
    const size_t element = dataset_.shape.element, width = static_cast<size_t>(count) * element;
    const unsigned char* from = part_.data();
    unsigned char* to = band_.data() + column * element;
    for (uint64_t row = 0; row < chunk_[0]; ++row, from += chunk_[1] * element, to += row_bytes_)
      std::memcpy(to, from, width);
  }

  // note: a chunk's size is asked for and its bytes are read by the same record of the library's.
  void readChunk(uint64_t row, uint64_t column, Hdf5Chunk& out) {
    const hsize_t place[kMostHdf5Dimensions] = {row, column / dataset_.shape.inner};
    hsize_t stored = 0;
    haddr_t address = 0;
    unsigned left_out = 0;
    dataset_.file.check(
        hdf5().Dget_chunk_info_by_coord(dataset_.id, place, &left_out, &address, &stored),
        dataset_.what);
    if (stored == 0) return fillChunk(out);
    if (stored > 2 * uint64_t{chunk_bytes_} + 1024 || stored > dataset_.file.storage().size())
      dataset_.fail(Status::kBadData, "has a chunk that is longer than it may be");
    out.resize(static_cast<size_t>(stored));
    dataset_.file.check(hdf5().Dread_chunk(dataset_.id, H5P_DEFAULT, place, &left_out, out.data()),
                        dataset_.what);
    if (!undoFilters(left_out, out) || out.size() != chunk_bytes_) failChunk(row);
  }

  // One that was never written.
  void fillChunk(Hdf5Chunk& out) {
    const Hdf5Functions& h = hdf5();
    std::vector<unsigned char> fill(dataset_.shape.element);  // zeros, where the file has no value
    const Hdf5Id type(dataset_.file.check(h.Dget_type(dataset_.id), dataset_.what), h.Tclose);
    // note: that it is asked for first is a check: of a damaged value libhdf5 follows a null
    // pointer.
    H5D_fill_value_t defined = H5D_FILL_VALUE_UNDEFINED;
    dataset_.file.check(h.Pfill_value_defined(dataset_.plan, &defined), dataset_.what);
    if (defined == H5D_FILL_VALUE_USER_DEFINED)
      dataset_.file.check(h.Pget_fill_value(dataset_.plan, type, fill.data()), dataset_.what);
    out.resize(chunk_bytes_);
    for (size_t at = 0; at < chunk_bytes_; at += fill.size())
      std::memcpy(out.data() + at, fill.data(), fill.size());
  }

  bool undoFilters(uint32_t left_out, Hdf5Chunk& chunk) const {
    for (size_t i = filters_.size(); i-- > 0;) {
      if (i < 32 && left_out >> i & 1) continue;
      const bool good = filters_[i].kind == Hdf5Filter::kDeflate
                            ? inflateChunk(chunk, chunk_bytes_ + 4 * filters_.size())
                        : filters_[i].kind == Hdf5Filter::kShuffle
                            ? unshuffleChunk(chunk, filters_[i].element)
                            : checkFletcher32(chunk);
      if (!good) return false;
    }
    return true;
  }

  [[noreturn]] void failChunk(uint64_t row) const {
    tetstream::fail(Status::kBadData, "%s: %s: the chunk of row %llu is damaged",
                    dataset_.file.name().c_str(), dataset_.what.c_str(),
                    static_cast<unsigned long long>(row));
  }

  Dataset dataset_;
  hsize_t chunk_[kMostHdf5Dimensions] = {1, 1};  // rows and columns, once it was read
  uint64_t row_bytes_ = 0, held_ = UINT64_MAX;
  size_t chunk_bytes_ = 0;
  std::vector<Filter> filters_;
  Hdf5Chunk band_, part_;
};

}  // namespace

std::unique_ptr<ValueBytes> openHdf5Bytes(Hdf5File& file, const std::string& path,
                                          const Hdf5Shape& shape) {
  const Hdf5Functions& h = hdf5();
  const std::string what = "dataset \"" + path + "\"";
  Hdf5Id id = file.openDataset(path);
  Hdf5Id plan(file.check(h.Dget_create_plist(id), what), h.Pclose);
  const H5D_layout_t layout = h.Pget_layout(plan);
  Dataset dataset{file, what, std::move(id), std::move(plan), shape};
  if (layout == H5D_CHUNKED) return std::make_unique<ChunkedBytes>(std::move(dataset));
  if (layout == H5D_COMPACT) return std::make_unique<CompactBytes>(dataset);
  if (layout == H5D_CONTIGUOUS) return std::make_unique<ContiguousBytes>(std::move(dataset));
  dataset.fail(Status::kUnsupported, "lies in other datasets");
}

}  // namespace tetstream
#endif
