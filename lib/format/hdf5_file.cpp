#include "hdf5_file.h"

#ifdef TETSTREAM_WITH_HDF5
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "hdf5_driver.h"
#include "status.h"

namespace tetstream {

// Deflate makes at most 1032 bytes of one; filters that do better are not for numbers.
constexpr uint64_t kMaxHdf5Ratio = 1040;
// Chunks are decompressed whole; VTK's have some hundred kilobytes.
constexpr uint64_t kMaxChunkBytes = uint64_t{256} << 20;
constexpr size_t kMaxText = 256, kMaxHdf5Name = 4096;
// H5F_ACC_RDONLY and H5F_ACC_TRUNC; the macros themselves call the library.
constexpr unsigned kReadOnly = 0, kTruncate = 2;

void Hdf5Id::close() noexcept {
  if (id_ < 0) return;
  const Hdf5Turn turn;
  close_(id_);
  id_ = -1;
}

Hdf5File::Hdf5File(std::unique_ptr<Hdf5Storage> storage, const std::string& name, bool create)
    : storage_(std::move(storage)), name_(name), link_(this) {
  const Hdf5Turn turn;
  const Hdf5Id access = hdf5AccessOf(*this);
  const hid_t file = create ? hdf5().Fcreate(name.c_str(), kTruncate, H5P_DEFAULT, access)
                            : hdf5().Fopen(name.c_str(), kReadOnly, access);
  file_ = Hdf5Id(file, hdf5().Fclose);
  check(file, create ? "cannot begin the file" : "this is no HDF5 file that can be read");
}

Hdf5File::~Hdf5File() {
  file_.close();  // while the storage lives
}

void Hdf5File::close() {
  const Hdf5Turn turn;
  check(hdf5().Fclose(file_.release()), "cannot complete the file");
}

// The innermost record of the library's error stack tells most.
static herr_t takeWords(unsigned, const H5E_error2_t* error, void* words) {
  std::string& text = *static_cast<std::string*>(words);
  if (text.empty() && error->desc) text = error->desc;
  return 0;
}

void Hdf5File::failCall(const std::string& what) {
  if (failed_) std::rethrow_exception(failed_);
  std::string words;
  hdf5().Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, takeWords, &words);
  hdf5().Eclear2(H5E_DEFAULT);
  fail(Status::kBadData, "%s: %s%s%s", name_.c_str(), what.c_str(),
       words.empty() ? "" : ": HDF5: ", words.c_str());
}

