// Reads netCDF's classic layout (CDF-1), that with 64-bit offsets (CDF-2) and that with 64-bit
// numbers (CDF-5): a header, then the variables, big endian. Variables of records lie in each of
// them one after the other.
#include <algorithm>
#include <map>

#include "netcdf_file.h"
#include "netcdf_layout.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kHeaderBytes = 1 << 16;  // read at once
constexpr uint64_t kMaxNames = 1 << 20;   // dimensions, variables or attributes
constexpr uint64_t kMaxNameBytes = 4096;
constexpr uint64_t kMaxTextBytes = 256;    // of an attribute that is kept
constexpr uint64_t kMaxDimensions = 1024;  // of a variable

struct NumberKind {
  ValueType type;
  bool text;
};

// By netCDF's numbers of types, from 1.
constexpr NumberKind kNumberKinds[] = {
    {ValueType::kInt8, false},  {ValueType::kInt8, true},     {ValueType::kInt16, false},
    {ValueType::kInt32, false}, {ValueType::kFloat32, false}, {ValueType::kFloat64, false},
    {ValueType::kUInt8, false}, {ValueType::kUInt16, false},  {ValueType::kUInt32, false},
    {ValueType::kInt64, false}, {ValueType::kUInt64, false}};

struct ClassicVariable : NetcdfVariable {
  uint64_t begin = 0;
  bool of_records = false;
  uint64_t record_bytes = 0;  // of one record, or of all if it has none; without what fills it up
  std::map<std::string, std::string> texts;
};

// The header, from the file's first byte on.
class ClassicHeader {
 public:
  explicit ClassicHeader(ByteSource& bytes) : bytes_(bytes) {}

  void read(std::map<std::string, ClassicVariable>& variables) {
    readBegin();
    readDimensions();
    std::map<std::string, std::string> unused;
    readAttributes(unused);
    readVariables(variables);
    placeRecords(variables);
  }

  uint64_t recordBytes() const { return record_bytes_; }

 private:
  [[noreturn]] void failBad(const std::string& text) const {
    fail(Status::kBadData, "%s: byte %llu: %s", bytes_.name().c_str(),
         static_cast<unsigned long long>(at_), text.c_str());
  }

  void take(void* out, uint64_t size) {
    if (size > bytes_.size() || at_ > bytes_.size() - size) failBad("the file ends in its header");
    auto* to = static_cast<unsigned char*>(out);
    while (size > 0) {
      if (at_ < begin_ || at_ >= begin_ + held_.size()) fill();
      const size_t from = static_cast<size_t>(at_ - begin_);
      const size_t n = static_cast<size_t>(std::min<uint64_t>(size, held_.size() - from));
      if (to) to = std::copy_n(held_.data() + from, n, to);
      at_ += n;
      size -= n;
    }
  }

  void fill() {
    held_.resize(kHeaderBytes);
    begin_ = at_;
    held_.resize(bytes_.readAt(begin_, held_.data(), held_.size()));
    if (held_.empty()) failBad("the file ends in its header");
  }

