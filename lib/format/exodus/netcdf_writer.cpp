#include "netcdf_writer.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "netcdf_layout.h"
#include "status.h"

namespace tetstream {

namespace {

size_t sizeOfType(NetcdfType type) {
  switch (type) {
    case NetcdfType::kChar:
      return 1;
    case NetcdfType::kInt:
    case NetcdfType::kFloat:
      return 4;
    case NetcdfType::kDouble:
      return 8;
  }
  return 0;
}

// The last `bytes` of a number, the highest first.
void addBig(std::string& text, uint64_t number, size_t bytes) {
  for (size_t i = bytes; i-- > 0;) text += static_cast<char>(number >> (8 * i));
}

}  // namespace

// ------------------------------------------------------------------------------------- values

// The machine's bytes of a number, the highest first.
void NetcdfValues::store(const void* number, size_t bytes) {
  unsigned char big[8];
  std::memcpy(big, number, bytes);
  if constexpr (std::endian::native == std::endian::little) std::reverse(big, big + bytes);
  out_.write(big, bytes);
  bytes_ += bytes;
}

void NetcdfValues::put(const void* values, ScalarType type, size_t count) {
  const auto* from = static_cast<const unsigned char*>(values);
  for (size_t i = 0; i < count; ++i, from += sizeOf(type)) {
    if (type_ == NetcdfType::kDouble || type_ == NetcdfType::kFloat) {
      double wide;
      convertScalars(from, type, &wide, ScalarType::kFloat64, 1);
      const auto narrow = static_cast<float>(wide);
      type_ == NetcdfType::kDouble ? store(&wide, sizeof wide) : store(&narrow, sizeof narrow);
      exact_ = exact_ && isExactAsDouble(from, type);
    } else {
      int32_t number;
      convertScalars(from, type, &number, ScalarType::kInt32, 1);
      store(&number, sizeof number);
    }
  }
}

void NetcdfValues::text(const std::string& text, size_t width) {
  std::string filled = text.substr(0, width);
  filled.resize(width, '\0');
  out_.write(filled.data(), filled.size());
  bytes_ += width;
}

// ------------------------------------------------------------------------------------- the file

size_t NetcdfWriter::addDimension(const std::string& name, uint64_t length) {
  dimensions_.push_back({name, length});
  return dimensions_.size() - 1;
}

void NetcdfWriter::addAttribute(const std::string& name, const std::string& text) {
  attributes_.push_back({name, text});
}

void NetcdfWriter::addAttribute(const std::string& name, NetcdfType type, double number) {
  attributes_.push_back({name, "", type, number});
}

void NetcdfWriter::addVariable(const std::string& name, NetcdfType type,
                               std::vector<size_t> dimensions,
                               std::pair<std::string, std::string> attribute, Write write) {
  Variable v{name, type, std::move(dimensions), std::move(attribute), std::move(write)};
  v.bytes = sizeOfType(type);
  for (const size_t d : v.dimensions) {
    v.of_records = v.of_records || dimensions_[d].length == 0;
    if (dimensions_[d].length > 0) v.bytes *= dimensions_[d].length;
  }
  is_wide_ = is_wide_ || v.bytes > most_;
  variables_.push_back(std::move(v));
}

void NetcdfWriter::addCount(std::string& text, uint64_t count) const {
  addBig(text, count, is_wide_ ? 8 : 4);
}

void NetcdfWriter::addName(std::string& text, const std::string& name) const {
  addCount(text, name.size());
  text += name;
  text.resize(static_cast<size_t>(filledUp(text.size())), '\0');
}

void NetcdfWriter::addList(std::string& text, uint32_t tag, size_t entries) const {
  addBig(text, entries > 0 ? tag : 0, 4);
  addCount(text, entries);
}

void NetcdfWriter::addAttributes(std::string& text,
                                 const std::vector<Attribute>& attributes) const {
  addList(text, kAttributeList, attributes.size());
  for (const Attribute& a : attributes) {
    addName(text, a.name);
    addBig(text, static_cast<uint32_t>(a.type), 4);
    if (a.type == NetcdfType::kChar) {
      addName(text, a.text);
      continue;
    }
    addCount(text, 1);
    if (a.type == NetcdfType::kInt)
      addBig(text, static_cast<uint64_t>(static_cast<int64_t>(a.number)), 4);
    else if (a.type == NetcdfType::kFloat)
      addBig(text, std::bit_cast<uint32_t>(static_cast<float>(a.number)), 4);
    else
      addBig(text, std::bit_cast<uint64_t>(a.number), 8);
  }
}

// Everything before the values; its size does not depend on `body`, where they begin.
std::string NetcdfWriter::header(uint64_t body) const {
  std::string text = "CDF";
  text += static_cast<char>(is_wide_ ? 5 : 2);
  addCount(text, 1);  // of records
  addList(text, kDimensionList, dimensions_.size());
  for (const Dimension& d : dimensions_) {
    addName(text, d.name);
    addCount(text, d.length);
  }
  addAttributes(text, attributes_);
  addList(text, kVariableList, variables_.size());
  for (const Variable& v : variables_) {
    addName(text, v.name);
    addCount(text, v.dimensions.size());
    for (const size_t d : v.dimensions) addCount(text, d);
    std::vector<Attribute> own;
    if (!v.attribute.first.empty()) own.push_back({v.attribute.first, v.attribute.second});
    addAttributes(text, own);
    addBig(text, static_cast<uint32_t>(v.type), 4);
    addCount(text, filledUp(v.bytes));
    addBig(text, body + v.begin, 8);
  }
  return text;
}

// Those of records come behind the others.
void NetcdfWriter::layOut() {
  std::stable_partition(variables_.begin(), variables_.end(),
                        [](const Variable& v) { return !v.of_records; });
  uint64_t at = 0;
  for (Variable& v : variables_) {
    v.begin = at;
    at += filledUp(v.bytes);
  }
}

void NetcdfWriter::writeValues(const Variable& variable) {
  NetcdfValues values(out_, variable.type);
  variable.write(values);
  if (values.bytes() != variable.bytes)
    fail(Status::kInternal, "%s: \"%s\" has %llu bytes, not %llu", sink_.name().c_str(),
         variable.name.c_str(), static_cast<unsigned long long>(values.bytes()),
         static_cast<unsigned long long>(variable.bytes));
  constexpr char kFill[4] = {};
  out_.write(kFill, static_cast<size_t>(filledUp(variable.bytes) - variable.bytes));
}

void NetcdfWriter::write() {
  layOut();
  const std::string head = header(header(0).size());
  out_.write(head.data(), head.size());
  for (const Variable& v : variables_) writeValues(v);
  out_.flush();
}

}  // namespace tetstream
