#include "xdmf_arrays.h"

#include <algorithm>
#include <bit>

#include "hdf5_file.h"
#include "rows_at_once.h"
#include "status.h"
#include "text_number.h"

namespace tetstream {

namespace {

class RawBytes final : public ValueBytes {
 public:
  RawBytes(std::shared_ptr<ByteSource> file, uint64_t begin)
      : file_(std::move(file)), begin_(begin) {}
  void readAt(uint64_t offset, void* out, size_t size) override {
    const size_t got = file_->readAt(begin_ + offset, out, size);
    if (got < size)
      fail(Status::kIo, "%s: byte %llu: the file has become shorter", file_->name().c_str(),
           static_cast<unsigned long long>(begin_ + offset + got));
  }

 private:
  std::shared_ptr<ByteSource> file_;
  uint64_t begin_;
};

[[noreturn]] void failCount(const std::string& place, uint64_t held, uint64_t wanted) {
  fail(Status::kBadData, "%s: there are %llu values where %llu are needed", place.c_str(),
       static_cast<unsigned long long>(held), static_cast<unsigned long long>(wanted));
}

// The words that stand for each kind of numbers in a raw file, by their bytes.
struct RawType {
  const char* kind;
  uint64_t precision;  // 0: whatever is said
  ValueType type;
};

constexpr RawType kRawTypes[] = {
    {"Float", 4, ValueType::kFloat32}, {"Float", 8, ValueType::kFloat64},
    {"Int", 1, ValueType::kInt8},      {"Int", 2, ValueType::kInt16},
    {"Int", 4, ValueType::kInt32},     {"Int", 8, ValueType::kInt64},
    {"UInt", 1, ValueType::kUInt8},    {"UInt", 2, ValueType::kUInt16},
    {"UInt", 4, ValueType::kUInt32},   {"UInt", 8, ValueType::kUInt64},
    {"Char", 0, ValueType::kInt8},     {"UChar", 0, ValueType::kUInt8},
    {"Short", 0, ValueType::kInt16},   {"UShort", 0, ValueType::kUInt16}};

}  // namespace

std::string XdmfArrays::describe(const XdmfItem& item) const {
  return text_.placeOf(item) + ": the values";
}

std::string XdmfArrays::placeOf(const XdmfItem& item) {
  if (item.is_slab && item.parts.size() == 2)
    return text_.of(item.parts[0]) + " of " + placeOf(item.parts[1]);
  if (sameWord(item.format, "HDF")) return text_.of(item);
  if (sameWord(item.format, "Binary")) return text_.of(item) + ":" + std::to_string(item.seek);
  return std::to_string(item.begin);
}

bool XdmfArrays::areEqual(const std::vector<XdmfItem>& a, const std::vector<XdmfItem>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [this](const XdmfItem& x, const XdmfItem& y) { return areEqual(x, y); });
}

bool XdmfArrays::areEqual(const XdmfItem& a, const XdmfItem& b) {
  const uint64_t count = a.count();
  if (count == 0 || b.count() != count) return false;
  const MeshArray array = arrayOf(a, "values", 1), other_array = arrayOf(b, "values", 1);
  if (array.type != other_array.type) return false;
  const ScalarType type = scalarOf(array.type);
  const std::unique_ptr<Values> values = array.open(count), others = other_array.open(count);
  const size_t row = sizeOf(type);
  std::vector<unsigned char> held(kRowsAtOnce * row), other(kRowsAtOnce * row);
  for (uint64_t at = 0; at < count; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - at));
    values->read(at, n, held.data(), type);
    others->read(at, n, other.data(), type);
    if (!std::equal(held.data(), held.data() + n * row, other.data())) return false;
  }
  return true;
}