bool Hdf5File::has(const std::string& path) {
  for (size_t slash = path.find('/');; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    if (hdf5().Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) {
      check(0, "");
      return false;
    }
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::datasetsOf(const std::string& path) {
  std::vector<std::string> names;
  if (!has(path)) return names;
  const Hdf5Id group(check(hdf5().Gopen2(file_, path.c_str(), H5P_DEFAULT), "\"" + path + "\""),
                     hdf5().Gclose);
  H5G_info_t info;
  check(hdf5().Gget_info(group, &info), "\"" + path + "\"");
  constexpr hsize_t kMaxNames = 1 << 12;
  if (info.nlinks > kMaxNames) fail(Status::kUnsupported, "%s: too many arrays", name_.c_str());
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[4096];
    check(hdf5().Lget_name_by_idx(file_, path.c_str(), H5_INDEX_NAME, H5_ITER_INC, i, name,
                                  sizeof name, H5P_DEFAULT),
          "\"" + path + "\"");
    const Hdf5Id object(hdf5().Oopen(group, name, H5P_DEFAULT), hdf5().Oclose);
    check(0, "\"" + path + "\"");
    if (object >= 0 && hdf5().Iget_type(object) == H5I_DATASET) names.emplace_back(name);
  }
  return names;
}

Hdf5Id Hdf5File::openDataset(const std::string& path) {
  const std::string what = "dataset \"" + path + "\"";
  Hdf5Id dataset(check(hdf5().Dopen2(file_, path.c_str(), H5P_DEFAULT), what), hdf5().Dclose);
  const Hdf5Id plan(check(hdf5().Dget_create_plist(dataset), what), hdf5().Pclose);
  if (hdf5().Pget_layout(plan) != H5D_CHUNKED) return dataset;
  hsize_t chunk[2] = {1, 1};
  const int dimensions = check(hdf5().Pget_chunk(plan, 2, chunk), what);
  const Hdf5Id type(check(hdf5().Dget_type(dataset), what), hdf5().Tclose);
  const uint64_t limit = kMaxChunkBytes / std::max<size_t>(hdf5().Tget_size(type), 1);
  if (dimensions > 2 || chunk[0] > limit || chunk[1] > limit / std::max<hsize_t>(chunk[0], 1))
    fail(Status::kUnsupported, "%s: %s has chunks of more than 256 MiB", name_.c_str(),
         what.c_str());
  // Two chunks in memory: else each of them would be read anew for each part.
  const size_t bytes = static_cast<size_t>(chunk[0] * chunk[1]) * hdf5().Tget_size(type);
  const Hdf5Id access(check(hdf5().Pcreate(hdf5().P_CLS_DATASET_ACCESS_ID), what), hdf5().Pclose);
  check(hdf5().Pset_chunk_cache(access, 127, 2 * bytes, 1.0), what);
  return Hdf5Id(check(hdf5().Dopen2(file_, path.c_str(), access), what), hdf5().Dclose);
}

static bool readType(hid_t type, ValueType* out) {
  const H5T_class_t kind = hdf5().Tget_class(type);
  const size_t size = hdf5().Tget_size(type);
  if (kind == H5T_FLOAT && (size == 4 || size == 8)) {
    *out = size == 4 ? ValueType::kFloat32 : ValueType::kFloat64;
    return true;
  }
  if (kind != H5T_INTEGER) return false;
  const bool is_unsigned = hdf5().Tget_sign(type) == H5T_SGN_NONE;
  for (int i = 0; i < 4; ++i)
    if (size == size_t{1} << i) {
      *out = static_cast<ValueType>(2 * i + is_unsigned);
      return true;
    }
  return false;
}

Hdf5Shape Hdf5File::shapeOf(const std::string& path) {
  const std::string what = "dataset \"" + path + "\"";
  const Hdf5Id dataset(check(hdf5().Dopen2(file_, path.c_str(), H5P_DEFAULT), what), hdf5().Dclose);
  const Hdf5Id space(check(hdf5().Dget_space(dataset), what), hdf5().Sclose);
  const Hdf5Id type(check(hdf5().Dget_type(dataset), what), hdf5().Tclose);
  Hdf5Shape shape;
  shape.dimensions = check(hdf5().Sget_simple_extent_ndims(space), what);
  shape.numbers = readType(type, &shape.type) && (shape.dimensions == 1 || shape.dimensions == 2);
  if (!shape.numbers) return shape;
  hsize_t sizes[2] = {0, 1};
  check(hdf5().Sget_simple_extent_dims(space, sizes, nullptr), what);
  shape.rows = sizes[0];
  shape.components = sizes[1];
  checkStorage(dataset, shape, path);
  return shape;
}

// Space that was never written costs a file nothing and may be claimed without end.
void Hdf5File::checkStorage(hid_t dataset, const Hdf5Shape& shape, const std::string& path) {
  const Hdf5Id plan(check(hdf5().Dget_create_plist(dataset), path), hdf5().Pclose);
  if (hdf5().Pget_external_count(plan) > 0)
    fail(Status::kUnsupported, "%s: dataset \"%s\" lies in other files", name_.c_str(),
         path.c_str());
  const uint64_t stored = std::min<uint64_t>(hdf5().Dget_storage_size(dataset), storage_->size());
  // Only chunks are compressed. note: of data in the dataset's own head libhdf5 believes the
  // extent.
  const uint64_t ratio = hdf5().Pget_layout(plan) == H5D_CHUNKED ? kMaxHdf5Ratio : 1;
  const uint64_t most = stored * ratio / sizeOf(shape.type);
  if (shape.rows == 0 || shape.components == 0) return;
  if (shape.rows > most || shape.components > most / shape.rows)
    fail(Status::kBadData, "%s: dataset \"%s\" claims %llu rows of %llu, in %llu bytes",
         name_.c_str(), path.c_str(), static_cast<unsigned long long>(shape.rows),
         static_cast<unsigned long long>(shape.components),
         static_cast<unsigned long long>(stored));
}

bool Hdf5File::hasAttribute(const std::string& path, const std::string& attribute) {
  const std::string what = "\"" + path + "\"";
  const Hdf5Id object(check(hdf5().Oopen(file_, path.c_str(), H5P_DEFAULT), what), hdf5().Oclose);
  return check(hdf5().Aexists(object, attribute.c_str()), what) > 0;
}

std::string Hdf5File::textAttribute(const std::string& path, const std::string& attribute) {
  const std::string what = "attribute \"" + attribute + "\" of \"" + path + "\"";
  const Hdf5Id object(check(hdf5().Oopen(file_, path.c_str(), H5P_DEFAULT), what), hdf5().Oclose);
  const Hdf5Id found(check(hdf5().Aopen(object, attribute.c_str(), H5P_DEFAULT), what),
                     hdf5().Aclose);
  const Hdf5Id type(check(hdf5().Aget_type(found), what), hdf5().Tclose);
  const Hdf5Id space(check(hdf5().Aget_space(found), what), hdf5().Sclose);
  const size_t size = hdf5().Tget_size(type);
  if (hdf5().Tget_class(type) != H5T_STRING || hdf5().Sget_simple_extent_npoints(space) != 1 ||
      size > kMaxText)
    fail(Status::kBadData, "%s: %s is no word", name_.c_str(), what.c_str());
  char text[kMaxText + 1] = {};
  if (hdf5().Tis_variable_str(type) <= 0) {
    check(hdf5().Aread(found, type, text), what);
    return text;
  }
  char* pointed = nullptr;
  check(hdf5().Aread(found, type, &pointed), what);
  std::string copy = pointed ? std::string(pointed).substr(0, kMaxText) : "";
  std::free(pointed);
  return copy;
}

std::vector<int64_t> Hdf5File::integers(const std::string& path, size_t most) {
  const Hdf5Shape shape = shapeOf(path);
  if (!shape.numbers || isFloat(shape.type) || shape.components != 1)
    fail(Status::kBadData, "%s: dataset \"%s\" is no list of integers", name_.c_str(),
         path.c_str());
  if (shape.rows > most)
    fail(Status::kUnsupported, "%s: dataset \"%s\" has more than %zu numbers", name_.c_str(),
         path.c_str(), most);
  std::vector<int64_t> numbers(static_cast<size_t>(shape.rows));
  const Hdf5Id dataset = openDataset(path);
  if (!numbers.empty())
    check(
        hdf5().Dread(dataset, hdf5().T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()),
        "dataset \"" + path + "\"");
  return numbers;
}

std::vector<std::string> Hdf5File::texts(const std::string& path, size_t most) {
  const std::string what = "dataset \"" + path + "\"";
  const Hdf5Id dataset = openDataset(path);
  const Hdf5Id space(check(hdf5().Dget_space(dataset), what), hdf5().Sclose);
  const Hdf5Id type(check(hdf5().Dget_type(dataset), what), hdf5().Tclose);
  hsize_t sizes[2] = {0, 0};
  if (hdf5().Tget_class(type) != H5T_STRING || hdf5().Tget_size(type) != 1 ||
      check(hdf5().Sget_simple_extent_ndims(space), what) != 2)
    fail(Status::kBadData, "%s: %s is no list of names", name_.c_str(), what.c_str());
  check(hdf5().Sget_simple_extent_dims(space, sizes, nullptr), what);
  if (sizes[0] > most || sizes[1] > kMaxHdf5Name)
    fail(Status::kUnsupported, "%s: %s has more than %zu names, or longer ones than %zu bytes",
         name_.c_str(), what.c_str(), most, kMaxHdf5Name);
  const auto width = static_cast<size_t>(sizes[1]);
  std::string all(static_cast<size_t>(sizes[0]) * width, 0);
  if (!all.empty())
    check(hdf5().Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), what);
  std::vector<std::string> rows;
  for (size_t i = 0; i < sizes[0]; ++i) rows.push_back(all.substr(i * width, width));
  return rows;
}

