// One reader: any bytes as a file of TETSTREAM_FUZZ_FORMAT, read to the end in the order in which
// it would be simplified. A file that is refused is fine; one that is accepted gives a stream that
// keeps the rules of tetstream.h.
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "side_files.h"
#include "target.h"

namespace {

// Cells are split or not by the parity of the size, so that both happen.
tetstream_options* makeOptions(size_t size) {
  tetstream_options* options = nullptr;
  tetstream_options_create(&options);
  tetstream_options_set_int64(options, TETSTREAM_OPTION_MEMORY, 8 << 20);
  tetstream_options_set_text(options, TETSTREAM_OPTION_SPLIT, size % 2 ? "yes" : "no");
  return options;
}

tetstream_status openReader(std::string_view data, const tetstream_options* options,
                            tetstream_reader** reader) {
  if (const char* path = fuzz::writeSideFiles(data, TETSTREAM_FUZZ_FORMAT))
    return tetstream_reader_open_file_with(path, TETSTREAM_FUZZ_FORMAT, options, reader);
  // A copy of its own, so that a read past the end is one past a block of memory.
  return tetstream_reader_open_memory_with(data.data(), data.size(), TETSTREAM_FUZZ_FORMAT, options,
                                           reader);
}

void readAll(tetstream_reader* reader, const tetstream_options* options) {
  tetstream_stream_info info = {};
  info.struct_size = sizeof info;
  tetstream_status status = tetstream_reader_get_info(reader, &info);
  PROMISE(status == TETSTREAM_OK, "no info: %s", tetstream_reader_message(reader));
  const int64_t vertices = info.vertex_count, cells = info.cell_count;
  fuzz::EventChecker checker;
  const tetstream_writer_callbacks callbacks = checker.callbacks();
  tetstream_writer* writer = nullptr;
  tetstream_writer_create(&callbacks, &writer);
  status = tetstream_convert(reader, writer, options, nullptr, nullptr);
  fuzz::checkFailure(status, tetstream_writer_message(writer));
  if (status == TETSTREAM_OK) {
    PROMISE(cells < 0 || checker.cells() == cells, "%lld cells of %lld",
            static_cast<long long>(checker.cells()), static_cast<long long>(cells));
    PROMISE(vertices < 0 || checker.vertices() <= vertices, "%lld vertices of %lld",
            static_cast<long long>(checker.vertices()), static_cast<long long>(vertices));
  }
  tetstream_writer_destroy(writer);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  tetstream_options* options = makeOptions(size);
  tetstream_reader* reader = nullptr;
  const tetstream_status status =
      openReader({reinterpret_cast<const char*>(data), size}, options, &reader);
  if (status < 0)
    fuzz::checkFailure(status, tetstream_reader_message(reader));
  else
    readAll(reader, options);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return 0;
}