  uint64_t number(size_t bytes) {
    unsigned char digits[8];
    take(digits, bytes);
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; ++i) value = value << 8 | digits[i];
    return value;
  }
  uint64_t count() { return number(version_ == 5 ? 8 : 4); }

  void skip(uint64_t size) {
    if (size > bytes_.size() || at_ > bytes_.size() - size) failBad("the file ends in its header");
    at_ += size;
  }

  std::string name() {
    const uint64_t size = count();
    if (size > kMaxNameBytes) failBad("a name has more than 4096 bytes");
    std::string text(static_cast<size_t>(size), 0);
    take(text.data(), size);
    skip(filledUp(size) - size);
    return text;
  }

  void readBegin() {
    number(3);
    version_ = number(1);
    if (version_ != 1 && version_ != 2 && version_ != 5)
      fail(Status::kUnsupported, "%s: netCDF of version %llu", bytes_.name().c_str(),
           static_cast<unsigned long long>(version_));
    records_ = count();
    streaming_ = records_ == (version_ == 5 ? UINT64_MAX : UINT32_MAX);
  }

  // How many there are of a list; 0 where there is none.
  uint64_t listOf(NetcdfTag tag, const char* what) {
    const uint64_t found = number(4), entries = count();
    if (found == 0 && entries == 0) return 0;
    if (found != tag) failBad(textOf("there is no list of %s", what));
    if (entries > kMaxNames) failBad(textOf("there are more %s than any file has", what));
    return entries;
  }

  void readDimensions() {
    for (uint64_t n = listOf(kDimensionList, "dimensions"); n > 0; --n) {
      name();
      dimensions_.push_back(count());
    }
  }

  NumberKind kind() {
    const uint64_t type = number(4);
    if (type < 1 || type > std::size(kNumberKinds)) failBad("there is no such type of values");
    return kNumberKinds[type - 1];
  }

  void readAttributes(std::map<std::string, std::string>& texts) {
    for (uint64_t n = listOf(kAttributeList, "attributes"); n > 0; --n) {
      const std::string key = name();
      const NumberKind k = kind();
      const uint64_t size = count();
      if (size > bytes_.size()) failBad("the file ends in its header");
      const uint64_t stored = filledUp(size * sizeOf(k.type));
      if (!k.text || size > kMaxTextBytes) {
        skip(stored);
        continue;
      }
      std::string text(static_cast<size_t>(size), 0);
      take(text.data(), size);
      skip(stored - size);
      texts[key] = trimmedText(text);
    }
  }

  void readVariables(std::map<std::string, ClassicVariable>& variables) {
    for (uint64_t n = listOf(kVariableList, "variables"); n > 0; --n) {
      const std::string key = name();
      ClassicVariable v;
      const uint64_t dimensions = count();
      if (dimensions > kMaxDimensions) failBad("a variable has too many dimensions");
      for (uint64_t d = 0; d < dimensions; ++d) addDimension(v, d);
      readAttributes(v.texts);
      const NumberKind k = kind();
      v.type = k.type;
      v.text = k.text;
      count();  // its size, which the dimensions tell, too, and which may be too large for it
      v.begin = number(version_ == 1 ? 4 : 8);
      measure(v, key);
      variables[key] = std::move(v);
    }
  }

  void addDimension(ClassicVariable& v, uint64_t place) {
    const uint64_t dimension = count();
    if (dimension >= dimensions_.size()) failBad("a variable has a dimension that is not there");
    const uint64_t size = dimensions_[static_cast<size_t>(dimension)];
    if (size == 0 && place > 0) failBad("a variable has records within records");
    v.of_records |= size == 0;
    v.sizes.push_back(size);
  }

  // That it, or its first record, lies within the file.
  void measure(ClassicVariable& v, const std::string& key) {
    uint64_t bytes = sizeOf(v.type);
    for (size_t d = v.of_records; d < v.sizes.size(); ++d) {
      if (v.sizes[d] > bytes_.size() / bytes) failShort(key);
      bytes *= v.sizes[d];
    }
    v.record_bytes = bytes;
    const bool there = !v.of_records || records_ > 0;
    if (!streaming_ && there && (v.begin > bytes_.size() || bytes > bytes_.size() - v.begin))
      failShort(key);
  }

  [[noreturn]] void failShort(const std::string& key) const {
    fail(Status::kBadData, "%s: the file ends within \"%s\"", bytes_.name().c_str(), key.c_str());
  }

  // A single variable of records has nothing between them.
  void placeRecords(std::map<std::string, ClassicVariable>& variables) {
    uint64_t count = 0, bytes = 0, only = 0, first = UINT64_MAX;
    for (const auto& [key, v] : variables) {
      if (!v.of_records) continue;
      ++count;
      only = v.record_bytes;
      bytes += filledUp(only);
      first = std::min(first, v.begin);
    }
    record_bytes_ = count == 1 ? only : bytes;
    if (streaming_)
      records_ =
          record_bytes_ > 0 && first < bytes_.size() ? (bytes_.size() - first) / record_bytes_ : 0;
    for (auto& [key, v] : variables) {
      if (!v.of_records) continue;
      v.sizes[0] = records_;
      const uint64_t before = records_ > 0 ? records_ - 1 : 0;
      if (records_ == 0 || record_bytes_ == 0) continue;
      if (v.begin > bytes_.size() || v.record_bytes > bytes_.size() - v.begin ||
          before > (bytes_.size() - v.begin - v.record_bytes) / record_bytes_)
        failShort(key);
    }
  }

  ByteSource& bytes_;
  std::vector<unsigned char> held_;
  uint64_t begin_ = 0, at_ = 0;
  uint64_t version_ = 0, records_ = 0, record_bytes_ = 0;
  bool streaming_ = false;            // the number of records was not known when the file began
  std::vector<uint64_t> dimensions_;  // 0: records
};

