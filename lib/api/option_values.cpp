#include "option_values.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "status.h"
#include "tetstream/tetstream.h"

namespace tetstream {

static constexpr int64_t kLeast = std::numeric_limits<int64_t>::min();
static constexpr int64_t kMost = std::numeric_limits<int64_t>::max();

// The names that options.def has for them.
static constexpr int32_t kRead = TETSTREAM_SCOPE_READ, kOrder = TETSTREAM_SCOPE_ORDER,
                         kSimplify = TETSTREAM_SCOPE_SIMPLIFY, kCompare = TETSTREAM_SCOPE_COMPARE,
                         kAny = kRead | kOrder | kSimplify | kCompare;

static const OptionRow kRows[] = {
#define OPTION_DOUBLE(ID, name, scope, minimum, maximum, standard, member, text) \
  {TETSTREAM_OPTION_##ID,                                                        \
   TETSTREAM_OPTION_IS_DOUBLE,                                                   \
   name,                                                                         \
   text,                                                                         \
   minimum,                                                                      \
   maximum,                                                                      \
   0,                                                                            \
   0,                                                                            \
   #standard,                                                                    \
   nullptr,                                                                      \
   scope},
#define OPTION_INT64(ID, name, scope, minimum, maximum, standard, member, text) \
  {TETSTREAM_OPTION_##ID,                                                       \
   TETSTREAM_OPTION_IS_INT64,                                                   \
   name,                                                                        \
   text,                                                                        \
   double(minimum),                                                             \
   double(maximum),                                                             \
   minimum,                                                                     \
   maximum,                                                                     \
   #standard,                                                                   \
   nullptr,                                                                     \
   scope},
#define OPTION_TEXT(ID, name, scope, choices, standard, member, text) \
  {TETSTREAM_OPTION_##ID,                                             \
   TETSTREAM_OPTION_IS_TEXT,                                          \
   name,                                                              \
   text,                                                              \
   0,                                                                 \
   0,                                                                 \
   0,                                                                 \
   0,                                                                 \
   standard,                                                          \
   choices,                                                           \
   scope},
#include "options.def"
#undef OPTION_DOUBLE
#undef OPTION_INT64
#undef OPTION_TEXT
};

// The numbers that stand in RunOptions and SimplifyOptions as defaults are those of the table.
// note: GCC checks it for all; Clang with GCC's library takes no std::string as a constant.
#ifndef __clang__
#define OPTION_DOUBLE(ID, name, scope, minimum, maximum, standard, member, text) \
  static_assert(RunOptions{}.member == standard);
#define OPTION_INT64 OPTION_DOUBLE
#define OPTION_TEXT(...)
#include "options.def"
#undef OPTION_DOUBLE
#undef OPTION_INT64
#undef OPTION_TEXT
#endif

// ---------------------------------------------------------------------------------- the table

int32_t optionCount() noexcept {
  return static_cast<int32_t>(std::size(kRows));
}

const OptionRow& optionRow(int32_t index) {
  if (index < 0 || index >= optionCount())
    fail(Status::kBadArgument, "there is no option %d, there are %d", index, optionCount());
  return kRows[index];
}

static int indexOf(int32_t id, int32_t type) {
  for (int i = 0; i < optionCount(); ++i) {
    if (kRows[i].id != id) continue;
    if (kRows[i].type != type)
      fail(Status::kBadArgument, "option \"%s\" has another type", kRows[i].name);
    return i;
  }
  fail(Status::kBadArgument, "there is no option with the number %d", id);
}

// Independent of the locale, unlike printf.
static std::string numberText(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

// -------------------------------------------------------------------------- checks of one value

static int64_t checked(const OptionRow& row, int64_t value) {
  if (value < row.lowest || value > row.highest)
    fail(Status::kBadArgument, "option \"%s\": %lld is outside %lld to %lld", row.name,
         static_cast<long long>(value), static_cast<long long>(row.lowest),
         static_cast<long long>(row.highest));
  return value;
}

static double checked(const OptionRow& row, double value) {
  // note: written so that NaN is outside.
  if (!(value >= row.minimum && value <= row.maximum))
    fail(Status::kBadArgument, "option \"%s\": %s is outside %s to %s%s", row.name,
         numberText(value).c_str(), numberText(row.minimum).c_str(),
         numberText(row.maximum).c_str(),
         row.id == TETSTREAM_OPTION_RATIO ? ", a fraction: 0.1 leaves ten percent" : "");
  return value;
}

// The place of `value` in the blank-separated list, or -1.
static int choiceOf(const char* choices, const std::string& value) {
  int place = 0;
  for (const char* at = choices; *at; ++place) {
    const size_t length = std::strcspn(at, " ");
    if (value.size() == length && value.compare(0, length, at, length) == 0) return place;
    at += length + (at[length] == ' ');
  }
  return -1;
}

static std::string checked(const OptionRow& row, std::string value) {
  if (row.choices && choiceOf(row.choices, value) < 0)
    fail(Status::kBadArgument, "option \"%s\": \"%s\" is none of: %s", row.name, value.c_str(),
         row.choices);
  return value;
}

// ------------------------------------------------------------------------------ numbers in text

[[noreturn]] static void failText(const OptionRow& row, const std::string& text, const char* why) {
  fail(Status::kBadArgument, "option \"%s\": \"%s\" %s", row.name, text.c_str(), why);
}

static bool isBytes(const OptionRow& row) {
  return row.id == TETSTREAM_OPTION_MEMORY;
}

// The factor of a suffix at the end of `text`, which is taken off: k, M or G, of bytes also K, and
// with B or iB behind it.
static int64_t takeSuffix(const OptionRow& row, std::string& text) {
  static const char kSuffixes[] = "kMG";
  std::string before = text;
  if (isBytes(row))
    for (const char* unit : {"B", "i"})
      if (before.ends_with(unit)) before.pop_back();
  if (isBytes(row) && before.ends_with('K')) before.back() = 'k';
  const char* found = before.empty() ? nullptr : std::strchr(kSuffixes, before.back());
  if (!found) return 1;
  const int64_t step = isBytes(row) ? 1024 : 1000;
  text.assign(before, 0, before.size() - 1);
  int64_t factor = step;
  for (; found != kSuffixes; --found) factor *= step;
  return factor;
}

static int64_t parseInteger(const OptionRow& row, const std::string& whole) {
  const char* const kNoInteger = isBytes(row) ? "is no number of bytes, such as 64M or 1.5G"
                                              : "is no integer, which k, M or G may follow";
  std::string text = whole;
  const int64_t factor = takeSuffix(row, text);
  const char* end = text.data() + text.size();
  int64_t value = 0;
  const auto exact = std::from_chars(text.data(), end, value);
  if (exact.ec == std::errc() && exact.ptr == end) {
    if (__builtin_mul_overflow(value, factor, &value)) failText(row, whole, "is too large");
    return value;
  }
  double real = 0;
  const auto rounded = std::from_chars(text.data(), end, real);
  if (rounded.ec != std::errc() || rounded.ptr != end) failText(row, whole, kNoInteger);
  real *= static_cast<double>(factor);
  if (real != std::floor(real)) failText(row, whole, kNoInteger);
  if (!(std::fabs(real) < 0x1p63)) failText(row, whole, "is too large");
  return static_cast<int64_t>(real);
}

static double parseReal(const OptionRow& row, const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) failText(row, text, "is no number");
  return value;
}

// -------------------------------------------------------------------------------- all the values

OptionValues::OptionValues() {
  static_assert(kCount == std::size(kRows));
  for (const OptionRow& row : kRows) reset(row);
}

void OptionValues::reset(const OptionRow& row) {
  parse(row.name, row.default_text);
}

void OptionValues::setInt64(int32_t id, int64_t value) {
  const int index = indexOf(id, TETSTREAM_OPTION_IS_INT64);
  values_[index] = checked(kRows[index], value);
}

void OptionValues::setDouble(int32_t id, double value) {
  const int index = indexOf(id, TETSTREAM_OPTION_IS_DOUBLE);
  values_[index] = checked(kRows[index], value);
}

void OptionValues::setText(int32_t id, const char* value) {
  const int index = indexOf(id, TETSTREAM_OPTION_IS_TEXT);
  values_[index] = checked(kRows[index], std::string(value));
}

void OptionValues::parse(const char* name, const char* value) {
  for (const OptionRow& row : kRows) {
    if (std::strcmp(row.name, name) != 0) continue;
    if (row.type == TETSTREAM_OPTION_IS_INT64) return setInt64(row.id, parseInteger(row, value));
    if (row.type == TETSTREAM_OPTION_IS_DOUBLE) return setDouble(row.id, parseReal(row, value));
    return setText(row.id, value);
  }
  fail(Status::kBadArgument, "there is no option \"%s\"", name);
}

int64_t OptionValues::getInt64(int32_t id) const {
  return std::get<int64_t>(values_[indexOf(id, TETSTREAM_OPTION_IS_INT64)]);
}

double OptionValues::getDouble(int32_t id) const {
  return std::get<double>(values_[indexOf(id, TETSTREAM_OPTION_IS_DOUBLE)]);
}

const char* OptionValues::getText(int32_t id) const {
  return std::get<std::string>(values_[indexOf(id, TETSTREAM_OPTION_IS_TEXT)]).c_str();
}

void OptionValues::addField(const char* name, double weight) {
  const size_t length = std::strlen(name);
  if (length < 1 || length > 255)
    fail(Status::kBadArgument, "a field's name has 1 to 255 bytes, this one %zu", length);
  if (!(weight >= 0 && weight <= std::numeric_limits<double>::max()))
    fail(Status::kBadArgument, "field \"%s\": the weight %s is negative or not finite", name,
         numberText(weight).c_str());
  for (auto& field : fields_)
    if (field.first == name) {
      field.second = weight;
      return;
    }
  fields_.emplace_back(name, weight);
}

// -------------------------------------------------------------------------------- to RunOptions

static void assign(double& out, double value, const OptionRow&) {
  out = value;
}
static void assign(int64_t& out, int64_t value, const OptionRow&) {
  out = value;
}
static void assign(std::string& out, const std::string& value, const OptionRow&) {
  out = value;
}

template <class Enumeration>
static void assign(Enumeration& out, const std::string& value, const OptionRow& row) {
  static_assert(std::is_enum_v<Enumeration>);
  out = static_cast<Enumeration>(choiceOf(row.choices, value));
}

RunOptions OptionValues::runOptions() const {
  RunOptions run;
  run.simplify.fields = fields_;
  run.workers = workers_.get();
  int i = 0;
#define OPTION_DOUBLE(ID, name, scope, minimum, maximum, standard, member, text) \
  assign(run.member, std::get<double>(values_[i]), kRows[i]);                    \
  ++i;
#define OPTION_INT64(ID, name, scope, minimum, maximum, standard, member, text) \
  assign(run.member, std::get<int64_t>(values_[i]), kRows[i]);                  \
  ++i;
#define OPTION_TEXT(ID, name, scope, choices, standard, member, text) \
  assign(run.member, std::get<std::string>(values_[i]), kRows[i]);    \
  ++i;
#include "options.def"
#undef OPTION_DOUBLE
#undef OPTION_INT64
#undef OPTION_TEXT
  return run;
}

}  // namespace tetstream
