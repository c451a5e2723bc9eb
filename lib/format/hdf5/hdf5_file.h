// format/hdf5: HDF5 files and what is in them, whose bytes lie where the caller says. Depends on
// hdf5_library.h, values.h.
#pragma once

#ifdef TETSTREAM_WITH_HDF5
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bytes.h"
#include "hdf5_library.h"
#include "values.h"

namespace tetstream {

// Where the library's bytes are. Errors may be thrown: they come out of the call that met them.
class Hdf5Storage {
 public:
  virtual ~Hdf5Storage() = default;
  virtual size_t readAt(uint64_t offset, void* out, size_t size) = 0;  // less only at the end
  virtual void writeAt(uint64_t offset, const void* data, size_t size) = 0;
  virtual void resize(uint64_t size) = 0;
  virtual uint64_t size() const = 0;
};

// A handle of the library. Closed in a turn of its own.
class Hdf5Id {
 public:
  Hdf5Id() = default;
  Hdf5Id(hid_t id, herr_t (*closing)(hid_t)) : id_(id), close_(closing) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Id() { close(); }
  void close() noexcept;
  hid_t release() { return std::exchange(id_, -1); }  // the caller closes it
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

constexpr int kMostHdf5Dimensions = 8;  // libhdf5 has up to 32

// What a dataset holds, as far as we read it.
struct Hdf5Shape {
  bool numbers = false;     // of a type of ours
  bool characters = false;  // single ones
  ValueType type = ValueType::kFloat32;
  size_t element = 1;  // bytes
  bool big_endian = false;
  uint64_t rows = 0;
  uint64_t components = 1;  // of all directions but the first
  uint64_t inner = 1;       // of those but the second: so many values are one of its
  int dimensions = 1;       // 2: rows and components
};

class Hdf5File;

// By which the library's driver knows our file; null when that is gone.
struct Hdf5Link {
  Hdf5File* file;
};

class Hdf5LinkEnd {
 public:
  explicit Hdf5LinkEnd(Hdf5File* file) : link_(std::make_shared<Hdf5Link>(Hdf5Link{file})) {}
  ~Hdf5LinkEnd() { link_->file = nullptr; }
  Hdf5LinkEnd(const Hdf5LinkEnd&) = delete;
  Hdf5LinkEnd& operator=(const Hdf5LinkEnd&) = delete;
  const std::shared_ptr<Hdf5Link>& link() const { return link_; }

 private:
  std::shared_ptr<Hdf5Link> link_;
};

class Hdf5File {
 public:
  // Opens an existing file, or creates one in an empty storage. `name` is for messages.
  Hdf5File(std::unique_ptr<Hdf5Storage> storage, const std::string& name, bool create);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  const std::string& name() const { return name_; }
  Hdf5Storage& storage() const { return *storage_; }
  const std::shared_ptr<Hdf5Link>& link() const { return link_.link(); }
  void close();  // of one that was created: everything is written

  // Everything below is to be called in a turn; paths are as in "VTKHDF/Points".
  bool has(const std::string& path);
  std::vector<std::string> datasetsOf(const std::string& group);  // by name; none: no such group
  Hdf5Shape shapeOf(const std::string& path);  // throws if it claims more than the file can hold
  bool hasAttribute(const std::string& object, const std::string& attribute);
  std::string textAttribute(const std::string& object, const std::string& attribute);
  // The rows of a dataset of single characters.
  std::vector<std::string> texts(const std::string& path, size_t most);
  std::vector<int64_t> integers(const std::string& path, size_t most);
  // Of a dataset of numbers, which borrow the file. Read in turns of their own.
  std::unique_ptr<Values> openValues(const std::string& path, const Hdf5Shape& shape);

  Hdf5Id createGroup(const std::string& path);
  void addAttribute(hid_t object, const char* attribute, const std::string& text);
  void addAttribute(hid_t object, const char* attribute, const std::vector<int64_t>& numbers);

  Hdf5Id create(const std::string& path, hid_t type, hid_t space, hid_t plan);  // a dataset
  Hdf5Id openDataset(const std::string& path);
  // The result, or throws what the storage threw, or the library's own words after `what`.
  template <class Result>
  Result check(Result result, const std::string& what) {
    if (failed_ || result < 0) failCall(what);
    return result;
  }
  void keepError() noexcept {  // the first one
    if (!failed_) failed_ = std::current_exception();
  }

 private:
  [[noreturn]] void failCall(const std::string& what);
  bool readType(hid_t type, Hdf5Shape* shape);
  void checkStorage(hid_t dataset, const Hdf5Shape& shape, const std::string& path);

  std::unique_ptr<Hdf5Storage> storage_;
  std::string name_;
  Hdf5LinkEnd link_;
  std::exception_ptr failed_;  // in the storage
  Hdf5Id file_;
};

// A file that is read from a seekable source.
std::shared_ptr<Hdf5File> openHdf5(std::unique_ptr<ByteSource> bytes);

// The library's number of a type.
hid_t hdf5Type(ValueType type);

// The values of a dataset of numbers, row after row, from `first` on.
std::unique_ptr<Values> openHdf5Values(std::shared_ptr<Hdf5File> file, const std::string& path,
                                       uint64_t first);

}  // namespace tetstream
#endif
