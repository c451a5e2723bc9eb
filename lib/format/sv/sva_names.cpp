// format/sv: the names and types of .sva columns: the defaults, and the words that our writer adds.
#include <utility>

#include "status.h"
#include "sva_header.h"
#include "text_number.h"

namespace tetstream {

static constexpr const char* kKeywords[] = {
    "svtype",   "v_pnum_f", "v_pmin_f", "v_pmax_f", "v_pnum_i", "v_pmin_i",
    "v_pmax_i", "c_pnum_f", "c_pmin_f", "c_pmax_f", "c_pnum_i", "c_pmin_i",
    "c_pmax_i", "bb_min",   "bb_max",   "nverts",   "ncells"};

static constexpr struct {
  ScalarType type;
  const char* word;
} kTypes[] = {{ScalarType::kFloat32, "float32"},
              {ScalarType::kFloat64, "float64"},
              {ScalarType::kInt32, "int32"},
              {ScalarType::kInt64, "int64"}};

// ------------------------------------------------------------------------------- defaults

static void addDefaults(std::vector<Column>& columns, int count, const char* name, bool bare_if_one,
                        ScalarType type) {
  for (int i = 0; i < count; ++i)
    columns.push_back({bare_if_one && count == 1 ? name : textOf("%s%d", name, i), 1, type});
}

Schema defaultSvaSchema(const SvaHeader& header, ScalarType float_type) {
  Schema schema;
  schema.position_type = float_type;
  addDefaults(schema.fields, header.vertex_floats - 3, "scalar", true, float_type);
  addDefaults(schema.fields, header.vertex_ints, "label", false, ScalarType::kInt32);
  addDefaults(schema.cell_data, header.cell_floats, "cell", false, float_type);
  addDefaults(schema.cell_data, header.cell_ints, "region", true, ScalarType::kInt32);
  return schema;
}

// ---------------------------------------------------------------------------------- words

static void appendEscaped(char c, std::string& out) {
  out += textOf("%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
}

static std::string escaped(const std::string& name) {
  std::string out;
  for (char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (byte <= 32 || byte == 127 || c == '%')
      appendEscaped(c, out);
    else
      out += c;
  }
  for (const char* keyword : kKeywords)
    for (size_t at; (at = out.find(keyword)) != std::string::npos;) {
      std::string first;
      appendEscaped(out[at], first);
      out.replace(at, 1, first);
    }
  return out;
}

static bool unescape(std::string_view text, std::string* name) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      *name += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return false;
    const int high = digit(text[i + 1]), low = digit(text[i + 2]);
    if (high < 0 || low < 0) return false;
    *name += static_cast<char>(16 * high + low);
    i += 2;
  }
  return true;
}

static const char* typeWord(ScalarType type) {
  for (const auto& t : kTypes)
    if (t.type == type) return t.word;
  return "";
}

// A word of any length as lines short enough for every reader.
static std::string wordLines(std::string_view word) {
  constexpr size_t longest = 200;
  std::string lines;
  for (const char* start = "# tetstream:"; !word.empty(); start = "# tetstream:more:") {
    lines += start + std::string(word.substr(0, longest)) + '\n';
    word.remove_prefix(word.size() < longest ? word.size() : longest);
  }
  return lines;
}

static bool same(const std::vector<Column>& a, const std::vector<Column>& b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (a[i].name != b[i].name || a[i].components != b[i].components || a[i].type != b[i].type)
      return false;
  return true;
}

std::string svaWordLines(const Schema& schema, const SvaHeader& header) {
  const Schema defaults = defaultSvaSchema(header, ScalarType::kFloat32);
  if (schema.position_type == defaults.position_type && same(schema.fields, defaults.fields) &&
      same(schema.cell_data, defaults.cell_data))
    return {};
  std::string lines = wordLines(std::string("position:") + typeWord(schema.position_type));
  const auto add = [&](const char* kind, const std::vector<Column>& columns) {
    for (const Column& c : columns)
      lines +=
          wordLines(textOf("%s:%s:%d:", kind, typeWord(c.type), c.components) + escaped(c.name));
  };
  add("vertex", schema.fields);
  add("cell", schema.cell_data);
  return lines;
}

static std::string_view takePart(std::string_view& word) {
  const size_t colon = word.find(':');
  const std::string_view part = word.substr(0, colon);
  word.remove_prefix(colon == std::string_view::npos ? word.size() : colon + 1);
  return part;
}

static bool takeWordOf(std::string_view word, Schema* schema) {
  const std::string_view kind = takePart(word), type = takePart(word);
  Column column;
  column.type = ScalarType{0};
  for (const auto& t : kTypes)
    if (type == t.word) column.type = t.type;
  if (!isKnown(column.type)) return false;
  if (kind == "position") {
    schema->position_type = column.type;
    return true;
  }
  int64_t components = 0;
  if (!parseInteger(takePart(word), &components) || components < 1 || components > kMaxComponents)
    return false;
  column.components = static_cast<int>(components);
  if (!unescape(word, &column.name)) return false;
  if (kind != "vertex" && kind != "cell") return false;
  (kind == "vertex" ? schema->fields : schema->cell_data).push_back(column);
  return true;
}

static int64_t componentsOf(const std::vector<Column>& columns, bool floats) {
  int64_t sum = 0;
  for (const Column& c : columns)
    if (isFloat(c.type) == floats) sum += c.components;
  return sum;
}

bool schemaFromSvaWords(const SvaHeader& header, Schema* schema, std::string* why) {
  if (header.words.empty()) return false;
  Schema found;
  for (const std::string& word : header.words)
    if (!takeWordOf(word, &found)) {
      *why = "the word " + quoted(word) + " is not understood";
      return false;
    }
  if (componentsOf(found.fields, true) != header.vertex_floats - 3 ||
      componentsOf(found.fields, false) != header.vertex_ints ||
      componentsOf(found.cell_data, true) != header.cell_floats ||
      componentsOf(found.cell_data, false) != header.cell_ints) {
    *why = "they are for other numbers of properties than the header's";
    return false;
  }
  try {
    checkSchema(found);
  } catch (const Error& error) {
    *why = error.text();
    return false;
  }
  *schema = std::move(found);
  return true;
}

}  // namespace tetstream
