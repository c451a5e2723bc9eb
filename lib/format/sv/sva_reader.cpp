// format/sv: reads .sva, the text form of the streaming volume meshes of M. Isenburg.
//
// Float type: what our writer's words say; else float64 if a number of the header's box, or of a
// vertex line within the first 256 KiB of the body, is written with more than 9 significant digits
// (zeros at the end not counted), else float32.
#include <cstring>

#include "status.h"
#include "sv_format.h"
#include "sv_open.h"
#include "sv_spool.h"
#include "sva_header.h"
#include "sva_scan.h"
#include "text_number.h"

namespace tetstream {

namespace {

constexpr size_t kMaxLineBytes = 1 << 16;
constexpr size_t kProbeBytes = 1 << 18;

using Note = std::function<void(const std::string&)>;

class SvaLines {
 public:
  explicit SvaLines(SvBytes& bytes) : bytes_(bytes) {}

  // The next line without its end; false at the end of the file. It lives until the next call.
  bool peek(std::string_view* line) {
    size_t known = 0;  // bytes that hold no newline
    const void* newline = nullptr;
    while (!(newline = std::memchr(bytes_.data() + known, '\n', bytes_.size() - known))) {
      known = bytes_.size();
      checkLength(known);
      if (bytes_.more()) continue;
      if (known == 0) return false;
      break;
    }
    const char* begin = reinterpret_cast<const char*>(bytes_.data());
    size_t length =
        newline ? static_cast<size_t>(static_cast<const char*>(newline) - begin) : known;
    checkLength(length);
    taken_ = newline ? length + 1 : length;
    complete_ = newline != nullptr;
    if (length > 0 && begin[length - 1] == '\r') --length;
    *line = std::string_view(begin, length);
    return true;
  }
  void drop() {  // the line that was peeked at
    bytes_.drop(taken_);
    ++number_;
  }

  uint64_t number() const { return number_; }  // of the line that peek gives, from 1
  bool complete() const { return complete_; }  // whether the last line had a newline
  std::string where(uint64_t line) const {
    return textOf("%s: line %llu", bytes_.name().c_str(), static_cast<unsigned long long>(line));
  }

 private:
  void checkLength(size_t length) const {
    if (length > kMaxLineBytes)
      fail(Status::kBadData, "%s is longer than %zu bytes", where(number_).c_str(), kMaxLineBytes);
  }

  SvBytes& bytes_;
  uint64_t number_ = 1;
  size_t taken_ = 0;
  bool complete_ = true;
};

bool isBodyStart(std::string_view line) {
  return !line.empty() && (line[0] == 'v' || line[0] == 'c' || line[0] == 'x');
}

class SvaElements final : public SvElements {
 public:
  SvaElements(std::unique_ptr<ByteSource> source, const ReadOptions& options)
      : bytes_(std::move(source)), lines_(bytes_), note_(options.note) {
    readHeader();
    chooseSchema();
    for (size_t i : svaColumnOrder(schema_.fields)) field_order_.push_back(i);
    for (size_t i : svaColumnOrder(schema_.cell_data)) cell_order_.push_back(i);
  }

  SvBytes& bytes() { return bytes_; }
  const Schema& schema() const override { return schema_; }
  std::string where(uint64_t place) const override { return lines_.where(place); }
  std::string whereEnd() const override { return bytes_.name() + ": the file's end"; }

  bool read(SvBlock& block) override {
    std::string_view line;
    while (block.kinds.size() < kSvBlockElements && lines_.peek(&line)) {
      const bool element = isBodyStart(line) && line.size() > 1 && line[1] == ' ';
      if (!element) {
        noteSkipped(line);
      } else {
        if (line[0] != 'x' && !block.finalized.empty()) break;
        readElement(line[0], line.substr(2), block);
      }
      lines_.drop();
    }
    if (!lines_.complete() && !noted_end_) {
      noted_end_ = true;
      note(whereEnd() + " is not the end of a line: the file may have been cut");
    }
    return !block.kinds.empty();
  }

 private:
  void note(const std::string& text) const {
    if (note_) note_(text);
  }

  void readHeader() {
    std::string_view line;
    while (lines_.peek(&line) && !isBodyStart(line)) {
      if (!line.empty() && line[0] == '#')
        readSvaHeaderLine(line, lines_.where(lines_.number()), header_);
      else
        noteSkipped(line);
      lines_.drop();
    }
  }

