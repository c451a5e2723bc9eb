#include "vtk_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string_view>

#include "field_time.h"
#include "status.h"
#include "vtk_scan.h"

namespace tetstream {

namespace {

constexpr size_t kMaxVtkArrays = 1 << 12;  // of one mesh, as they are compared by name
constexpr uint64_t kMaxComponents = 9;

struct TypeWord {
  const char* word;
  ValueType type;
};

// "long" has the eight bytes of 64-bit Unix systems, "vtkidtype" is written as int.
constexpr TypeWord kTypeWords[] = {
    {"bit", ValueType::kUInt8},
    {"char", ValueType::kInt8},
    {"signed_char", ValueType::kInt8},
    {"unsigned_char", ValueType::kUInt8},
    {"short", ValueType::kInt16},
    {"unsigned_short", ValueType::kUInt16},
    {"int", ValueType::kInt32},
    {"unsigned_int", ValueType::kUInt32},
    {"long", ValueType::kInt64},
    {"unsigned_long", ValueType::kUInt64},
    {"vtkidtype", ValueType::kInt32},
    {"vtktypeint32", ValueType::kInt32},  // as meshio writes it
    {"vtktypeint64", ValueType::kInt64},
    {"vtktypeuint64", ValueType::kUInt64},
    {"float", ValueType::kFloat32},
    {"double", ValueType::kFloat64},
};

// Arrays that are not of a FIELD.
struct Attribute {
  const char* word;
  int components;
  bool dimension;  // stands between the name and the type
};

constexpr Attribute kAttributes[] = {
    {"vectors", 3, false},    {"normals", 3, false},
    {"tensors", 9, false},    {"tensors6", 6, false},
    {"global_ids", 1, false}, {"pedigree_ids", 1, false},
    {"edge_flags", 1, false}, {"texture_coordinates", 0, true},
};

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

// Names of version 3 and later stand with %20 for blanks and the like.
std::string decoded(const std::string& word) {
  std::string name;
  for (size_t i = 0; i < word.size(); ++i) {
    unsigned value = 0;
    const char* const digits = word.data() + i + 1;
    if (word[i] == '%' && i + 2 < word.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2 && value != 0) {
      name += static_cast<char>(value);
      i += 2;
    } else {
      name += word[i];
    }
  }
  return name;
}

std::string quotedWord(const std::string& word) {
  return textOf("\"%s\"", cutName(word).c_str());
}

enum class Part { kNone, kPoints, kCells };

class VtkParser {
 public:
  explicit VtkParser(ByteSource& bytes) : bytes_(bytes), scan_(bytes) {}

  VtkFile run() {
    readHead();
    for (;;) {
      keyword_at_ = scan_.place();
      const std::string word = lower(scan_.word());
      if (word.empty()) break;
      readSection(word);
    }
    if (!file_.points) scan_.fail(bytes_.size(), "there are no POINTS");
    if (file_.cell_count > 0 && !file_.types) scan_.fail(bytes_.size(), "there are no CELL_TYPES");
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& text) const { scan_.fail(keyword_at_, text); }
  void note(const std::string& text) { MeshPieces::addNoteTo(file_.notes, text); }

  void readHead() {
    const std::string first = scan_.line();
    unsigned version = 0;
    constexpr const char* kMark = "# vtk DataFile Version ";
    if (first.compare(0, std::strlen(kMark), kMark) != 0 ||
        std::from_chars(first.data() + std::strlen(kMark), first.data() + first.size(), version)
                .ec != std::errc())
      fail("this is no VTK file: it does not begin with \"# vtk DataFile Version\"");
    file_.offsets = version >= 5;
    scan_.line();  // the title
    keyword_at_ = scan_.place();
    const std::string coding = lower(scan_.word());
    file_.binary = coding == "binary";
    if (!file_.binary && coding != "ascii") fail("here stands neither ASCII nor BINARY");
    keyword_at_ = scan_.place();
    if (lower(scan_.word()) != "dataset") fail("there is no DATASET");
    const std::string kind = scan_.word();
    // GCC 12 takes a comparison with a literal to read over the end of a short string.
    if (lower(kind) != std::string_view("unstructured_grid"))
      tetstream::fail(Status::kUnsupported, "%s: the file holds \"%s\", no UNSTRUCTURED_GRID",
                      bytes_.name().c_str(), cutName(kind).c_str());
    scan_.line();
  }