Hdf5Id Hdf5File::createGroup(const std::string& path) {
  return Hdf5Id(check(hdf5().Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                      "cannot write \"" + path + "\""),
                hdf5().Gclose);
}

Hdf5Id Hdf5File::create(const std::string& path, hid_t type, hid_t space, hid_t plan) {
  return Hdf5Id(
      check(hdf5().Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, plan, H5P_DEFAULT),
            "cannot write \"" + path + "\""),
      hdf5().Dclose);
}

void Hdf5File::addAttribute(hid_t object, const char* attribute, const std::string& text) {
  const std::string what = std::string("cannot write ") + attribute;
  const Hdf5Id type(check(hdf5().Tcopy(hdf5().T_C_S1), what), hdf5().Tclose);
  check(hdf5().Tset_size(type, text.size()), what);
  const Hdf5Id space(check(hdf5().Screate(H5S_SCALAR), what), hdf5().Sclose);
  const Hdf5Id made(
      check(hdf5().Acreate2(object, attribute, type, space, H5P_DEFAULT, H5P_DEFAULT), what),
      hdf5().Aclose);
  check(hdf5().Awrite(made, type, text.data()), what);
}

void Hdf5File::addAttribute(hid_t object, const char* attribute,
                            const std::vector<int64_t>& numbers) {
  const std::string what = std::string("cannot write ") + attribute;
  const hsize_t size = numbers.size();
  const Hdf5Id space(check(hdf5().Screate_simple(1, &size, nullptr), what), hdf5().Sclose);
  const Hdf5Id made(check(hdf5().Acreate2(object, attribute, hdf5().T_NATIVE_INT64, space,
                                          H5P_DEFAULT, H5P_DEFAULT),
                          what),
                    hdf5().Aclose);
  check(hdf5().Awrite(made, hdf5().T_NATIVE_INT64, numbers.data()), what);
}

