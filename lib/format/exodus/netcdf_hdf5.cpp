// Reads netCDF-4 as what it is: an HDF5 file with a dataset for each variable.
#ifdef TETSTREAM_WITH_HDF5
#include <map>

#include "hdf5_file.h"
#include "netcdf_file.h"
#include "status.h"

namespace tetstream {

namespace {

class NetcdfHdf5 final : public NetcdfFile {
 public:
  explicit NetcdfHdf5(std::unique_ptr<ByteSource> bytes) : file_(openHdf5(std::move(bytes))) {}

  const std::string& name() const override { return file_->name(); }

  const NetcdfVariable* find(const std::string& variable) override {
    const auto found = variables_.find(variable);
    if (found != variables_.end()) return &found->second;
    const Hdf5Turn turn;
    if (!file_->has(variable)) return nullptr;
    const Hdf5Shape shape = file_->shapeOf(variable);
    NetcdfVariable v;
    v.type = shape.type;
    v.text = !shape.numbers;
    if (shape.numbers) v.sizes.push_back(shape.rows);
    if (shape.numbers && shape.dimensions >= 2) v.sizes.push_back(shape.components);
    return &(variables_[variable] = std::move(v));
  }

  std::string textAttribute(const std::string& variable, const std::string& key) override {
    const Hdf5Turn turn;
    if (!file_->hasAttribute(variable, key)) return "";
    return trimmedText(file_->textAttribute(variable, key));
  }

  std::unique_ptr<Values> open(const std::string& variable, uint64_t first,
                               uint64_t count) override {
    const NetcdfVariable& v = need(variable);
    if (v.text || first > v.count() || count > v.count() - first)
      fail(Status::kBadData, "%s: \"%s\" has not the %llu numbers that are needed", name().c_str(),
           variable.c_str(), static_cast<unsigned long long>(first + count));
    return openHdf5Values(file_, variable, first);
  }

  std::vector<std::string> texts(const std::string& variable, size_t most) override {
    const Hdf5Turn turn;
    if (!file_->has(variable)) return {};
    std::vector<std::string> rows = file_->texts(variable, most);
    for (std::string& row : rows) row = trimmedText(row);
    return rows;
  }

 private:
  std::shared_ptr<Hdf5File> file_;
  std::map<std::string, NetcdfVariable> variables_;
};

}  // namespace

std::shared_ptr<NetcdfFile> openNetcdfHdf5(std::unique_ptr<ByteSource> bytes) {
  return std::make_shared<NetcdfHdf5>(std::move(bytes));
}

}  // namespace tetstream
#endif
