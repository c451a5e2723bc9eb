// A program of somebody else's, in C++: takes the output in a callback that is a lambda.
#include <tetstream/tetstream.h>

#include <cstdio>
#include <memory>

template <class H, void (*destroy)(H*)>
struct Destroy {
  void operator()(H* handle) const { destroy(handle); }
};
using Reader =
    std::unique_ptr<tetstream_reader, Destroy<tetstream_reader, tetstream_reader_destroy>>;
using Writer =
    std::unique_ptr<tetstream_writer, Destroy<tetstream_writer, tetstream_writer_destroy>>;

int main() {
  long cells = 0;
  tetstream_writer_callbacks callbacks = {};
  callbacks.struct_size = sizeof callbacks;
  callbacks.user = &cells;
  callbacks.put = [](void* user, const tetstream_batch* batch) -> int32_t {
    *static_cast<long*>(user) += static_cast<long>(batch->cell_count);
    return 0;
  };
  tetstream_reader* reader = nullptr;
  tetstream_writer* writer = nullptr;
  tetstream_status status = tetstream_reader_generate("ball", 2000, 1, &reader);
  const Reader own_reader(reader);
  if (status >= 0) status = tetstream_writer_create(&callbacks, &writer);
  const Writer own_writer(writer);
  if (status >= 0) status = tetstream_convert(reader, writer, nullptr, nullptr, nullptr);
  std::printf("%s: %ld cells\n", tetstream_status_name(status), cells);
  return status == TETSTREAM_OK && cells > 0 ? 0 : 1;
}
