// A solver's calls: options, a stream of random events pushed or pulled in batches, callbacks that
// fail. The bytes are read as choices, so that most streams keep the rules for a while and some
// break them. Whatever comes, each call gives a status; a run that succeeds has kept its promises.
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "choices.h"
#include "random_stream.h"
#include "target.h"

namespace {

using fuzz::Choices;

// Any option, most often with a value that it can have.
void setOption(Choices& choices, tetstream_options* options) {
  tetstream_option_info info = {};
  info.struct_size = sizeof info;
  const auto row = static_cast<int32_t>(choices.below(tetstream_option_count()));
  tetstream_option_at(row, &info);
  if (info.id == TETSTREAM_OPTION_TMPDIR) return;
  std::string value;
  if (info.choices && choices.below(8)) {
    const std::string all = info.choices;
    const size_t begin = all.rfind(' ', choices.below(all.size()));
    const size_t from = begin == std::string::npos ? 0 : begin + 1;
    value = all.substr(from, all.find(' ', from) - from);
  } else if (info.type != TETSTREAM_OPTION_IS_TEXT && choices.below(4)) {
    value = std::to_string(choices.below(200));
    if (info.type == TETSTREAM_OPTION_IS_DOUBLE) value = "0." + value;
  } else {
    value = choices.word();
  }
  const tetstream_status status = tetstream_options_parse(options, info.name, value.c_str());
  fuzz::checkFailure(status, tetstream_options_message(options));
}

tetstream_options* makeOptions(Choices& choices) {
  tetstream_options* options = nullptr;
  tetstream_options_create(&options);
  for (size_t left = choices.below(5); left > 0; --left) setOption(choices, options);
  if (choices.below(4) == 0) tetstream_options_add_field(options, "a", choices.below(3));
  return options;
}

// A writer of the caller's, whose n-th call may fail.
struct Taker {
  fuzz::EventChecker checker;
  tetstream_writer_callbacks checking = checker.callbacks();
  size_t calls = 0, fail_at;
  int finishes = 0, closes = 0;

  explicit Taker(size_t fail) : fail_at(fail) {}
  bool fails() { return ++calls == fail_at; }
  static int32_t open(void* user, const tetstream_stream_info* info) {
    auto& self = *static_cast<Taker*>(user);
    return self.fails() ? 7 : self.checking.open(self.checking.user, info);
  }
  static int32_t put(void* user, const tetstream_batch* batch) {
    auto& self = *static_cast<Taker*>(user);
    return self.fails() ? 7 : self.checking.put(self.checking.user, batch);
  }
  static int32_t finish(void* user) {
    auto& self = *static_cast<Taker*>(user);
    ++self.finishes;
    return self.fails() ? 7 : 0;
  }
  static void close(void* user) { ++static_cast<Taker*>(user)->closes; }
  tetstream_writer_callbacks callbacks() {
    return {sizeof(tetstream_writer_callbacks), this, open, put, finish, close};
  }
};

// The reader's side of a random stream.
int32_t openStream(void* user, tetstream_stream_info* info) {
  const size_t known = info->struct_size;
  *info = static_cast<fuzz::RandomStream*>(user)->info();
  info->struct_size = known;
  return 0;
}
int32_t nextOfStream(void* user, tetstream_batch* batch) {
  static_cast<fuzz::RandomStream*>(user)->next(batch);
  return 0;
}

tetstream_status pull(fuzz::RandomStream& stream, tetstream_simplifier* simplifier) {
  const tetstream_reader_callbacks callbacks = {sizeof callbacks, &stream, openStream, nextOfStream,
                                                nullptr};
  tetstream_reader* reader = nullptr;
  tetstream_status status = tetstream_reader_create(&callbacks, &reader);
  if (status >= 0) status = tetstream_simplifier_run(simplifier, reader);
  tetstream_reader_destroy(reader);
  return status;
}

tetstream_status push(fuzz::RandomStream& stream, tetstream_simplifier* simplifier) {
  const tetstream_stream_info info = stream.info();
  tetstream_status status = tetstream_simplifier_begin(simplifier, &info);
  while (status >= 0) {
    tetstream_batch batch = {};
    batch.struct_size = sizeof batch;
    stream.next(&batch);
    if (batch.vertex_count == 0 && batch.cell_count == 0 && batch.finalized_count == 0) break;
    status = tetstream_simplifier_push(simplifier, &batch);
  }
  if (status >= 0) status = tetstream_simplifier_finish(simplifier);
  return status;
}

void checkReport(const tetstream_simplifier* simplifier, tetstream_status status,
                 const Taker& taker, const fuzz::RandomStream& stream) {
  tetstream_report report = {};
  report.struct_size = sizeof report;
  fuzz::checkFailure(tetstream_simplifier_get_report(simplifier, &report), "no report");
  if (status < 0) return;
  PROMISE(taker.finishes == 1, "finished %d times", taker.finishes);
  PROMISE(report.cells_in == stream.cellsGiven(), "%lld cells in of %lld",
          static_cast<long long>(report.cells_in), static_cast<long long>(stream.cellsGiven()));
  PROMISE(report.cells_out == taker.checker.cells(), "the report has %lld cells, the output %lld",
          static_cast<long long>(report.cells_out), static_cast<long long>(taker.checker.cells()));
  PROMISE(report.cells_out <= report.cells_in, "more cells out than in");
  const bool is_met = report.target_cells == 0 || report.cells_out <= report.target_cells ||
                      std::strcmp(report.reached, "error") == 0;
  PROMISE(status != TETSTREAM_OK || is_met, "OK with %lld cells for %lld",
          static_cast<long long>(report.cells_out), static_cast<long long>(report.target_cells));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Choices choices(data, size);
  tetstream_options* options = makeOptions(choices);
  Taker taker(choices.below(4) == 0 ? choices.below(12) : 0);
  const bool pulls = choices.below(2);
  const tetstream_writer_callbacks callbacks = taker.callbacks();
  tetstream_writer* writer = nullptr;
  tetstream_simplifier* simplifier = nullptr;
  tetstream_writer_create(&callbacks, &writer);
  tetstream_status status = tetstream_simplifier_create(options, writer, &simplifier);
  fuzz::RandomStream stream(choices);
  if (status >= 0) {
    status = pulls ? pull(stream, simplifier) : push(stream, simplifier);
    fuzz::checkFailure(status, tetstream_simplifier_message(simplifier));
    checkReport(simplifier, status, taker, stream);
  } else {
    fuzz::checkFailure(status, tetstream_simplifier_message(simplifier));
  }
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  PROMISE(taker.closes <= 1, "closed %d times", taker.closes);
  tetstream_options_destroy(options);
  return 0;
}