  void chooseSchema() {
    const bool said = header_.vertex_floats >= 0;
    if (!said) header_.vertex_floats = 3;
    if (header_.vertex_floats < 3)
      fail(Status::kBadData, "%s: v_pnum_f is %d, but a position has three numbers",
           bytes_.name().c_str(), header_.vertex_floats);
    if (!said && header_.bb_min.size() != 3 && bytes_.want(1))
      note(bytes_.name() + ": the header has no v_pnum_f; vertices are read as x y z");
    std::string why;
    if (!schemaFromSvaWords(header_, &schema_, &why)) {
      if (!why.empty()) note(bytes_.name() + ": the names of the columns are not used: " + why);
      const bool wide = header_.long_numbers || hasLongNumbers();
      if (wide) note(bytes_.name() + ": numbers have more than 9 digits and are read as float64");
      schema_ = defaultSvaSchema(header_, wide ? ScalarType::kFloat64 : ScalarType::kFloat32);
    }
    addSvaKnowledge(header_, &schema_);
    checkSchema(schema_);
  }

  // Whether a vertex line within the first kProbeBytes of the body needs float64.
  bool hasLongNumbers() {
    bytes_.want(kProbeBytes);
    std::string_view rest(reinterpret_cast<const char*>(bytes_.data()),
                          bytes_.size() < kProbeBytes ? bytes_.size() : kProbeBytes);
    while (!rest.empty()) {
      const size_t end = rest.find('\n');
      std::string_view line = rest.substr(0, end);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      if (!line.starts_with("v ")) continue;
      line.remove_prefix(2);
      for (int i = 0; i < header_.vertex_floats; ++i)
        if (needsFloat64(takeWord(line))) return true;
    }
    return false;
  }

  void noteSkipped(std::string_view line) {
    if (noted_skipped_ || line.empty() || line[0] == '#') return;
    noted_skipped_ = true;
    note(lines_.where(lines_.number()) + ": " + quoted(line) +
         " is no line of the format; it and its like are skipped");
  }

  void noteExtra(std::string_view rest) {
    const std::string_view word = takeWord(rest);
    if (word.empty() || noted_extra_) return;
    noted_extra_ = true;
    note(lines_.where(lines_.number()) + ": what follows the numbers that the header announces, " +
         quoted(word) + ", is left out, here and in later lines");
  }

  void readElement(char tag, std::string_view rest, SvBlock& block) {
    block.places.push_back(lines_.number());
    switch (tag) {
      case 'v':
        readVertex(rest, block);
        break;
      case 'c':
        readCell(rest, block);
        break;
      default:
        block.kinds.push_back(SvKind::kFinalize);
        block.finalized.push_back(takeReference(rest));
    }
    noteExtra(rest);
  }

  void readVertex(std::string_view& rest, SvBlock& block) {
    block.kinds.push_back(SvKind::kVertex);
    const size_t row = block.rows.addVertices(1);
    takeNumbers(rest, schema_.position_type, 3, block.rows.position(row));
    for (size_t i : field_order_)
      takeNumbers(rest, schema_.fields[i].type, schema_.fields[i].components,
                  block.rows.field(i, row));
  }

  void readCell(std::string_view& rest, SvBlock& block) {
    block.kinds.push_back(SvKind::kCell);
    const size_t row = block.rows.addCells(1);
    for (int j = 0; j < 4; ++j) block.rows.cell(row)[j] = takeReference(rest);
    for (size_t i : cell_order_)
      takeNumbers(rest, schema_.cell_data[i].type, schema_.cell_data[i].components,
                  block.rows.cellData(i, row));
  }

  void takeNumbers(std::string_view& rest, ScalarType type, int count, void* out) {
    unsigned char* to = static_cast<unsigned char*>(out);
    for (int i = 0; i < count; ++i, to += sizeOf(type)) {
      const std::string_view word = takeWord(rest);
      if (!parseNumber(word, type, to)) failNumber(word, isFloat(type) ? "a number" : "an integer");
    }
  }

  int64_t takeReference(std::string_view& rest) {
    const std::string_view word = takeWord(rest);
    int64_t reference = 0;
    if (!parseInteger(word, &reference)) failNumber(word, "a reference to a vertex");
    return reference;
  }

  [[noreturn]] void failNumber(std::string_view word, const char* what) const {
    const std::string where = lines_.where(lines_.number());
    if (word.empty()) fail(Status::kBadData, "%s ends where %s should be", where.c_str(), what);
    fail(Status::kBadData, "%s: %s is not %s that fits", where.c_str(), quoted(word).c_str(), what);
  }

  SvBytes bytes_;
  SvaLines lines_;
  Note note_;
  SvaHeader header_;
  Schema schema_;
  std::vector<size_t> field_order_, cell_order_;
  bool noted_skipped_ = false, noted_extra_ = false, noted_end_ = false;
};

}  // namespace

Input openSva(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  auto elements = std::make_unique<SvaElements>(std::move(bytes), options);
  SvaScanner scanner;
  const SvForm form = findSvForm(elements->bytes(), scanner, options.temp_dir);
  Input input;
  if (form == SvForm::kIndexed)
    input.indexed = spoolSvElements(*elements, options.temp_dir);
  else
    input.stream = makeSvStream(form, std::move(elements));
  return input;
}

}  // namespace tetstream
