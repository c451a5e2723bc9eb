// No exception may leave a callback; one that does is caught, and the run fails as for any other
// failure of a callback.
#include <stdexcept>

#include "check.h"
#include "tetstream/tetstream.h"

namespace {

enum Thrower { kNobody, kOpen, kNext, kClose, kPut, kProgress };
Thrower thrower;

void throwIf(Thrower here) {
  if (thrower == here) throw std::runtime_error("of the caller's");
}

int32_t open(void*, tetstream_stream_info* info) {
  throwIf(kOpen);
  info->position_type = TETSTREAM_TYPE_FLOAT64;
  return 0;
}

int32_t next(void* user, tetstream_batch* batch) {
  static const double positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const int64_t cell[4] = {0, 1, 2, 3};
  static const uint8_t all = 15;
  throwIf(kNext);
  bool& done = *static_cast<bool*>(user);
  if (done) return 0;
  done = true;
  batch->vertex_count = 4;
  batch->positions = positions;
  batch->cell_count = 1;
  batch->cells = cell;
  batch->last_uses = &all;
  return 0;
}

void close(void*) {
  throwIf(kClose);
}

int32_t put(void*, const tetstream_batch*) {
  throwIf(kPut);
  return 0;
}

int32_t progress(void*, const tetstream_progress*) {
  throwIf(kProgress);
  return 0;
}

tetstream_status convert(char message[256]) {
  bool done = false;
  tetstream_reader_callbacks reads = {sizeof reads, &done, open, next, close};
  tetstream_writer_callbacks writes = {sizeof writes, nullptr, nullptr, put, nullptr, close};
  tetstream_reader* reader = nullptr;
  tetstream_writer* writer = nullptr;
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  const tetstream_status status = tetstream_convert(reader, writer, nullptr, progress, nullptr);
  snprintf(message, 256, "%s", tetstream_writer_message(writer));
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  return status;
}

void exceptions_out_of_callbacks_become_a_status() {
  static const struct {
    Thrower thrower;
    const char* says;
  } cases[] = {{kOpen, "reader's open"},
               {kNext, "reader's next"},
               {kPut, "writer's put"},
               {kProgress, "progress"}};
  for (const auto& c : cases) {
    char message[256];
    thrower = c.thrower;
    CHECK_EQUAL(convert(message), TETSTREAM_CALLBACK);
    CHECK_SAYS(message, c.says);
    CHECK_SAYS(message, "exception");
  }
}

void an_exception_out_of_close_does_no_harm() {
  char message[256];
  thrower = kClose;
  CHECK_EQUAL(convert(message), TETSTREAM_OK);
  thrower = kNobody;
  CHECK_EQUAL(convert(message), TETSTREAM_OK);
}

}  // namespace

int main() {
  RUN_CASE(exceptions_out_of_callbacks_become_a_status);
  RUN_CASE(an_exception_out_of_close_does_no_harm);
  return check_end();
}
