// Exodus II files in netCDF's classic layouts, which are made here byte by byte.
#include <gtest/gtest.h>

#include <bit>
#include <map>

#include "status.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

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
NetcdfMaker twoBlocks(int version = 1) {
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

TestVariable& variable(NetcdfMaker& m, const std::string& name) {
  for (TestVariable& v : m.variables)
    if (v.name == name) return v;
  throw std::runtime_error(name);
}

bool hasNote(const VtuMesh& mesh, const std::string& text) {
  for (const std::string& note : mesh.notes)
    if (has(note, text)) return true;
  return false;
}

TEST(Exodus, IsReadInEachLayout) {
  for (const int version : {1, 2, 5})
    for (const bool streaming : {false, true})
      for (const size_t step : {1, 1000}) {
        NetcdfMaker m = twoBlocks(version);
        m.streaming = streaming;
        const VtuMesh mesh = readAs("exodus", m.make(), step);
        EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat64);
        EXPECT_EQ(valuesAs<double>(mesh.positions),
                  (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
        EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
        ASSERT_EQ(mesh.schema.fields.size(), 1u);
        EXPECT_EQ(mesh.schema.fields[0].name, "p");
        EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{10, 11, 12, 13, 14}));
        ASSERT_EQ(mesh.schema.cell_data.size(), 2u);
        EXPECT_EQ(mesh.schema.cell_data[1].name, "rho");
        EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{30, 20}));
        EXPECT_EQ(valuesAs<float>(mesh.cell_data[1]), (std::vector<float>{0, 0.75}));
        EXPECT_TRUE(hasNote(mesh, "of 3 time steps, 0 to 2, step 2 is read, at time 1"));
        EXPECT_TRUE(hasNote(mesh, "\"rho\" has no value at 1 elements"));
        EXPECT_TRUE(hasNote(mesh, "block_id 30 \"rock\""));
        EXPECT_TRUE(hasNote(mesh, "side set 7 labels faces, \"inlet\""));
        EXPECT_TRUE(hasNote(mesh, "2 node sets are left out"));
      }
}

TEST(Exodus, SidesLabelFacesOnceEach) {
  const VtuMesh mesh = readAs("exodus", twoBlocks().make(), 1);
  std::map<std::vector<int64_t>, int64_t> labels;
  for (size_t i = 0; i < mesh.face_labels.size(); ++i) {
    std::vector<int64_t> corners(mesh.faces.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                 mesh.faces.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    std::sort(corners.begin(), corners.end());
    labels[corners] = mesh.face_labels[i];
  }
  EXPECT_EQ(mesh.face_labels.size(), 3u);
  EXPECT_EQ(labels, (std::map<std::vector<int64_t>, int64_t>{
                        {{0, 1, 2}, 7}, {{1, 2, 3}, 7}, {{2, 3, 4}, 9}}));
  EXPECT_TRUE(hasNote(mesh, "1 faces are in side sets more than once"));
}

TEST(Exodus, TheTimeStepIsChosen) {
  const std::string file = twoBlocks().make();
  ReadOptions options;
  options.step = 1;
  const VtuMesh mesh = readAs("exodus", file, 1000, options);
  EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{5, 6, 7, 8, 9}));
  EXPECT_TRUE(hasNote(mesh, "step 1 is read, at time 0.5"));
  options.step = 3;
  try {
    readAs("exodus", file, 1000, options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadArgument);
    EXPECT_TRUE(has(error.text(), "there is no time step 3")) << error.text();
  }
}

