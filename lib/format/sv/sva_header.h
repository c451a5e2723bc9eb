// format/sv: the header of .sva, text lines "# keyword values" before the first element, and what
// it says about the columns. Depends on schema.h.
//
// The format has no names and no types. Where the defaults below do not tell them, our writer adds
// comments of one word, which other readers skip:
//   # tetstream:position:float64
//   # tetstream:vertex:float32:3:velocity    one per field, in the schema's order
//   # tetstream:cell:int32:1:region          one per cell column
//   # tetstream:more:...                     goes on with the word of the line before
// In a name '%', blanks and control characters are %XX, and so is the first letter of every keyword
// of the format that the name contains: other readers look for keywords anywhere in a line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema.h"

namespace tetstream {

struct SvaHeader {
  int64_t vertex_count = -1, cell_count = -1;
  int vertex_floats = -1, vertex_ints = 0;  // numbers per `v` line; the first three are x y z
  int cell_floats = 0, cell_ints = 0;       // per `c` line, after the references
  std::vector<double> float_min, float_max, int_min, int_max;  // box of a vertex's numbers
  std::vector<double> bb_min, bb_max;  // the older way to write the box of x y z
  std::vector<std::string> words;      // "position:float64" and the like
  bool long_numbers = false;           // the box needs more than float32
};

// Takes a line that begins with '#'. Throws kBadData or kUnsupported with a sentence that begins
// with `where`.
void readSvaHeaderLine(std::string_view line, const std::string& where, SvaHeader& header);

// Columns with the format's default names: one float is "scalar", more are "scalar0"...; integers
// "label0"...; cell integers "region", or "region0"...; cell floats "cell0"... All have one
// component; integers are int32.
Schema defaultSvaSchema(const SvaHeader& header, ScalarType float_type);

// The schema that the header's words describe. False: there are none, or they do not fit the
// header's numbers; *why says so, if it is that.
bool schemaFromSvaWords(const SvaHeader& header, Schema* schema, std::string* why);

// The comment lines that describe the schema, none where the defaults do.
std::string svaWordLines(const Schema& schema, const SvaHeader& header);

// Adds counts and box.
void addSvaKnowledge(const SvaHeader& header, Schema* schema);

// The header of that schema, lines with their newlines. *counts_at is where room for the counts
// begins, if a count is not known and `reserve` asks for room, else -1.
std::string printSvaHeader(const Schema& schema, bool reserve, int64_t* counts_at);
// What replaces that room; of the same length.
std::string printSvaCounts(int64_t vertex_count, int64_t cell_count);

// Whether the number as written has more than the 9 significant digits that float32 can need.
bool needsFloat64(std::string_view number);

// The columns of floats, then those of integers: the order of a line's numbers.
std::vector<size_t> svaColumnOrder(const std::vector<Column>& columns);

}  // namespace tetstream
