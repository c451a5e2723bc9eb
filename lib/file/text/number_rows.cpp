#include "number_rows.h"

#include <algorithm>
#include <cstring>

#include "plain_number.h"
#include "text_number.h"

namespace tetstream {

size_t RowPattern::width() const {
  size_t width = 0;
  for (const NumberRun& run : runs) width += run.count;
  return width;
}

RowParser::RowParser(const RowPattern& pattern, char comment)
    : pattern_(pattern), comment_(comment) {}

// To the next word; false at the end.
bool RowParser::passBlanks(Text& text) const {
  for (;;) {
    while (isBlank(*text.at)) text.lines += *text.at++ == '\n';
    if (text.at == text.end) return false;
    if (*text.at != comment_ || !comment_) return true;
    passLine(text);
  }
}

void RowParser::passLine(Text& text) const {
  const void* found = std::memchr(text.at, '\n', static_cast<size_t>(text.end - text.at));
  text.at = found ? static_cast<const char*>(found) + 1 : text.end;
  text.lines += found ? 1 : 0;
}

// Returns how many there were before something else came.
template <class Number>
size_t RowParser::readNumbers(Text& text, uint64_t* out, size_t count) const {
  for (size_t done = 0; done < count; ++done) {
    while (isBlank(*text.at)) text.lines += *text.at++ == '\n';
    Number value;
    const char* end = readPlain(text.at, &value);
    if (!end || !isBlank(*end)) {
      if (!passBlanks(text)) return done;
      const char* limit = text.at + std::min<ptrdiff_t>(text.end - text.at, kMostWordBytes);
      end = readWord(text.at, limit, &value);
      if (!end || end == text.at + kMostWordBytes) return done;
    }
    std::memcpy(out + done, &value, sizeof value);
    text.at = end;
  }
  return count;
}

size_t RowParser::readRun(const NumberRun& run, Text& text, uint64_t* out, size_t count) const {
  return run.is_real ? readNumbers<double>(text, out, count)
                     : readNumbers<int64_t>(text, out, count);
}

// Of a row its first `most` numbers. Returns how many there are; 0: it is none.
size_t RowParser::readRow(Text& text, uint64_t* out, size_t most) const {
  size_t count = 0;
  for (const NumberRun& run : pattern_.runs) {
    const size_t wanted = std::min(run.count, most - count);
    if (readRun(run, text, out + count, wanted) < wanted) return 0;
    count += wanted;
  }
  if (!pattern_.further || count == most) return count;
  int64_t first;
  std::memcpy(&first, out, sizeof first);
  const size_t further = pattern_.further(first);
  if (further > RowPattern::kMostFurther) return 0;
  const size_t wanted = std::min(further, most - count);
  return readNumbers<int64_t>(text, out + count, wanted) < wanted ? 0 : count + wanted;
}

RowParser::Found RowParser::parse(const char* begin, size_t size, uint64_t* out) const {
  Text text = {begin, begin + size};
  Found found;
  if (pattern_.isOneKind()) {
    found.numbers = readRun(pattern_.runs[0], text, out, roomFor(size));
  } else {
    Text row = text;
    while (const size_t count = readRow(row, out + found.numbers, SIZE_MAX)) {
      if (pattern_.to_line_end) passLine(row);
      found.numbers += count;
      text = row;
    }
  }
  found.is_whole = !passBlanks(text);
  found.lines = text.lines;
  return found;
}

RowParser::Place RowParser::endOf(const char* begin, size_t size, size_t count,
                                  bool with_line_end) const {
  Text text = {begin, begin + size};
  std::vector<uint64_t> room(pattern_.width() + RowPattern::kMostFurther);
  while (count > 0) {
    if (pattern_.isOneKind()) {
      count -= readRun(pattern_.runs[0], text, room.data(), std::min(count, room.size()));
      continue;
    }
    const size_t width = readRow(text, room.data(), count);
    count -= width;
    if (pattern_.to_line_end && (count > 0 || with_line_end)) passLine(text);
  }
  return {static_cast<uint64_t>(text.at - begin), text.lines};
}

}  // namespace tetstream
