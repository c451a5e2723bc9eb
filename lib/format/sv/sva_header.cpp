#include "sva_header.h"

#include <cmath>
#include <utility>

#include "status.h"
#include "text_number.h"

namespace tetstream {

// Numbers of one kind per line: bounds the schema that a short header can ask for. No line of
// 64 KiB holds many more.
static constexpr int64_t kMaxNumbers = 4096;

// -------------------------------------------------------------------------------- reading

static int64_t takeCount(std::string_view rest, std::string_view word, int64_t least, int64_t most,
                         const std::string& where) {
  int64_t value = 0;
  const std::string_view number = takeWord(rest);
  if (!parseInteger(number, &value) || value < least || value > most)
    fail(Status::kBadData, "%s: %s is not a count for %.*s", where.c_str(), quoted(number).c_str(),
         static_cast<int>(word.size()), word.data());
  return value;
}

// The numbers of a box. Those of a line that does not fit the columns are left out later.
static void takeBox(std::string_view rest, std::vector<double>& box, bool* long_numbers) {
  box.clear();
  for (;;) {
    const std::string_view word = takeWord(rest);
    double value = 0;
    if (!parseNumber(word, ScalarType::kFloat64, &value)) return;
    box.push_back(value);
    if (long_numbers && needsFloat64(word)) *long_numbers = true;
  }
}

static void takeType(std::string_view rest, const std::string& where) {
  const std::string_view type = takeWord(rest);
  if (type != "tet")
    fail(Status::kUnsupported, "%s: cells of type %s, only \"tet\" can be read", where.c_str(),
         quoted(type).c_str());
}

static void takeOurWord(std::string_view word, const std::string& where, SvaHeader& header) {
  constexpr std::string_view more = "more:";
  if (word.starts_with(more) && !header.words.empty())
    header.words.back() += word.substr(more.size());
  else
    header.words.emplace_back(word);
  // A name is 255 bytes, escaped three times that.
  if (header.words.back().size() > 1000 || header.words.size() > 4 * kMaxNumbers)
    fail(Status::kBadData, "%s: the names of the columns are too long", where.c_str());
}

static constexpr struct {
  const char* word;
  int64_t SvaHeader::*value;
} kCounts[] = {{"nverts", &SvaHeader::vertex_count}, {"ncells", &SvaHeader::cell_count}};

static constexpr struct {
  const char* word;
  int SvaHeader::*value;
} kNumbers[] = {{"v_pnum_f", &SvaHeader::vertex_floats},
                {"v_pnum_i", &SvaHeader::vertex_ints},
                {"c_pnum_f", &SvaHeader::cell_floats},
                {"c_pnum_i", &SvaHeader::cell_ints}};

static constexpr struct {
  const char* word;
  std::vector<double> SvaHeader::*box;
  bool floats;
} kBoxes[] = {{"v_pmin_f", &SvaHeader::float_min, true}, {"v_pmax_f", &SvaHeader::float_max, true},
              {"v_pmin_i", &SvaHeader::int_min, false},  {"v_pmax_i", &SvaHeader::int_max, false},
              {"bb_min", &SvaHeader::bb_min, true},      {"bb_max", &SvaHeader::bb_max, true}};

// What is no keyword is a comment. The boxes of cell data are not used.
static void takeKeyword(std::string_view word, std::string_view rest, const std::string& where,
                        SvaHeader& header) {
  if (word == "svtype") {
    takeType(rest, where);
    return;
  }
  for (const auto& row : kCounts)
    if (word == row.word) {
      header.*row.value = takeCount(rest, word, -1, INT64_MAX, where);
      return;
    }
  for (const auto& row : kNumbers)
    if (word == row.word) {
      header.*row.value = static_cast<int>(takeCount(rest, word, 0, kMaxNumbers, where));
      return;
    }
  for (const auto& row : kBoxes)
    if (word == row.word) {
      takeBox(rest, header.*row.box, row.floats ? &header.long_numbers : nullptr);
      return;
    }
}

void readSvaHeaderLine(std::string_view line, const std::string& where, SvaHeader& header) {
  std::string_view rest = line.substr(1);
  const std::string_view word = takeWord(rest);
  constexpr std::string_view ours = "tetstream:";
  if (word.starts_with(ours))
    takeOurWord(word.substr(ours.size()), where, header);
  else
    takeKeyword(word, rest, where, header);
}

bool needsFloat64(std::string_view number) {
  int digits = 0, zeros = 0;  // significant ones, and those of them at the end that are 0
  for (char c : number) {
    if (c == 'e' || c == 'E') break;
    if (c < '0' || c > '9' || (c == '0' && digits == 0)) continue;
    ++digits;
    zeros = c == '0' ? zeros + 1 : 0;
  }
  return digits - zeros > 9;
}

std::vector<size_t> svaColumnOrder(const std::vector<Column>& columns) {
  std::vector<size_t> order;
  for (bool floats : {true, false})
    for (size_t i = 0; i < columns.size(); ++i)
      if (isFloat(columns[i].type) == floats) order.push_back(i);
  return order;
}

// Box values in the order of the file's lines -> in the order of the schema's fields.
static std::vector<double> boxFromFile(const std::vector<double>& floats,
                                       const std::vector<double>& ints, const Schema& schema) {
  std::vector<double> file = floats;
  file.insert(file.end(), ints.begin(), ints.end());
  if (file.size() != schema.boxSize()) return {};
  std::vector<size_t> starts;  // of each field in `box`
  size_t start = 3;
  for (const Column& c : schema.fields) {
    starts.push_back(start);
    start += static_cast<size_t>(c.components);
  }
  std::vector<double> box(file.begin(), file.begin() + 3);
  box.resize(file.size());
  size_t at = 3;
  for (size_t i : svaColumnOrder(schema.fields))
    for (int k = 0; k < schema.fields[i].components; ++k)
      box[starts[i] + static_cast<size_t>(k)] = file[at++];
  return box;
}

void addSvaKnowledge(const SvaHeader& header, Schema* schema) {
  schema->vertex_count = header.vertex_count;
  schema->cell_count = header.cell_count;
  const bool old = header.float_min.empty() && header.float_max.empty();
  const size_t floats = static_cast<size_t>(header.vertex_floats);
  const size_t ints = static_cast<size_t>(header.vertex_ints);
  const std::vector<double>& min_f = old ? header.bb_min : header.float_min;
  const std::vector<double>& max_f = old ? header.bb_max : header.float_max;
  if (min_f.size() != floats || max_f.size() != floats) return;
  if (header.int_min.size() != ints || header.int_max.size() != ints) return;
  std::vector<double> low = boxFromFile(min_f, header.int_min, *schema);
  std::vector<double> high = boxFromFile(max_f, header.int_max, *schema);
  for (size_t i = 0; i < low.size(); ++i)
    if (!(low[i] <= high[i])) return;  // not a box: as good as none
  schema->box_min = std::move(low);
  schema->box_max = std::move(high);
}

// ------------------------------------------------------------------------------- printing

// Rounded outwards where the column is float32, so that the box stays one.
static void printBound(double value, ScalarType type, bool lower, std::string& out) {
  if (!isFloat(type)) return printInteger(static_cast<int64_t>(value), out);
  if (type == ScalarType::kFloat64) return printNumber(&value, type, out);
  float narrow = static_cast<float>(value);
  if (lower ? narrow > value : narrow < value)
    narrow = __builtin_nextafterf(narrow, lower ? -__builtin_huge_valf() : __builtin_huge_valf());
  printNumber(&narrow, type, out);
}

static std::string boxLine(const char* keyword, const Schema& schema, bool floats, bool lower) {
  const std::vector<double>& box = lower ? schema.box_min : schema.box_max;
  std::string line = std::string("# ") + keyword;
  const auto add = [&](size_t i, ScalarType type) {
    line += ' ';
    printBound(box[i], type, lower, line);
  };
  size_t at = 0;
  for (; at < 3; ++at)
    if (floats) add(at, schema.position_type);
  for (const Column& c : schema.fields)
    for (int k = 0; k < c.components; ++k, ++at)
      if (isFloat(c.type) == floats) add(at, c.type);
  return line + '\n';
}

static bool fitsBoxLines(const Schema& schema) {
  if (!schema.hasBox()) return false;
  for (size_t i = 0; i < schema.boxSize(); ++i)
    if (!std::isfinite(schema.box_min[i]) || !std::isfinite(schema.box_max[i])) return false;
  size_t at = 3;
  for (const Column& c : schema.fields)
    for (int k = 0; k < c.components; ++k, ++at)
      if (!isFloat(c.type) && !(schema.box_min[at] > -9.2e18 && schema.box_max[at] < 9.2e18))
        return false;
  for (bool lower : {true, false})
    if (boxLine("v_pmin_f", schema, true, lower).size() > 255 ||
        boxLine("v_pmin_i", schema, false, lower).size() > 255)
      return false;
  return true;
}

static int numbersOf(const std::vector<Column>& columns, bool floats) {
  int sum = 0;
  for (const Column& c : columns)
    if (isFloat(c.type) == floats) sum += c.components;
  return sum;
}

static std::string numberLine(const char* keyword, int64_t value) {
  return textOf("# %s %lld\n", keyword, static_cast<long long>(value));
}

std::string printSvaCounts(int64_t vertex_count, int64_t cell_count) {
  return textOf("# nverts %-19lld\n# ncells %-19lld\n", static_cast<long long>(vertex_count),
                static_cast<long long>(cell_count));
}

static std::string emptyRoom() {
  std::string room = printSvaCounts(0, 0);
  for (char& c : room)
    if (c != '#' && c != '\n') c = ' ';
  return room;
}

std::string printSvaHeader(const Schema& schema, bool reserve, int64_t* counts_at) {
  SvaHeader header;
  header.vertex_floats = 3 + numbersOf(schema.fields, true);
  header.vertex_ints = numbersOf(schema.fields, false);
  header.cell_floats = numbersOf(schema.cell_data, true);
  header.cell_ints = numbersOf(schema.cell_data, false);

  std::string text = "# svtype tet\n" + svaWordLines(schema, header);
  *counts_at = -1;
  if (reserve && (schema.vertex_count < 0 || schema.cell_count < 0)) {
    *counts_at = static_cast<int64_t>(text.size());
    text += emptyRoom();
  } else {
    if (schema.vertex_count >= 0) text += numberLine("nverts", schema.vertex_count);
    if (schema.cell_count >= 0) text += numberLine("ncells", schema.cell_count);
  }
  const bool box = fitsBoxLines(schema);
  text += numberLine("v_pnum_f", header.vertex_floats);
  if (box)
    text += boxLine("v_pmin_f", schema, true, true) + boxLine("v_pmax_f", schema, true, false);
  if (header.vertex_ints > 0) {
    text += numberLine("v_pnum_i", header.vertex_ints);
    if (box)
      text += boxLine("v_pmin_i", schema, false, true) + boxLine("v_pmax_i", schema, false, false);
  }
  if (header.cell_floats > 0) text += numberLine("c_pnum_f", header.cell_floats);
  if (header.cell_ints > 0) text += numberLine("c_pnum_i", header.cell_ints);
  return text;
}

}  // namespace tetstream
