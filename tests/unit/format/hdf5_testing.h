// tests: HDF5 files in memory that a test looks into.
#pragma once

#include <dlfcn.h>

#include <string>
#include <vector>

#include "hdf5_column.h"
#include "status.h"

namespace tetstream::test {

class MemoryStorage final : public Hdf5Storage {
 public:
  explicit MemoryStorage(std::string& bytes) : bytes_(bytes) {}
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return offset < bytes_.size() ? bytes_.copy(static_cast<char*>(out), size, offset) : 0;
  }
  void writeAt(uint64_t offset, const void* data, size_t size) override {
    if (fail_at_ >= 0 && fail_at_-- == 0) fail(Status::kIo, "the disk is full");
    bytes_.resize(std::max<size_t>(bytes_.size(), offset + size));
    bytes_.replace(offset, size, static_cast<const char*>(data), size);
  }
  void resize(uint64_t size) override { bytes_.resize(size); }
  uint64_t size() const override { return bytes_.size(); }
  int fail_at_ = -1;

 private:
  std::string& bytes_;
};

// What of libhdf5 only tests call.
class Hdf5Library {
 public:
  Hdf5Library() {
    Dl_info info = {};
    ::dladdr(reinterpret_cast<void*>(hdf5().open), &info);
    library_ = ::dlopen(info.dli_fname, RTLD_NOW | RTLD_NOLOAD);
  }
  template <class Function>
  Function* call(const char* name) const {
    return reinterpret_cast<Function*>(::dlsym(library_, name));
  }
  hid_t number(const char* name) const {
    return *static_cast<const hid_t*>(::dlsym(library_, name));
  }

 private:
  void* library_;  // loaded by now, and stays so
};

// A dataset of rows.
template <class T>
void addColumn(Hdf5File& file, const std::string& path, ValueType type, int components,
               const std::vector<T>& values) {
  Hdf5Column column(file, path, type, components, false);
  column.append(values.data(), values.size() / static_cast<size_t>(components));
  column.finish();
}

}  // namespace tetstream::test
