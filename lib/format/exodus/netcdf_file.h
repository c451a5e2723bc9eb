// format/exodus: netCDF files and their variables: the classic layout and its two with wider
// numbers, read here, and netCDF-4, which is HDF5. Depends on values.h, bytes.h.
//
// note: libnetcdf is not used: it wants a path or the whole file in memory, and what stands behind
// it would come with every program. The classic layouts are a table and arrays behind it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bytes.h"
#include "values.h"

namespace tetstream {

struct NetcdfVariable {
  ValueType type = ValueType::kInt8;
  bool text = false;            // characters: no numbers
  std::vector<uint64_t> sizes;  // per dimension; those of records are as many as there are

  uint64_t size(size_t dimension) const { return dimension < sizes.size() ? sizes[dimension] : 1; }
  uint64_t count() const;  // of values
};

class NetcdfFile {
 public:
  virtual ~NetcdfFile() = default;
  virtual const std::string& name() const = 0;
  // Null where there is none. It lives as long as the file.
  virtual const NetcdfVariable* find(const std::string& variable) = 0;
  // Of a variable that is there; "" where it has no such text.
  virtual std::string textAttribute(const std::string& variable, const std::string& attribute) = 0;
  // The variable's values, row after row, from `first` on. There are `count`, none of another
  // record than the first.
  virtual std::unique_ptr<Values> open(const std::string& variable, uint64_t first,
                                       uint64_t count) = 0;
  // The rows of a variable of characters, without what fills them up; none: no such variable.
  virtual std::vector<std::string> texts(const std::string& variable, size_t most) = 0;

  const NetcdfVariable& need(const std::string& variable);
  std::vector<int64_t> integers(const std::string& variable, size_t most);  // none: not there
  std::vector<double> reals(const std::string& variable, size_t most);

 private:
  template <class T>
  std::vector<T> numbers(const std::string& variable, size_t most, ScalarType type);
};

// A seekable source, of any of the layouts.
std::shared_ptr<NetcdfFile> openNetcdf(std::unique_ptr<ByteSource> bytes);
std::shared_ptr<NetcdfFile> openNetcdfClassic(std::unique_ptr<ByteSource> bytes);
std::shared_ptr<NetcdfFile> openNetcdfHdf5(std::unique_ptr<ByteSource> bytes);

// Text up to a zero byte, without blanks at the end.
std::string trimmedText(const std::string& text);

}  // namespace tetstream