MeshArray XdmfArrays::arrayOf(const XdmfItem& item, const std::string& name, int components) {
  MeshArray array{cutName(name), ValueType::kFloat32, components, {}};
  if (item.sizes.empty()) text_.failItem(item, Status::kBadData, "a DataItem has no Dimensions");
  if (item.is_slab) return ofSlab(item, std::move(array));
  if (sameWord(item.format, "XML")) return ofText(item, std::move(array));
  if (sameWord(item.format, "HDF")) return ofHdf5(item, std::move(array));
  if (sameWord(item.format, "Binary")) return ofRawFile(item, std::move(array));
  text_.failItem(item, Status::kUnsupported,
                 "values in the format \"" + cutName(item.format) + "\" are not read");
}

MeshArray XdmfArrays::ofText(const XdmfItem& item, MeshArray array) {
  const bool wide = item.precision == 8;
  if (sameWord(item.kind, "Float"))
    array.type = wide ? ValueType::kFloat64 : ValueType::kFloat32;
  else if (sameWord(item.kind, "UInt") || sameWord(item.kind, "UChar"))
    array.type = wide ? ValueType::kUInt64 : ValueType::kUInt32;
  else
    array.type = wide ? ValueType::kInt64 : ValueType::kInt32;
  array.open = [bytes = bytes_, helpers = helpers_, item, name = array.name, type = array.type,
                place = text_.placeOf(item)](uint64_t count) {
    if (count != item.count()) failCount(place, item.count(), count);
    return openTextValues(*bytes, tetstream::placeOf(*bytes, name), type,
                          {item.begin, item.end, count}, helpers);
  };
  return array;
}

ValueType XdmfArrays::typeOfRaw(const XdmfItem& item) const {
  for (const RawType& raw : kRawTypes)
    if (sameWord(item.kind, raw.kind) && (raw.precision == 0 || raw.precision == item.precision))
      return raw.type;
  text_.failItem(item, Status::kUnsupported,
                 "values of the type \"" + cutName(item.kind) + "\" of " +
                     std::to_string(item.precision) + " bytes are not read");
}

MeshArray XdmfArrays::ofRawFile(const XdmfItem& item, MeshArray array) {
  array.type = typeOfRaw(item);
  if (!sameWord(item.compression, "Raw"))
    text_.failItem(
        item, Status::kUnsupported,
        "values with the compression \"" + cutName(item.compression) + "\" are not read");
  const bool big = sameWord(item.order, "Big");
  const bool native = sameWord(item.order, "Native");
  if (!big && !native && !sameWord(item.order, "Little"))
    text_.failItem(item, Status::kUnsupported,
                   "values in the byte order \"" + cutName(item.order) + "\" are not read");
  const std::string name = text_.of(item);
  if (name.empty()) text_.failItem(item, Status::kBadData, "the name of a file is missing");
  std::shared_ptr<ByteSource>& file = raw_files_[name];
  if (!file) file = pool_->add(pathBeside(bytes_->name(), name));
  const uint64_t held = item.count(), size = file->size();
  if (item.seek > size || held > (size - item.seek) / sizeOf(array.type))
    text_.failItem(item, Status::kBadData,
                   "\"" + cutName(name) + "\" has " + std::to_string(size) +
                       " bytes, fewer than the Dimensions and the Seek need");
  array.open = [file, held, type = array.type, seek = item.seek,
                big = native ? std::endian::native == std::endian::big : big](uint64_t count) {
    if (count != held) failCount(file->name(), held, count);
    return openBinaryValues(std::make_unique<RawBytes>(file, seek), file->name(), type, big);
  };
  return array;
}