  void readSection(const std::string& word) {
    if (word == "points") return readPoints();
    if (word == "cells") return file_.offsets ? readOffsets() : readCells();
    if (word == "cell_types") return readTypes();
    if (word == "point_data") return enter(Part::kPoints, file_.points ? file_.points->rows : 0);
    if (word == "cell_data") return enter(Part::kCells, file_.cell_count);
    if (word == "field") return readField();
    if (word == "scalars") return readScalars();
    if (word == "color_scalars") return readColours();
    if (word == "lookup_table") return skipTable();
    if (word == "metadata") return skipMetadata();
    for (const Attribute& attribute : kAttributes)
      if (word == attribute.word) return readAttribute(attribute);
    fail(quotedWord(word) + " is no keyword of an unstructured grid");
  }

  uint64_t number(const char* what, uint64_t most = kMaxMeshCount) {
    const std::string word = scan_.word();
    uint64_t value = 0;
    const auto r = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || r.ec != std::errc() || r.ptr != word.data() + word.size() || value > most)
      fail(std::string(what) + " is missing or no number that can be");
    return value;
  }

  // True for a type of numbers; a name that is none of VTK's is an error.
  bool readType(VtkArray& array, const std::string& word) {
    const std::string type = lower(word);
    for (const TypeWord& row : kTypeWords)
      if (type == row.word) {
        array.type = row.type;
        array.bits = file_.binary && type == "bit";
        return true;
      }
    if (type != "string") fail(quotedWord(word) + " is no type of values");
    return false;
  }

  // The values begin after the line. They are passed; those of an array stay in the file.
  void passValues(VtkArray& array) {
    scan_.line();
    array.begin = scan_.place();
    const uint64_t count = array.rows * static_cast<uint64_t>(array.components);
    const uint64_t left = bytes_.size() - std::min(bytes_.size(), array.begin);
    if (file_.binary) {
      const uint64_t size = array.bits ? (count + 7) / 8 : count * sizeOf(array.type);
      if (size > left) failShort(array);
      array.end = array.begin + size;
      scan_.seek(array.end);
    } else {
      if (count > left / 2 + 1 || !scan_.skipWords(count)) failShort(array);
      array.end = scan_.place();
    }
  }

  [[noreturn]] void failShort(const VtkArray& array) const {
    fail(textOf("the file ends before the %llu x %d values of \"%s\"",
                static_cast<unsigned long long>(array.rows), array.components, array.name.c_str()));
  }

  void passStrings(uint64_t count) {
    scan_.line();
    if (count > bytes_.size()) fail("the file ends before its strings do");
    for (uint64_t i = 0; i < count; ++i) {
      if (scan_.atEnd()) fail("the file ends before its strings do");
      file_.binary ? passBinaryString() : static_cast<void>(scan_.line());
    }
  }

  // The two highest bits of the first byte tell how many bytes the length takes: 8, 4, 2, 1.
  void passBinaryString() {
    unsigned char head[8] = {};
    bytes_.readAt(scan_.place(), head, sizeof head);
    const size_t words = size_t{8} >> (head[0] >> 6);
    uint64_t length = head[0] & 0x3F;
    for (size_t i = 1; i < words; ++i) length = length << 8 | head[i];
    const uint64_t left = bytes_.size() - scan_.place();
    if (words > left || length > left - words) fail("the file ends before its strings do");
    scan_.seek(scan_.place() + words + length);
  }

