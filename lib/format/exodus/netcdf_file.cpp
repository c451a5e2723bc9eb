#include "netcdf_file.h"

#include "status.h"

namespace tetstream {

uint64_t NetcdfVariable::count() const {
  uint64_t count = 1;
  for (const uint64_t size : sizes) count *= size;  // of a file's size at most: it was checked
  return count;
}

const NetcdfVariable& NetcdfFile::need(const std::string& variable) {
  const NetcdfVariable* found = find(variable);
  if (!found) fail(Status::kBadData, "%s: there is no \"%s\"", name().c_str(), variable.c_str());
  return *found;
}

template <class T>
std::vector<T> NetcdfFile::numbers(const std::string& variable, size_t most, ScalarType type) {
  const NetcdfVariable* found = find(variable);
  if (!found) return {};
  const uint64_t count = found->count();
  if (found->text || (isFloat(found->type) && !isFloat(type)))
    fail(Status::kBadData, "%s: \"%s\" has other values than numbers of its kind", name().c_str(),
         variable.c_str());
  if (count > most)
    fail(Status::kUnsupported, "%s: \"%s\" has more than %zu values", name().c_str(),
         variable.c_str(), most);
  std::vector<T> values(static_cast<size_t>(count));
  const uint64_t row = found->sizes.empty() || found->sizes[0] == 0 ? 1 : count / found->sizes[0];
  for (size_t at = 0; at < values.size(); at += static_cast<size_t>(row))  // records lie apart
    open(variable, at, row)->read(0, static_cast<size_t>(row), values.data() + at, type);
  return values;
}

std::vector<int64_t> NetcdfFile::integers(const std::string& variable, size_t most) {
  return numbers<int64_t>(variable, most, ScalarType::kInt64);
}

std::vector<double> NetcdfFile::reals(const std::string& variable, size_t most) {
  return numbers<double>(variable, most, ScalarType::kFloat64);
}

std::string trimmedText(const std::string& text) {
  std::string trimmed = text.substr(0, text.find('\0'));
  while (!trimmed.empty() && trimmed.back() == ' ') trimmed.pop_back();
  return trimmed;
}

std::shared_ptr<NetcdfFile> openNetcdf(std::unique_ptr<ByteSource> bytes) {
  char begin[4] = {};
  bytes->readAt(0, begin, sizeof begin);
  const std::string text(begin, sizeof begin);
  if (text.starts_with("CDF")) return openNetcdfClassic(std::move(bytes));
  const std::string name = bytes->name();
  if (text != "\x89HDF") fail(Status::kBadData, "%s: this is no netCDF file", name.c_str());
#ifdef TETSTREAM_WITH_HDF5
  return openNetcdfHdf5(std::move(bytes));
#else
  fail(Status::kUnsupported, "%s: the file is netCDF-4, and this build has no HDF5", name.c_str());
#endif
}

}  // namespace tetstream