class VariablePlace final : public ValueBytes {
 public:
  VariablePlace(std::shared_ptr<ByteSource> bytes, uint64_t begin)
      : bytes_(std::move(bytes)), begin_(begin) {}
  void readAt(uint64_t offset, void* out, size_t size) override {
    if (bytes_->readAt(begin_ + offset, out, size) != size)
      fail(Status::kBadData, "%s: the file ends", bytes_->name().c_str());
  }

 private:
  std::shared_ptr<ByteSource> bytes_;
  uint64_t begin_;
};

class NetcdfClassic final : public NetcdfFile {
 public:
  explicit NetcdfClassic(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {
    ClassicHeader header(*bytes_);
    header.read(variables_);
    record_bytes_ = header.recordBytes();
  }

  const std::string& name() const override { return bytes_->name(); }
  const NetcdfVariable* find(const std::string& variable) override {
    const auto found = variables_.find(variable);
    return found == variables_.end() ? nullptr : &found->second;
  }
  std::string textAttribute(const std::string& variable, const std::string& key) override {
    const auto& texts = variables_.at(variable).texts;
    const auto found = texts.find(key);
    return found == texts.end() ? "" : found->second;
  }

  std::unique_ptr<Values> open(const std::string& variable, uint64_t first,
                               uint64_t count) override {
    const ClassicVariable& v = variables_.at(variable);
    if (first > v.count() || count > v.count() - first)
      fail(Status::kBadData, "%s: \"%s\" has %llu values where %llu are needed", name().c_str(),
           variable.c_str(), static_cast<unsigned long long>(v.count()),
           static_cast<unsigned long long>(first + count));
    return openBinaryValues(std::make_unique<VariablePlace>(bytes_, placeOf(v, first)),
                            name() + ": \"" + variable + "\"", v.type, true);
  }

  std::vector<std::string> texts(const std::string& variable, size_t most) override {
    std::vector<std::string> rows;
    const auto found = variables_.find(variable);
    if (found == variables_.end()) return rows;
    const ClassicVariable& v = found->second;
    if (!v.text || v.sizes.size() != 2)
      fail(Status::kBadData, "%s: \"%s\" is no list of names", name().c_str(), variable.c_str());
    if (v.size(0) > most || v.size(1) > kMaxNameBytes)
      fail(Status::kUnsupported, "%s: \"%s\" has more than %zu names, or longer ones",
           name().c_str(), variable.c_str(), most);
    for (uint64_t i = 0; i < v.size(0); ++i) {
      std::string row(static_cast<size_t>(v.size(1)), 0);
      VariablePlace(bytes_, placeOf(v, i * v.size(1))).readAt(0, row.data(), row.size());
      rows.push_back(trimmedText(row));
    }
    return rows;
  }

 private:
  uint64_t placeOf(const ClassicVariable& v, uint64_t value) const {
    const uint64_t byte = value * sizeOf(v.type);
    if (!v.of_records || v.record_bytes == 0) return v.begin + byte;
    return v.begin + byte / v.record_bytes * record_bytes_ + byte % v.record_bytes;
  }

  std::shared_ptr<ByteSource> bytes_;
  std::map<std::string, ClassicVariable> variables_;
  uint64_t record_bytes_ = 0;
};

}  // namespace

std::shared_ptr<NetcdfFile> openNetcdfClassic(std::unique_ptr<ByteSource> bytes) {
  return std::make_shared<NetcdfClassic>(std::move(bytes));
}

}  // namespace tetstream
