// The XML part of .vtu files, up to the start tag of AppendedData, after which the file need not be
// XML any more. Elements that are not known are passed over with everything in them.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <iterator>

#include "field_time.h"
#include "status.h"
#include "vtu_blocks.h"
#include "vtu_file.h"
#include "xml_feed.h"

namespace tetstream {

namespace {

// These bound what a hostile header costs in memory and, as arrays are compared by name, in time.
constexpr size_t kMaxArrays = 1 << 18;  // of all pieces
constexpr size_t kMaxPieceArrays = 1 << 12;

enum class Section { kOther, kPointData, kCellData, kPoints, kCells };

bool parseType(const char* text, ValueType* type) {
  static const char* const names[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                      "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  for (int i = 0; i < 10; ++i)
    if (std::strcmp(text, names[i]) == 0) {
      *type = static_cast<ValueType>(i);
      return true;
    }
  return false;
}

class HeaderParser final : XmlFeed {
 public:
  HeaderParser(ByteSource& bytes, const ChooseVtuStep& choose) : XmlFeed(bytes), choose_(choose) {}

  VtuFile run() {
    feed();
    if (file_.pieces.empty()) failAt(lastEvent(), "there is no <Piece>");
    if (some_claim_first_) keepStep();
    if (stopped()) placeAppended();
    for (VtuPiece& piece : file_.pieces) finishPiece(piece);
    if (file_.time) finishArray(*file_.time);
    return std::move(file_);
  }

 private:
  void start(const char* name, Attributes attributes) override {
    if (!skipping_ && !enter(name, attributes)) {
      skipping_ = true;
      skip_from_ = depth_;
    }
    ++depth_;
  }

  void end() override {
    --depth_;
    if (skipping_ && depth_ == skip_from_) skipping_ = false;
    if (depth_ <= 4) closeText();
  }

  // False if the element and what is in it do not matter.
  bool enter(const char* name, Attributes attributes) {
    switch (depth_) {
      case 0:
        return enterRoot(name, attributes);
      case 1:
        return enterPart(name, attributes);
      case 2:
        return enterPiece(name, attributes);
      case 3:
        return in_field_data_ ? enterFieldArray(attributes) : enterSection(name, attributes);
      case 4:
        if (!in_field_data_) return enterArray(name, attributes);
        [[fallthrough]];
      default:
        closeText();
        return false;  // VTK puts facts about an array after its values
    }
  }

  bool enterRoot(const char* name, Attributes attributes) {
    if (std::strcmp(name, "VTKFile") != 0)
      failHere("this is not a VTK XML file: it begins with <" + cutName(name) + ">");
    const char* type = find(attributes, "type");
    if (!type || std::strcmp(type, "UnstructuredGrid") != 0)
      failHere("the file holds \"" + cutName(type ? type : "") + "\", no UnstructuredGrid",
               Status::kUnsupported);
    if (const char* order = find(attributes, "byte_order")) {
      file_.big_endian = std::strcmp(order, "BigEndian") == 0;
      if (!file_.big_endian && std::strcmp(order, "LittleEndian") != 0)
        failHere("byte_order is neither LittleEndian nor BigEndian");
    }
    if (const char* header = find(attributes, "header_type")) {
      file_.word_bytes = std::strcmp(header, "UInt64") == 0 ? 8 : 4;
      if (file_.word_bytes == 4 && std::strcmp(header, "UInt32") != 0)
        failHere("header_type is neither UInt32 nor UInt64");
    }
    if (const char* compressor = find(attributes, "compressor")) compressor_ = cutName(compressor);
    file_.compressor = findVtuCompressor(compressor_);
    return true;
  }

  bool enterPart(const char* name, Attributes attributes) {
    if (std::strcmp(name, "UnstructuredGrid") == 0) {
      const char* times = find(attributes, "TimeValues");
      if (times && times_.empty()) times_ = numbersOf<double>("TimeValues", times);
      if (!times_.empty()) step_ = choose_(times_);
      return true;
    }
    if (std::strcmp(name, "AppendedData") != 0) return false;
    const char* encoding = find(attributes, "encoding");
    raw_ = encoding && std::strcmp(encoding, "raw") == 0;
    if (encoding && !raw_ && std::strcmp(encoding, "base64") != 0)
      failHere("the encoding of the appended data is neither raw nor base64");
    appended_begin_ = tagEnd();
    stop();
    return true;
  }

  // Of an attribute, between blanks.
  template <class Number>
  std::vector<Number> numbersOf(const char* attribute, const char* text) const {
    std::vector<Number> numbers;
    const char* const end = text + std::strlen(text);
    while ((text = std::find_if(text, end, [](char c) { return c != ' '; })) != end) {
      const char* const word_end = std::find(text, end, ' ');
      const std::from_chars_result r = std::from_chars(text, word_end, numbers.emplace_back());
      if (r.ec != std::errc() || r.ptr != word_end)
        failHere(std::string(attribute) + " has a word that is no number");
      text = word_end;
    }
    return numbers;
  }

  uint64_t count(Attributes attributes, const char* name) const {
    const char* text = find(attributes, name);
    uint64_t value = 0;
    if (!text || !parseUnsigned(text, &value))
      failHere(std::string(name) + " is missing or no number");
    if (value > kMaxMeshCount) failHere(std::string(name) + " is more than any file can hold");
    return value;
  }

  bool enterPiece(const char* name, Attributes attributes) {
    in_field_data_ = std::strcmp(name, "FieldData") == 0;
    if (in_field_data_) return true;
    if (std::strcmp(name, "Piece") != 0) return false;
    if (file_.pieces.size() == kMaxMeshPieces) failHere("too many pieces", Status::kUnsupported);
    VtuPiece piece;
    piece.point_count = count(attributes, "NumberOfPoints");
    piece.cell_count = count(attributes, "NumberOfCells");
    file_.pieces.push_back(std::move(piece));
    return true;
  }

  // What belongs to no vertex or cell: of all that only the time, of files without steps.
  bool enterFieldArray(Attributes attributes) {
    const char *name = find(attributes, "Name"), *type = find(attributes, "type"),
               *rows = find(attributes, "NumberOfTuples"),
               *components = find(attributes, "NumberOfComponents");
    VtuArray array;
    const bool is_time = name && isVtkTime(name) && type && parseType(type, &array.type) && rows &&
                         std::strcmp(rows, "1") == 0 &&
                         (!components || std::strcmp(components, "1") == 0);
    if (!is_time)
      file_.addNote("the file's FieldData is left out: it belongs to no vertex or cell");
    if (!is_time || file_.time || !times_.empty()) return false;
    array.name = name;
    setFormat(array, attributes);
    file_.time = std::move(array);
    open_ = &*file_.time;
    return true;
  }

  bool enterSection(const char* name, Attributes attributes) {
    static const char* const names[] = {"PointData", "CellData", "Points", "Cells"};
    section_ = Section::kOther;
    for (int i = 0; i < 4; ++i)
      if (std::strcmp(name, names[i]) == 0) section_ = static_cast<Section>(i + 1);
    const char* ids = section_ == Section::kPointData ? find(attributes, "GlobalIds") : nullptr;
    if (ids) file_.global_ids = cutName(ids);
    return section_ != Section::kOther;
  }

  static const char* formatOf(Attributes attributes) {
    const char* format = find(attributes, "format");
    return format ? format : find(attributes, "offset") ? "appended" : "ascii";
  }

  // Arrays of all steps are in one piece, each with its own step or a list of them; those without
  // are of all. But values that are not appended VTK writes as pieces for one step after the other,
  // in which all arrays claim step 0: such are kept until the end tells.
  bool mayBeOfStep(Attributes attributes) {
    const char* steps = times_.empty() ? nullptr : find(attributes, "TimeStep");
    is_doubtful_ = false;
    if (!steps) return true;
    const std::vector<uint64_t> all = numbersOf<uint64_t>("TimeStep", steps);
    if (std::strcmp(formatOf(attributes), "appended") != 0) {
      const bool is_first = all == std::vector<uint64_t>{0};
      (is_first ? some_claim_first_ : some_claim_others_) = true;
      is_doubtful_ = is_first && step_ != 0;
    }
    return is_doubtful_ || std::find(all.begin(), all.end(), step_) != all.end();
  }

  void keepStep() {
    if (!some_claim_others_) return keepPiecesOfStep();
    const auto isDoubtful = [](const VtuArray& array) { return array.is_doubtful; };
    for (VtuPiece& piece : file_.pieces) {
      std::erase_if(piece.point_data, isDoubtful);
      std::erase_if(piece.cell_data, isDoubtful);
      for (std::optional<VtuArray>* array : meshOf(piece))
        if (*array && isDoubtful(**array)) array->reset();
    }
  }

  void keepPiecesOfStep() {
    std::vector<VtuPiece>& pieces = file_.pieces;
    if (pieces.size() % times_.size() != 0)
      failAt(lastEvent(),
             std::to_string(pieces.size()) + " pieces are of " + std::to_string(times_.size()) +
                 " time steps, nobody knows which of which: their values are not appended",
             Status::kUnsupported);
    const auto count = static_cast<std::ptrdiff_t>(pieces.size() / times_.size());
    const auto first = pieces.begin() + static_cast<std::ptrdiff_t>(step_) * count;
    pieces = {std::make_move_iterator(first), std::make_move_iterator(first + count)};
  }

  bool enterArray(const char* element, Attributes attributes) {
    if (!mayBeOfStep(attributes)) return true;
    const char* name = find(attributes, "Name");
    const char* type = find(attributes, "type");
    const bool data = section_ == Section::kPointData || section_ == Section::kCellData;
    const VtuPiece& piece = file_.pieces.back();
    if (++array_count_ > kMaxArrays ||
        piece.point_data.size() + piece.cell_data.size() >= kMaxPieceArrays)
      failHere("too many arrays", Status::kUnsupported);
    VtuArray array;
    array.name = nameOf(name);
    array.is_doubtful = is_doubtful_;
    if (std::strcmp(element, "DataArray") != 0 || !type || !parseType(type, &array.type)) {
      if (data || std::strcmp(element, "DataArray") != 0)
        file_.addNote("array \"" + array.name + "\" is left out: its values are no numbers");
      else
        failHere("an array of points or cells has the type \"" + cutName(type ? type : "") + "\"");
      return std::strcmp(element, "DataArray") == 0;
    }
    if (!setComponents(array, attributes, data)) return true;
    setFormat(array, attributes);
    open_ = keep(std::move(array));
    return true;
  }

  // Arrays without a name are numbered over the data of their piece.
  std::string nameOf(const char* name) {
    const bool field = section_ == Section::kPointData;
    if (!field && section_ != Section::kCellData) return name ? cutName(name) : "";
    if (name && *name) {
      if (std::strlen(name) > kMostNameBytes)
        file_.addNote("array \"" + cutName(name) + "\" has a longer name, cut to 255 bytes");
      return cutName(name);
    }
    const VtuPiece& piece = file_.pieces.back();
    const size_t number = (field ? piece.point_data : piece.cell_data).size() + 1;
    std::string made = (field ? "field_" : "cell_data_") + std::to_string(number);
    file_.addNote("an array without a name is called \"" + made + "\"");
    return made;
  }

  bool setComponents(VtuArray& array, Attributes attributes, bool data) {
    const char* text = find(attributes, "NumberOfComponents");
    uint64_t value = section_ == Section::kPoints ? 3 : 1;
    if (text && !parseUnsigned(text, &value)) failHere("NumberOfComponents is no number");
    if (value == 0) value = 1;  // VTK takes it so
    if (section_ == Section::kPoints && value != 3)
      failHere("points have " + std::to_string(value) + " coordinates, not 3");
    if (value > 9) {
      if (!data) failHere("an array of cells has " + std::to_string(value) + " components");
      file_.addNote("array \"" + array.name + "\" is left out: it has " + std::to_string(value) +
                    " components, 9 at most are possible");
      return false;
    }
    array.components = static_cast<int>(value);
    return true;
  }

  void setFormat(VtuArray& array, Attributes attributes) const {
    const char* offset = find(attributes, "offset");
    const char* format = formatOf(attributes);
    array.begin = tagEnd();
    if (std::strcmp(format, "ascii") == 0) {
      array.format = VtuFormat::kAscii;
    } else if (std::strcmp(format, "binary") == 0) {
      array.format = VtuFormat::kInlineBase64;
    } else if (std::strcmp(format, "appended") == 0) {
      array.format = VtuFormat::kAppendedRaw;
      if (!offset || !parseUnsigned(offset, &array.begin))
        failHere("the offset of an appended array is missing or no number");
    } else {
      failHere("the format of an array is none of ascii, binary, appended");
    }
  }

  // Of arrays of the same name the first one, but for one of which it is known that it is of the
  // step; null if that is not the new one.
  static VtuArray* replace(VtuArray& old, VtuArray& array) {
    if (!old.is_doubtful || array.is_doubtful) return nullptr;
    old = std::move(array);
    return &old;
  }

  // Where the array went; null if it is not wanted.
  VtuArray* keep(VtuArray array) {
    VtuPiece& piece = file_.pieces.back();
    if (section_ == Section::kPointData) return keepAmong(piece.point_data, array);
    if (section_ == Section::kCellData) return keepAmong(piece.cell_data, array);
    std::optional<VtuArray>* place = &piece.points;
    if (section_ == Section::kCells) {
      place = array.name == "connectivity" ? &piece.connectivity
              : array.name == "offsets"    ? &piece.offsets
              : array.name == "types"      ? &piece.types
                                           : nullptr;
    }
    if (!place) return nullptr;
    if (*place) return replace(**place, array);
    *place = std::move(array);
    return &**place;
  }

  VtuArray* keepAmong(std::vector<VtuArray>& list, VtuArray& array) {
    for (VtuArray& old : list) {
      if (old.name != array.name) continue;
      if (old.is_doubtful == array.is_doubtful)
        file_.addNote("array \"" + array.name + "\" is there twice: the second one is left out");
      return replace(old, array);
    }
    list.push_back(std::move(array));
    return &list.back();
  }

  // Inline values end at the first tag after them.
  void closeText() {
    if (open_) open_->end = tagBegin();
    open_ = nullptr;
  }

  // The appended data begin after a '_' that follows blanks.
  void placeAppended() {
    char text[4096];
    const size_t got = bytes().readAt(appended_begin_, text, sizeof text);
    size_t at = 0;
    while (at < got && std::strchr(" \t\r\n", text[at]) && text[at] != '\0') ++at;
    if (at == got || text[at] != '_')
      failAt(appended_begin_ + at, "the appended data do not begin with '_'");
    appended_begin_ += at + 1;
  }

  void finishPiece(VtuPiece& piece) const {
    for (VtuArray& array : piece.point_data) finishArray(array);
    for (VtuArray& array : piece.cell_data) finishArray(array);
    for (std::optional<VtuArray>* array : meshOf(piece))
      if (*array) finishArray(**array);
  }

  static std::array<std::optional<VtuArray>*, 4> meshOf(VtuPiece& piece) {
    return {&piece.points, &piece.connectivity, &piece.offsets, &piece.types};
  }

  void finishArray(VtuArray& array) const {
    if (array.format == VtuFormat::kAscii) return;
    if (!compressor_.empty() && !file_.compressor)
      fail(Status::kUnsupported, "%s: the values are compressed with %s; this build reads %s",
           bytes().name().c_str(), compressor_.c_str(), vtuCompressorNames().c_str());
    if (array.format == VtuFormat::kInlineBase64) return;
    const char* name = array.name.c_str();
    if (!stopped())
      fail(Status::kBadData, "%s: array \"%s\" is appended, but there is no AppendedData",
           bytes().name().c_str(), name);
    array.format = raw_ ? VtuFormat::kAppendedRaw : VtuFormat::kAppendedBase64;
    array.end = bytes().size();
    if (array.begin > array.end - appended_begin_)
      fail(Status::kBadData, "%s: array \"%s\" begins past the end of the file",
           bytes().name().c_str(), name);
    array.begin += appended_begin_;
  }

  const ChooseVtuStep& choose_;
  VtuFile file_;
  std::vector<double> times_;                                  // of steps; empty: there are none
  uint64_t step_ = 0;                                          // that is read
  bool some_claim_first_ = false, some_claim_others_ = false;  // arrays that are not appended
  bool is_doubtful_ = false;                                   // the array that is entered
  std::string compressor_;
  int depth_ = 0, skip_from_ = 0;
  bool skipping_ = false, raw_ = false, in_field_data_ = false;
  Section section_ = Section::kOther;
  VtuArray* open_ = nullptr;  // whose inline values are being passed
  uint64_t appended_begin_ = 0;
  size_t array_count_ = 0;
};

}  // namespace

VtuFile parseVtuHeader(ByteSource& bytes, const ChooseVtuStep& choose) {
  return HeaderParser(bytes, choose).run();
}

}  // namespace tetstream
