#include "xdmf_arrays.h"

#include "file_pool.h"
#include "hdf5_file.h"
#include "status.h"

namespace tetstream {

constexpr uint64_t kMaxReference = 4096;  // bytes

void XdmfArrays::failItem(const XdmfItem& item, Status status, const std::string& text) const {
  fail(status, "%s: byte %llu: %s", bytes_->name().c_str(),
       static_cast<unsigned long long>(item.begin), text.c_str());
}

std::string XdmfArrays::textOfItem(const XdmfItem& item) const {
  if (item.end - item.begin > kMaxReference)
    failItem(item, Status::kBadData, "the name of a dataset is too long");
  std::string text(static_cast<size_t>(item.end - item.begin), 0);
  text.resize(bytes_->readAt(item.begin, text.data(), text.size()));
  const char* blanks = " \t\r\n";
  const size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string XdmfArrays::describe(const XdmfItem& item) const {
  return textOf("%s: byte %llu: the values", bytes_->name().c_str(),
                static_cast<unsigned long long>(item.begin));
}

std::string XdmfArrays::placeOf(const XdmfItem& item) {
  return sameWord(item.format, "HDF") ? textOfItem(item) : std::to_string(item.begin);
}

MeshArray XdmfArrays::arrayOf(const XdmfItem& item, const std::string& name, int components) {
  MeshArray array{cutMeshName(name), ValueType::kFloat32, components, {}};
  if (item.sizes.empty()) failItem(item, Status::kBadData, "a DataItem has no Dimensions");
  if (sameWord(item.format, "XML")) return ofText(item, std::move(array));
  if (sameWord(item.format, "HDF")) return ofHdf5(item, std::move(array));
  failItem(item, Status::kUnsupported,
           "values in the format \"" + cutMeshName(item.format) + "\" are not read");
}

MeshArray XdmfArrays::ofText(const XdmfItem& item, MeshArray array) {
  const bool wide = item.precision == 8;
  if (sameWord(item.kind, "Float"))
    array.type = wide ? ValueType::kFloat64 : ValueType::kFloat32;
  else if (sameWord(item.kind, "UInt") || sameWord(item.kind, "UChar"))
    array.type = wide ? ValueType::kUInt64 : ValueType::kUInt32;
  else
    array.type = wide ? ValueType::kInt64 : ValueType::kInt32;
  array.open = [bytes = bytes_, item, name = array.name, type = array.type](uint64_t count) {
    if (count != item.count())
      fail(Status::kBadData, "%s: byte %llu: there are %llu values where %llu are needed",
           bytes->name().c_str(), static_cast<unsigned long long>(item.begin),
           static_cast<unsigned long long>(item.count()), static_cast<unsigned long long>(count));
    return openTextValues(*bytes, tetstream::placeOf(*bytes, name), type,
                          {item.begin, item.end, count});
  };
  return array;
}

#ifdef TETSTREAM_WITH_HDF5

MeshArray XdmfArrays::ofHdf5(const XdmfItem& item, MeshArray array) {
  const std::string reference = textOfItem(item);
  const size_t colon = reference.rfind(":/");
  if (colon == std::string::npos || colon == 0)
    failItem(item, Status::kBadData,
             "\"" + cutMeshName(reference) + "\" names no dataset, as FILE:/PATH does");
  const std::string name = pathBeside(bytes_->name(), reference.substr(0, colon));
  const std::string path = reference.substr(colon + 2);
  std::shared_ptr<Hdf5File>& file = files_[name];
  if (!file) file = openHdf5(openFile(name));
  const Hdf5Turn turn;
  if (!file->has(path))
    failItem(item, Status::kBadData, "there is no dataset \"" + cutMeshName(reference) + "\"");
  const Hdf5Shape shape = file->shapeOf(path);
  const uint64_t held = shape.rows * shape.components;
  if (!shape.numbers || held != item.count())
    failItem(item, Status::kBadData,
             "\"" + cutMeshName(reference) + "\" has not the " + std::to_string(item.count()) +
                 " numbers of the Dimensions");
  array.type = shape.type;
  array.open = [file, path, held](uint64_t count) {
    if (count != held)
      fail(Status::kBadData, "%s: dataset \"%s\" has %llu values where %llu are needed",
           file->name().c_str(), path.c_str(), static_cast<unsigned long long>(held),
           static_cast<unsigned long long>(count));
    return openHdf5Values(file, path, 0);
  };
  return array;
}

#else

MeshArray XdmfArrays::ofHdf5(const XdmfItem& item, MeshArray) {
  failItem(item, Status::kUnsupported, "the values are in HDF5, which this build does not have");
}

#endif

}  // namespace tetstream
