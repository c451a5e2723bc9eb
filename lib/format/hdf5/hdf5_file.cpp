#include "hdf5_file.h"

#ifdef TETSTREAM_WITH_HDF5
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "hdf5_bytes.h"
#include "hdf5_driver.h"
#include "status.h"

namespace tetstream {

// Deflate makes at most 1032 bytes of one; filters that do better are not for numbers.
constexpr uint64_t kMaxHdf5Ratio = 1040;
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
  return Hdf5Id(check(hdf5().Dopen2(file_, path.c_str(), H5P_DEFAULT), "dataset \"" + path + "\""),
                hdf5().Dclose);
}

static bool findType(hid_t type, ValueType* out) {
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

// Whether all of its bits lie as in a type of ours, but for the order of the bytes.
bool Hdf5File::readType(hid_t type, Hdf5Shape* shape) {
  if (!findType(type, &shape->type)) return false;
  const Hdf5Functions& h = hdf5();
  const hid_t ours = hdf5Type(shape->type);
  const Hdf5Id turned(check(h.Tcopy(type), "a type"), h.Tclose);
  check(h.Tset_order(turned, h.Tget_order(ours)), "a type");
  shape->element = sizeOf(shape->type);
  shape->big_endian = h.Tget_order(type) == H5T_ORDER_BE;
  return h.Tequal(turned, ours) > 0;
}

// More than there is of anything where it is too large, which checkStorage tells.
static uint64_t productOf(uint64_t a, uint64_t b) {
  uint64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? UINT64_MAX : product;
}

Hdf5Shape Hdf5File::shapeOf(const std::string& path) {
  const std::string what = "dataset \"" + path + "\"";
  const Hdf5Id dataset = openDataset(path);
  const Hdf5Id space(check(hdf5().Dget_space(dataset), what), hdf5().Sclose);
  const Hdf5Id type(check(hdf5().Dget_type(dataset), what), hdf5().Tclose);
  Hdf5Shape shape;
  shape.dimensions = check(hdf5().Sget_simple_extent_ndims(space), what);
  if (shape.dimensions < 1 || shape.dimensions > kMostHdf5Dimensions) return shape;
  shape.numbers = readType(type, &shape);
  shape.characters =
      shape.dimensions <= 2 && hdf5().Tget_class(type) == H5T_STRING && hdf5().Tget_size(type) == 1;
  if (!shape.numbers && !shape.characters) return shape;
  hsize_t sizes[kMostHdf5Dimensions] = {0, 1};
  check(hdf5().Sget_simple_extent_dims(space, sizes, nullptr), what);
  shape.rows = sizes[0];
  for (int d = 2; d < shape.dimensions; ++d) shape.inner = productOf(shape.inner, sizes[d]);
  shape.components = shape.dimensions > 1 ? productOf(shape.inner, sizes[1]) : 1;
  checkStorage(dataset, shape, path);
  return shape;
}

// Space that was never written costs a file nothing and may be claimed without end.
void Hdf5File::checkStorage(hid_t dataset, const Hdf5Shape& shape, const std::string& path) {
  const Hdf5Id plan(check(hdf5().Dget_create_plist(dataset), path), hdf5().Pclose);
  if (hdf5().Pget_external_count(plan) > 0)
    fail(Status::kUnsupported, "%s: dataset \"%s\" lies in other files", name_.c_str(),
         path.c_str());
  const hsize_t held = hdf5().Dget_storage_size(dataset);
  check(0, path);  // note: where that could not be read it is 0, too
  const uint64_t stored = std::min<uint64_t>(held, storage_->size());
  // Only chunks are compressed. note: of data in the dataset's own head libhdf5 believes the
  // extent.
  const uint64_t ratio = hdf5().Pget_layout(plan) == H5D_CHUNKED ? kMaxHdf5Ratio : 1;
  const uint64_t most = stored * ratio / shape.element;
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
  openValues(path, shape)->read(0, numbers.size(), numbers.data(), ScalarType::kInt64);
  return numbers;
}

std::vector<std::string> Hdf5File::texts(const std::string& path, size_t most) {
  const std::string what = "dataset \"" + path + "\"";
  const Hdf5Shape shape = shapeOf(path);
  if (!shape.characters || shape.dimensions != 2)
    fail(Status::kBadData, "%s: %s is no list of names", name_.c_str(), what.c_str());
  if (shape.rows > most || shape.components > kMaxHdf5Name)
    fail(Status::kUnsupported, "%s: %s has more than %zu names, or longer ones than %zu bytes",
         name_.c_str(), what.c_str(), most, kMaxHdf5Name);
  const auto width = static_cast<size_t>(shape.components);
  std::string all(static_cast<size_t>(shape.rows) * width, 0);
  openHdf5Bytes(*this, path, shape)->readAt(0, all.data(), all.size());
  std::vector<std::string> rows;
  for (size_t i = 0; i < shape.rows; ++i) rows.push_back(all.substr(i * width, width));
  return rows;
}

std::unique_ptr<Values> Hdf5File::openValues(const std::string& path, const Hdf5Shape& shape) {
  return openBinaryValues(openHdf5Bytes(*this, path, shape), name_ + ": dataset \"" + path + "\"",
                          shape.type, shape.big_endian);
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
      : file_(std::move(file)), first_(first) {
    const Hdf5Turn turn;
    values_ = file_->openValues(path, file_->shapeOf(path));
  }

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    values_->read(first_ + first, count, out, type);
  }

 private:
  std::shared_ptr<Hdf5File> file_;
  uint64_t first_;
  std::unique_ptr<Values> values_;
};

}  // namespace

std::unique_ptr<Values> openHdf5Values(std::shared_ptr<Hdf5File> file, const std::string& path,
                                       uint64_t first) {
  return std::make_unique<Hdf5Values>(std::move(file), path, first);
}

}  // namespace tetstream
#endif