// Three numbers for each direction: all begins, all strides, all counts.
std::vector<SlabRange> XdmfArrays::rangesOf(const XdmfItem& item) const {
  if (item.parts.size() != 2 || item.parts[0].is_slab || !sameWord(item.parts[0].format, "XML") ||
      item.parts[1].sizes.empty())
    text_.failItem(
        item, Status::kUnsupported,
        "a HyperSlab is not read unless it has a list of numbers in the text and values with "
        "their Dimensions");
  const std::vector<uint64_t>& sizes = item.parts[1].sizes;
  std::string text = text_.of(item.parts[0]);
  std::replace_if(text.begin(), text.end(), isBlank, ' ');
  std::vector<uint64_t> numbers;
  for (std::string_view rest = text; !rest.empty();) {
    int64_t number = -1;
    const std::string_view word = takeWord(rest);
    if (word.empty()) break;
    if (!parseInteger(word, &number) || number < 0)
      text_.failItem(item, Status::kBadData, quoted(word) + " in a HyperSlab is no number");
    numbers.push_back(static_cast<uint64_t>(number));
  }
  const size_t rank = sizes.size();
  if (numbers.size() != 3 * rank)
    text_.failItem(item, Status::kBadData,
                   "a HyperSlab of " + std::to_string(rank) + " directions has " +
                       std::to_string(numbers.size()) + " numbers");
  std::vector<SlabRange> ranges;
  for (size_t d = 0; d < rank; ++d) {
    ranges.push_back({numbers[d], numbers[rank + d], numbers[2 * rank + d], sizes[d]});
    if (!fitsSlab(ranges.back()))
      text_.failItem(item, Status::kBadData,
                     "a HyperSlab reaches out of its values in direction " + std::to_string(d));
  }
  return ranges;
}

MeshArray XdmfArrays::ofSlab(const XdmfItem& item, MeshArray array) {
  const std::vector<SlabRange> ranges = rangesOf(item);
  uint64_t held = 1;  // at most the values that it is cut from
  for (const SlabRange& range : ranges) held *= range.count;
  if (held != item.count())
    text_.failItem(item, Status::kBadData,
                   "a HyperSlab of " + std::to_string(held) + " values has not the " +
                       std::to_string(item.count()) + " of its Dimensions");
  const MeshArray whole = arrayOf(item.parts[1], array.name, 1);
  array.type = whole.type;
  array.open = [open = whole.open, all = item.parts[1].count(), ranges, held,
                place = describe(item)](uint64_t count) {
    if (count != held) failCount(place, held, count);
    return openSlab(open(all), ranges);
  };
  return array;
}

#ifdef TETSTREAM_WITH_HDF5

namespace {

struct DatasetName {
  std::string file, path;  // from the root, without its slash; empty: it is missing
};

// FILE:/PATH, or FILE:PATH as libxdmf and FEniCS's checkpoints have it. The last colon counts:
// names of files have some more often (times of day) than names of datasets.
DatasetName splitReference(const std::string& reference) {
  size_t colon = reference.rfind(":/");
  if (colon == std::string::npos) colon = reference.rfind(':');
  if (colon == std::string::npos) return {};
  const size_t path = reference[colon + 1] == '/' ? colon + 2 : colon + 1;
  return {reference.substr(0, colon), reference.substr(path)};
}

}  // namespace

MeshArray XdmfArrays::ofHdf5(const XdmfItem& item, MeshArray array) {
  const std::string reference = text_.of(item);
  const DatasetName dataset = splitReference(reference);
  if (dataset.file.empty() || dataset.path.empty())
    text_.failItem(item, Status::kBadData,
                   "\"" + cutName(reference) + "\" names no dataset, as FILE:/PATH does");
  const std::string name = pathBeside(bytes_->name(), dataset.file);
  const std::string path = dataset.path;
  std::shared_ptr<Hdf5File>& file = files_[name];
  if (!file) file = openHdf5(openFile(name));
  const Hdf5Turn turn;
  if (!file->has(path))
    text_.failItem(item, Status::kBadData, "there is no dataset \"" + cutName(reference) + "\"");
  const Hdf5Shape shape = file->shapeOf(path);
  const uint64_t held = shape.rows * shape.components;
  if (!shape.numbers || held != item.count())
    text_.failItem(item, Status::kBadData,
                   "\"" + cutName(reference) + "\" has not the " + std::to_string(item.count()) +
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
  text_.failItem(item, Status::kUnsupported,
                 "the values are in HDF5, which this build does not have");
}

#endif

}  // namespace tetstream