  void readPoints() {
    if (file_.points) fail("there are two sets of POINTS");
    VtkArray array{"Points", ValueType::kFloat32, false, 3, number("the number of points"), 0, 0};
    described_ = array.components;
    if (!readType(array, scan_.word())) fail("points are no strings");
    passValues(array);
    file_.points = array;
  }

  void needNoCells(const std::optional<VtkArray>& array) const {
    if (array) fail("there are two sets of cells");
  }

  void setCellCount(uint64_t count) {
    if ((file_.cells || file_.types) && count != file_.cell_count)
      fail("CELLS and CELL_TYPES have different numbers of cells");
    file_.cell_count = count;
  }

  void readCells() {
    needNoCells(file_.cells);
    setCellCount(number("the number of cells"));
    VtkArray array{"CELLS", ValueType::kInt32, false, 1, number("the size of the cells"), 0, 0};
    passValues(array);
    file_.cells = array;
  }

  void readOffsets() {
    needNoCells(file_.cells);
    const uint64_t ends = number("the number of offsets");
    setCellCount(ends > 0 ? ends - 1 : 0);
    const uint64_t size = number("the size of the connectivity");
    file_.cell_ends = readPart("offsets", ends);
    file_.cells = readPart("connectivity", size);
  }

  VtkArray readPart(const char* name, uint64_t rows) {
    scan_.line();
    keyword_at_ = scan_.place();
    if (lower(scan_.word()) != name) fail("here should stand the " + std::string(name));
    VtkArray array{name, ValueType::kInt64, false, 1, rows, 0, 0};
    if (!readType(array, scan_.word()) || isFloat(array.type)) fail("cells are no integers");
    passValues(array);
    return array;
  }

  void readTypes() {
    needNoCells(file_.types);
    setCellCount(number("the number of cells"));
    VtkArray array{"CELL_TYPES", ValueType::kInt32, false, 1, file_.cell_count, 0, 0};
    passValues(array);
    file_.types = array;
  }

  void enter(Part part, uint64_t rows) {
    if (!file_.points) fail("there is data before the POINTS");
    const uint64_t claimed = number("the number of rows");
    if (claimed != rows)
      fail(textOf(
          "there is data for %llu %s, but there are %llu", static_cast<unsigned long long>(claimed),
          part == Part::kPoints ? "points" : "cells", static_cast<unsigned long long>(rows)));
    part_ = part;
    scan_.line();
  }

  void keep(VtkArray array) {
    std::vector<VtkArray>& list = part_ == Part::kPoints ? file_.point_data : file_.cell_data;
    const uint64_t rows = part_ == Part::kPoints ? file_.points->rows : file_.cell_count;
    if (part_ == Part::kNone) return keepTime(std::move(array));
    if (array.rows != rows)
      return note("array \"" + array.name + "\" is left out: it has other rows than the mesh");
    for (const VtkArray& other : list)
      if (other.name == array.name)
        return note("array \"" + array.name + "\" is there twice: the second one is left out");
    if (list.size() == kMaxVtkArrays)
      tetstream::fail(Status::kUnsupported, "%s: too many arrays", bytes_.name().c_str());
    list.push_back(std::move(array));
  }

  // Of what belongs to no vertex or cell: of all that only the time.
  void keepTime(VtkArray array) {
    if (!isVtkTime(array.name) || array.rows != 1 || array.components != 1)
      return note("field data is left out: it belongs to no vertex or cell");
    if (!file_.time) file_.time = std::move(array);
  }

  // Sets the name and the number of components; false if the array cannot be kept.
  bool describe(VtkArray& array, const std::string& word, uint64_t components) {
    const std::string name = decoded(word);
    array.name = cutName(name);
    if (array.name.size() < name.size())
      note("array \"" + array.name + "\" has a longer name, cut to 255 bytes");
    array.components = described_ = static_cast<int>(components);
    if (components >= 1 && components <= kMaxComponents) return true;
    note("array \"" + array.name + "\" is left out: it has " + std::to_string(components) +
         " components, 1 to 9 are possible");
    return false;
  }

