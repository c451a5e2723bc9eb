// tests: Exodus II files in netCDF's classic layouts, made byte by byte.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tetstream::test {

struct TestVariable {
  std::string name;
  int type;  // 2 text, 4 int, 5 float, 6 double, 10 int of 64 bits
  std::vector<std::string> dimensions;
  std::vector<double> values;  // of all records
  std::string text, attribute = "";
};

// A file as the three layouts have it: 1 the first, 2 with 64-bit offsets, 5 with 64-bit numbers.
class NetcdfMaker {
 public:
  int version = 1;
  bool streaming = false;                      // the number of records is not told
  std::map<std::string, uint64_t> dimensions;  // 0: records
  std::vector<TestVariable> variables;
  uint64_t records = 0;

  std::string make() const {
    // The header has the same size whatever the places in it are.
    const std::vector<uint64_t> none(variables.size());
    const uint64_t header_bytes = header(none).size();
    std::vector<uint64_t> begins;
    std::string fixed, record;
    for (const TestVariable& v : variables)
      if (!ofRecords(v)) {
        begins.push_back(header_bytes + fixed.size());
        fixed += padded(bytesOf(v, 0, countOf(v)));
      } else {
        begins.push_back(0);
      }
    std::string all = fixed;
    for (uint64_t r = 0; r < records; ++r)
      for (size_t i = 0; i < variables.size(); ++i) {
        const TestVariable& v = variables[i];
        if (!ofRecords(v)) continue;
        if (r == 0) begins[i] = header_bytes + all.size();
        const uint64_t row = countOf(v);
        all += padded(bytesOf(v, r * row, row));
      }
    return header(begins) + all;
  }

 private:
  static std::string padded(std::string bytes) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes;
  }
  static std::string big(uint64_t value, size_t bytes) {
    std::string text;
    for (size_t i = bytes; i-- > 0;) text += static_cast<char>(value >> 8 * i & 255);
    return text;
  }
  std::string count(uint64_t value) const { return big(value, version == 5 ? 8 : 4); }
  std::string name(const std::string& text) const { return count(text.size()) + padded(text); }
  bool ofRecords(const TestVariable& v) const {
    return !v.dimensions.empty() && dimensions.at(v.dimensions[0]) == 0;
  }
  uint64_t countOf(const TestVariable& v) const {
    uint64_t n = 1;
    for (const std::string& d : v.dimensions) n *= std::max<uint64_t>(dimensions.at(d), 1);
    return n;
  }
  static std::string bytesOf(const TestVariable& v, uint64_t first, uint64_t n) {
    if (v.type == 2) {
      std::string text = v.text;
      text.resize(n);
      return text;
    }
    std::string bytes;
    for (uint64_t i = first; i < first + n; ++i) {
      const double x = i < v.values.size() ? v.values[i] : 0;
      if (v.type == 4) bytes += big(static_cast<uint64_t>(static_cast<int64_t>(x)), 4);
      if (v.type == 10) bytes += big(static_cast<uint64_t>(static_cast<int64_t>(x)), 8);
      if (v.type == 5) bytes += big(std::bit_cast<uint32_t>(static_cast<float>(x)), 4);
      if (v.type == 6) bytes += big(std::bit_cast<uint64_t>(x), 8);
    }
    return bytes;
  }

  std::string header(const std::vector<uint64_t>& begins) const {
    std::string h = "CDF" + std::string(1, static_cast<char>(version));
    h += streaming ? count(UINT64_MAX) : count(records);
    h += big(10, 4) + count(dimensions.size());
    std::map<std::string, uint64_t> number;
    for (const auto& [key, size] : dimensions) {
      number.emplace(key, number.size());
      h += name(key) + count(size);
    }
    // An attribute of the file, of two doubles.
    h += big(12, 4) + count(1) + name("version") + big(6, 4) + count(2) + std::string(16, 'x');
    h += big(11, 4) + count(variables.size());
    for (size_t i = 0; i < variables.size(); ++i) {
      const TestVariable& v = variables[i];
      h += name(v.name) + count(v.dimensions.size());
      for (const std::string& d : v.dimensions) h += count(number.at(d));
      if (v.attribute.empty())
        h += big(0, 4) + count(0);
      else
        h += big(12, 4) + count(1) + name("elem_type") + big(2, 4) + name(v.attribute);
      h += big(static_cast<uint64_t>(v.type), 4) + count(4 * countOf(v)) +
           big(begins[i], version == 1 ? 4 : 8);
    }
    return h;
  }
};

// Two blocks of one tetrahedron each that share a face, a field and a cell array over three time
// steps, two side sets; the shared face is in both.
inline NetcdfMaker twoBlocks(int version = 1) {
  NetcdfMaker m;
  m.version = version;
  m.records = 3;
  const int integer = version == 5 ? 10 : 4;
  m.dimensions = {{"time", 0}, {"nodes", 5}, {"blocks", 2}, {"one", 1},
                  {"four", 4}, {"two", 2},   {"len", 9}};
  m.variables = {
      {"time_whole", 6, {"time"}, {0, 0.5, 1}, ""},
      {"coordx", 6, {"nodes"}, {0, 1, 0, 0, 1}, ""},
      {"coordy", 6, {"nodes"}, {0, 0, 1, 0, 1}, ""},
      {"coordz", 6, {"nodes"}, {0, 0, 0, 1, 1}, ""},
      {"eb_prop1", integer, {"blocks"}, {30, 20}, ""},
      {"eb_names", 2, {"blocks", "len"}, {}, std::string("rock\0\0\0\0\0sand", 13)},
      {"connect1", integer, {"one", "four"}, {1, 2, 3, 4}, "", "TETRA"},
      {"connect2", integer, {"one", "four"}, {2, 3, 4, 5}, "", "tet4"},
      {"name_nod_var", 2, {"one", "len"}, {}, "p"},
      {"name_elem_var", 2, {"one", "len"}, {}, "rho"},
      {"vals_nod_var1",
       6,
       {"time", "nodes"},
       {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14},
       ""},
      {"vals_elem_var1eb2", 5, {"time", "one"}, {0.25, 0.5, 0.75}, ""},
      {"ss_prop1", integer, {"two"}, {7, 9}, ""},
      {"ss_names", 2, {"two", "len"}, {}, "inlet"},
      {"elem_ss1", integer, {"two"}, {1, 1}, ""},
      {"side_ss1", integer, {"two"}, {4, 2}, ""},
      {"elem_ss2", integer, {"two"}, {2, 2}, ""},
      {"side_ss2", integer, {"two"}, {4, 2}, ""},
      {"ns_prop1", integer, {"two"}, {1, 2}, ""},
  };
  return m;
}

}  // namespace tetstream::test
