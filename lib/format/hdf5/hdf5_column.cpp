#include "hdf5_column.h"

#ifdef TETSTREAM_WITH_HDF5
#include <algorithm>

namespace tetstream {

// Held of every column; with less, reading a column alone goes in steps too small for a disk.
constexpr size_t kHdf5ChunkBytes = 1 << 19;
constexpr int kDeflateLevel = 1;  // higher ones gain little on numbers and cost much

Hdf5Column::Hdf5Column(Hdf5File& file, const std::string& path, ValueType type, int components,
                       bool compress)
    : file_(file),
      path_(path),
      type_(type),
      components_(static_cast<size_t>(components)),
      row_bytes_(components_ * sizeOf(type)),
      chunk_rows_(kHdf5ChunkBytes / row_bytes_),
      compress_(compress) {}

// A small one is a single chunk, as large as it is.
void Hdf5Column::create(size_t chunk_rows) {
  const Hdf5Functions& h = hdf5();
  const std::string what = "cannot write \"" + path_ + "\"";
  const hsize_t none[2] = {0, components_}, all[2] = {H5S_UNLIMITED, components_};
  const hsize_t chunk[2] = {chunk_rows, components_};
  const Hdf5Id space(file_.check(h.Screate_simple(dimensions(), none, all), what), h.Sclose);
  const Hdf5Id plan(file_.check(h.Pcreate(h.P_CLS_DATASET_CREATE_ID), what), h.Pclose);
  file_.check(h.Pset_chunk(plan, dimensions(), chunk), what);
  file_.check(h.Pset_obj_track_times(plan, false), what);  // the same bytes at any time
  if (compress_ && h.Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    file_.check(h.Pset_shuffle(plan), what);
    file_.check(h.Pset_deflate(plan, kDeflateLevel), what);
  }
  dataset_ = file_.create(path_, hdf5Type(type_), space, plan);
}

void Hdf5Column::append(const void* rows, size_t count) {
  const unsigned char* from = static_cast<const unsigned char*>(rows);
  while (count > 0) {
    const size_t n = std::min(count, chunk_rows_ - held_.size() / row_bytes_);
    held_.insert(held_.end(), from, from + n * row_bytes_);
    if (held_.size() == chunk_rows_ * row_bytes_) writeHeld();
    from += n * row_bytes_;
    count -= n;
  }
}

void Hdf5Column::writeHeld() {
  const Hdf5Functions& h = hdf5();
  const size_t rows = held_.size() / row_bytes_;
  if (dataset_ < 0) create(std::max<size_t>(rows, 1));
  if (rows == 0) return;
  const std::string what = "cannot write \"" + path_ + "\"";
  const hsize_t start[2] = {written_, 0}, size[2] = {rows, components_};
  const hsize_t grown[2] = {written_ + rows, components_};
  file_.check(h.Dset_extent(dataset_, grown), what);
  const Hdf5Id space(file_.check(h.Dget_space(dataset_), what), h.Sclose);
  // Of as many dimensions: else the library goes value by value.
  const Hdf5Id memory(file_.check(h.Screate_simple(dimensions(), size, nullptr), what), h.Sclose);
  file_.check(h.Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr), what);
  file_.check(h.Dwrite(dataset_, hdf5Type(type_), memory, space, H5P_DEFAULT, held_.data()), what);
  written_ += rows;
  held_.clear();
}

void Hdf5Column::finish() {
  writeHeld();
  dataset_.close();
}

}  // namespace tetstream
#endif
