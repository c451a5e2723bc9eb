// switched IN OUT --ratio R --field NAME --window N --mode NAME --seed N --shape-weight W
// --uniform-ratio --no-renewal --no-retries --no-last-resort: simplifies a stream as the command
// does, without a pilot, with what no option of the command reaches: another weight of the shape
// regulariser, the same ratio all along the stream in mode sweep, too, quadrics that are only added
// to, edges of a queue tried once only, and nothing tried once no edge is legal. Prints the report
// as JSON.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "registry.h"
#include "simplifier.h"
#include "status.h"
#include "tets_format.h"

namespace tetstream {
namespace {

Mode modeOf(const std::string& name) {
  if (name == "sweep") return Mode::kSweep;
  if (name == "paper") return Mode::kPaper;
  if (name == "queue") return Mode::kQueue;
  fail(Status::kBadArgument, "there is no mode %s", name.c_str());
}

// Returns how many words it took.
int take(char** words, int left, SimplifyOptions& options) {
  const std::string name = words[0];
  if (name == "--uniform-ratio") return options.uniform_ratio = true, 1;
  if (name == "--no-renewal") return options.renews = false, 1;
  if (name == "--no-retries") return options.tries_again = false, 1;
  if (name == "--no-last-resort") return options.last_resort = false, 1;
  if (left < 2) fail(Status::kBadArgument, "%s needs a value", words[0]);
  const char* value = words[1];
  if (name == "--ratio")
    options.ratio = std::atof(value);
  else if (name == "--field")
    options.fields.emplace_back(value, 1);
  else if (name == "--window")
    options.window_cells = std::atoll(value);
  else if (name == "--mode")
    options.mode = modeOf(value);
  else if (name == "--seed")
    options.seed = std::atoll(value);
  else if (name == "--shape-weight")
    options.shape_weight = std::atof(value);
  else
    fail(Status::kBadArgument, "there is no switch %s", words[0]);
  return 2;
}

void print(const char* name, int64_t number) {
  std::printf("\"%s\": %lld, ", name, static_cast<long long>(number));
}

void printReport(const Report& r) {
  std::printf("{");
  print("cells_in", r.cells_in);
  print("cells_out", r.cells_out);
  print("target_cells", r.target_cells);
  print("window_cells", r.window_cells);
  print("collapses", r.collapses);
  print("rejected_orientation", r.rejected_orientation);
  print("rejected_link", r.rejected_link);
  print("rejected_other", r.rejected_other);
  std::printf("\"estimated_error\": %.9g}\n", r.estimated_error);
}

void run(char** words, int count) {
  SimplifyOptions options;
  for (int i = 2; i < count;) i += take(words + i, count - i, options);
  Input input = needFormat("", words[0]).open(openFile(words[0]), {});
  if (!input.stream) fail(Status::kUnsupported, "%s is no stream", words[0]);
  const auto sink = createTets(createFile(words[1]), WriteOptions());
  Simplifier simplifier(options, *sink, {});
  copyStream(*input.stream, simplifier);
  printReport(simplifier.report());
}

}  // namespace
}  // namespace tetstream

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: switched IN OUT [SWITCH...]\n", stderr);
    return 1;
  }
  try {
    tetstream::run(argv + 1, argc - 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "switched: %s\n", error.what());
    return 1;
  }
  return 0;
}
