// format/exodus: writes a netCDF file of the classic layout with 64-bit offsets (CDF-2), or with
// 64-bit numbers (CDF-5) where an array needs them, front to back. Depends on bytes.h, scalar.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bytes.h"
#include "scalar.h"

namespace tetstream {

enum class NetcdfType : uint32_t { kChar = 2, kInt = 4, kFloat = 5, kDouble = 6 };

// The values of one variable, as they come.
class NetcdfValues {
 public:
  NetcdfValues(BufferedSink& out, NetcdfType type) : out_(out), type_(type) {}
  void put(const void* values, ScalarType type, size_t count);
  void put(int64_t value) { put(&value, ScalarType::kInt64, 1); }
  void text(const std::string& text, size_t width);  // filled up with zeros
  uint64_t bytes() const { return bytes_; }
  bool exact() const { return exact_; }  // no integer was rounded

 private:
  void store(const void* number, size_t bytes);
  BufferedSink& out_;
  NetcdfType type_;
  uint64_t bytes_ = 0;
  bool exact_ = true;
};

class NetcdfWriter {
 public:
  using Write = std::function<void(NetcdfValues&)>;

  // Arrays of more bytes than `most` need wide numbers.
  explicit NetcdfWriter(ByteSink& bytes, uint64_t most = 0xfffffffc)
      : sink_(bytes), out_(bytes), most_(most) {}
  // Of that length, or 0: of records, of which the file has one.
  size_t addDimension(const std::string& name, uint64_t length);
  // Of the file.
  void addAttribute(const std::string& name, const std::string& text);
  void addAttribute(const std::string& name, NetcdfType type, double number);
  // `dimensions`: that of records first, if at all. `attribute` may be empty, else it is a name and
  // its text. `write` puts all values.
  void addVariable(const std::string& name, NetcdfType type, std::vector<size_t> dimensions,
                   std::pair<std::string, std::string> attribute, Write write);
  // The file, from the first byte to the last.
  void write();

 private:
  struct Dimension {
    std::string name;
    uint64_t length;
  };
  struct Attribute {
    std::string name, text;
    NetcdfType type = NetcdfType::kChar;
    double number = 0;
  };
  struct Variable {
    std::string name;
    NetcdfType type;
    std::vector<size_t> dimensions;
    std::pair<std::string, std::string> attribute;
    Write write;
    uint64_t bytes = 0, begin = 0;  // without what fills it up
    bool of_records = false;
  };
  void layOut();
  std::string header(uint64_t body) const;
  void addList(std::string& text, uint32_t tag, size_t entries) const;
  void addAttributes(std::string& text, const std::vector<Attribute>& attributes) const;
  void addCount(std::string& text, uint64_t count) const;
  void addName(std::string& text, const std::string& name) const;
  void writeValues(const Variable& variable);

  ByteSink& sink_;
  BufferedSink out_;
  uint64_t most_;
  bool is_wide_ = false;
  std::vector<Dimension> dimensions_;
  std::vector<Attribute> attributes_;
  std::vector<Variable> variables_;
};

}  // namespace tetstream