  uint64_t partRows() const {
    if (part_ == Part::kNone) fail("this array stands before POINT_DATA and CELL_DATA");
    return part_ == Part::kPoints ? file_.points->rows : file_.cell_count;
  }

  void readField() {
    scan_.word();  // the field's own name
    const uint64_t arrays = number("the number of arrays");
    for (uint64_t i = 0; i < arrays; ++i) {
      std::string name = scan_.word();
      while (lower(name) == "metadata") {
        skipMetadata();
        keyword_at_ = scan_.place();
        name = scan_.word();
      }
      if (name.empty()) fail("the file ends before the field's arrays do");
      readFieldArray(name);
      keyword_at_ = scan_.place();
    }
  }

  void readFieldArray(const std::string& name) {
    VtkArray array;
    const uint64_t components = number("the number of components", 1 << 20);
    array.rows = number("the number of rows", kMaxMeshCount >> 20);
    const bool possible = describe(array, name, components);
    if (!readType(array, scan_.word())) {
      passStrings(components * array.rows);
      return note("array \"" + array.name + "\" is left out: its values are no numbers");
    }
    passValues(array);
    if (possible) keep(std::move(array));
  }

  void readScalars() {
    VtkArray array;
    array.rows = partRows();
    const std::string name = scan_.word();
    const std::string type = scan_.word();
    const std::string count = scan_.word(true);
    uint64_t components = 1;
    if (!count.empty() &&
        std::from_chars(count.data(), count.data() + count.size(), components).ec != std::errc())
      fail("the number of components is no number");
    if (!describe(array, name, components)) fail("SCALARS have 1 to 4 components");
    if (!readType(array, type)) return passStrings(array.rows);
    const uint64_t before = scan_.place();
    scan_.line();
    if (lower(scan_.word()) == "lookup_table")
      scan_.word(true);
    else
      scan_.seek(before);
    passValues(array);
    keep(std::move(array));
  }

  void readColours() {
    VtkArray array;
    array.rows = partRows();
    const std::string name = scan_.word();
    if (!describe(array, name, number("the number of components", kMaxComponents)))
      fail("COLOR_SCALARS have 1 to 4 components");
    array.type = file_.binary ? ValueType::kUInt8 : ValueType::kFloat32;
    passValues(array);
    keep(std::move(array));
  }

  void readAttribute(const Attribute& attribute) {
    VtkArray array;
    array.rows = partRows();
    const std::string name = scan_.word();
    uint64_t components = static_cast<uint64_t>(attribute.components);
    if (attribute.dimension) components = number("the dimension", 3);
    if (!describe(array, name, components)) fail("the dimension is 1 to 3");
    if (!readType(array, scan_.word())) {
      passStrings(array.rows);
      return note("array \"" + array.name + "\" is left out: its values are no numbers");
    }
    passValues(array);
    keep(std::move(array));
  }

  void skipTable() {
    VtkArray table;
    table.name = cutName(scan_.word());
    table.rows = number("the size of the table", kMaxMeshCount >> 8);
    table.components = 4;
    table.type = ValueType::kUInt8;
    passValues(table);
  }

  // Names of components and facts about the last array, up to an empty line; components without a
  // name have an empty line, too.
  void skipMetadata() {
    scan_.line();
    std::string line = scan_.line();
    if (lower(line) == "component_names")
      for (int i = 0; i < described_; ++i) line = scan_.line() + ".";
    while (!scan_.atEnd() && !line.empty()) line = scan_.line();
  }

  ByteSource& bytes_;
  VtkScan scan_;
  VtkFile file_;
  Part part_ = Part::kNone;
  int described_ = 0;  // components of the last array
  uint64_t keyword_at_ = 0;
};

}  // namespace

VtkFile parseVtk(ByteSource& bytes) {
  return VtkParser(bytes).run();
}

}  // namespace tetstream