TEST(Exodus, OldFilesHaveCoordinatesAndVariablesInOneEach) {
  NetcdfMaker m = twoBlocks();
  m.dimensions["three"] = 3;
  m.variables[1] = {
      "coord", 6, {"three", "nodes"}, {0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1}, ""};
  m.variables.erase(m.variables.begin() + 2, m.variables.begin() + 4);
  TestVariable& names = variable(m, "name_nod_var");
  names.dimensions[0] = "two";
  names.text = std::string("p\0\0\0\0\0\0\0\0q", 10);
  TestVariable& values = variable(m, "vals_nod_var1");
  values.name = "vals_nod_var";
  values.dimensions = {"time", "two", "nodes"};
  values.values.resize(30);
  for (size_t i = 0; i < 30; ++i) values.values[i] = static_cast<double>(i);
  const VtuMesh mesh = readAs("exodus", m.make(), 2);
  EXPECT_EQ(valuesAs<double>(mesh.positions),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  ASSERT_EQ(mesh.fields.size(), 2u);
  EXPECT_EQ(valuesAs<double>(mesh.fields[1]), (std::vector<double>{25, 26, 27, 28, 29}));
}

// A prism on a tetrahedron, and a block of triangles.
TEST(Exodus, OtherBlocksAreSplitIfAskedFor) {
  NetcdfMaker m = twoBlocks();
  m.dimensions["six"] = 6;
  m.dimensions["three"] = 3;
  variable(m, "connect2") = {"connect2", 4, {"one", "six"}, {2, 3, 4, 5, 1, 2}, "", "WEDGE"};
  variable(m, "connect1") = {"connect1", 4, {"one", "three"}, {1, 2, 3}, "", "TRI3"};
  for (const char* set : {"elem_ss1", "side_ss1"}) variable(m, set).values = {2, 2};
  const std::string refused = failureAs("exodus", m.make());
  EXPECT_TRUE(has(refused,
                  "UNSUPPORTED: test.exodus: element block 20 (\"sand\") has elements "
                  "\"WEDGE\" of 6 nodes; only tetrahedra are read, unless"))
      << refused;
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("exodus", m.make(), 1, options);
  EXPECT_TRUE(hasNote(mesh, "1 cells that are no tetrahedra are split"));
  EXPECT_TRUE(hasNote(mesh, "1 cells of lower dimension are left out"));
  for (const int32_t id : valuesAs<int32_t>(mesh.cell_data[0])) EXPECT_EQ(id, 20);
  m.variables.erase(m.variables.begin() + 12, m.variables.begin() + 18);  // no side sets
  const VtuMesh labelled = readAs("exodus", m.make(), 1, options);
  EXPECT_EQ(labelled.face_labels, (std::vector<int64_t>{30}));
}

TEST(Exodus, SaysWhatIsWrong) {
  const auto failure = [](auto change) {
    NetcdfMaker m = twoBlocks();
    change(m);
    return failureAs("exodus", m.make());
  };
  EXPECT_TRUE(has(failureAs("exodus", "no netCDF"), "BAD_DATA: test.exodus: this is no netCDF"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) {
                    variable(m, "connect2").values[0] = 6;
                    for (const char* list : {"side_ss1", "side_ss2"})
                      variable(m, list).values = {1, 2};
                    variable(m, "elem_ss2").values = {1, 1};
                  }),
                  "cell 1 uses point 5, there are 5"));
  EXPECT_TRUE(has(failureAs("exodus", ""), "BAD_DATA: test.exodus: this is no netCDF"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "connect2").values[3] = 6; }),
                  "element 2 uses node 6, there are 5"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "connect2").values[3] = 0; }),
                  "element 2 uses node 0, there are 5"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "elem_ss2").values[1] = 3; }),
                  "side set 2 names element 3, there are 2"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "side_ss2").values[1] = 5; }),
                  "side set 2 names side 5 of a tetrahedron"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "side_ss2").dimensions = {"one"}; }),
                  "\"elem_ss2\" and \"side_ss2\" do not match"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "coordy").dimensions = {"four"}; }),
                  "the coordinates are not as many"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "coordz").name = "other"; }),
                  "UNSUPPORTED: test.exodus: the mesh has not three dimensions"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "connect1").attribute = "NFACED"; }),
                  "element block 30 (\"rock\") has elements \"NFACED\""));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "vals_nod_var1").name = "x"; }),
                  "there is no \"vals_nod_var\""));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { m.version = 3; }), "netCDF of version 3"));
}

TEST(Exodus, RefusesClaimsAndFilesThatAreCut) {
  for (const int version : {1, 5}) {
    const std::string good = twoBlocks(version).make();
    for (size_t size = 0; size < good.size(); size += version == 1 ? 1 : 7) {
      const std::string text = failureAs("exodus", good.substr(0, size));
      EXPECT_TRUE(text.starts_with("TETSTREAM_BAD_DATA: test.exodus: ")) << size << ": " << text;
    }
    // Any word of the header may be a lie: nothing worse than an error comes of it.
    for (size_t at = 4; at + 4 <= good.size() && at < 1600; at += 4)
      for (const char* lie : {"\x7F\xFF\xFF\xFF", "\xFF\xFF\xFF\xFF", "\x00\x00\x00\x00"}) {
        std::string bad = good;
        bad.replace(at, 4, lie, 4);
        failureAs("exodus", bad);
      }
  }
}

}  // namespace
}  // namespace tetstream