namespace {

class SourceStorage final : public Hdf5Storage {
 public:
  explicit SourceStorage(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {}
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return bytes_->readAt(offset, out, size);
  }
  void writeAt(uint64_t, const void*, size_t) override {
    fail(Status::kInternal, "%s: HDF5 writes to a file that is read", bytes_->name().c_str());
  }
  void resize(uint64_t) override {}
  uint64_t size() const override { return bytes_->size(); }

 private:
  std::unique_ptr<ByteSource> bytes_;
};

}  // namespace

std::shared_ptr<Hdf5File> openHdf5(std::unique_ptr<ByteSource> bytes) {
  const std::string name = bytes->name();
  return std::make_shared<Hdf5File>(std::make_unique<SourceStorage>(std::move(bytes)), name, false);
}

hid_t hdf5Type(ValueType type) {
  const Hdf5Functions& h = hdf5();
  const hid_t types[] = {h.T_NATIVE_INT8,  h.T_NATIVE_UINT8,  h.T_NATIVE_INT16, h.T_NATIVE_UINT16,
                         h.T_NATIVE_INT32, h.T_NATIVE_UINT32, h.T_NATIVE_INT64, h.T_NATIVE_UINT64,
                         h.T_NATIVE_FLOAT, h.T_NATIVE_DOUBLE};
  return types[static_cast<int>(type)];
}

namespace {

class Hdf5Values final : public Values {
 public:
  Hdf5Values(std::shared_ptr<Hdf5File> file, const std::string& path, uint64_t first)
      : file_(std::move(file)), what_("dataset \"" + path + "\""), first_(first) {
    const Hdf5Turn turn;
    shape_ = file_->shapeOf(path);
    dataset_ = file_->openDataset(path);
  }

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    if (isSame(shape_.type, type)) return readStored(first_ + first, count, to);
    const size_t row = static_cast<size_t>(shape_.components);
    const size_t at_once = row < kConverted ? kConverted / row * row : kConverted;
    stored_.resize(at_once * sizeOf(shape_.type));
    while (count > 0) {
      const size_t n = std::min(count, at_once);
      readStored(first_ + first, n, stored_.data());
      convertValues(stored_.data(), {shape_.type, file_->name() + ": " + what_, first}, to, type,
                    n);
      to += n * sizeOf(type);
      first += n;
      count -= n;
    }
  }

 private:
  static constexpr size_t kConverted = 4096;  // values

  // A part of a row, then whole rows, then a part of one.
  void readStored(uint64_t first, size_t count, unsigned char* out) {
    const Hdf5Turn turn;
    const uint64_t row = shape_.components;
    for (size_t n; count > 0; first += n, count -= n, out += n * sizeOf(shape_.type)) {
      const uint64_t column = first % row;
      const bool whole = column == 0 && count >= row;
      n = static_cast<size_t>(whole ? count - count % row
                                    : std::min<uint64_t>(count, row - column));
      const hsize_t start[2] = {first / row, column};
      const hsize_t size[2] = {whole ? n / row : 1, whole ? row : n};
      readSlab(start, size, out);
    }
  }

  void readSlab(const hsize_t* start, const hsize_t* size, void* out) {
    const Hdf5Functions& h = hdf5();
    const Hdf5Id space(file_->check(h.Dget_space(dataset_), what_), h.Sclose);
    // Of as many dimensions: else the library goes value by value.
    const Hdf5Id memory(file_->check(h.Screate_simple(shape_.dimensions, size, nullptr), what_),
                        h.Sclose);
    file_->check(h.Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr), what_);
    file_->check(h.Dread(dataset_, hdf5Type(shape_.type), memory, space, H5P_DEFAULT, out), what_);
  }

  std::shared_ptr<Hdf5File> file_;
  std::string what_;
  uint64_t first_;
  Hdf5Shape shape_;
  Hdf5Id dataset_;
  std::vector<unsigned char> stored_;
};

}  // namespace

std::unique_ptr<Values> openHdf5Values(std::shared_ptr<Hdf5File> file, const std::string& path,
                                       uint64_t first) {
  return std::make_unique<Hdf5Values>(std::move(file), path, first);
}

}  // namespace tetstream
#endif
