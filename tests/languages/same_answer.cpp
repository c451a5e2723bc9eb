// The shared problem in C++. A reader of callbacks, whose batches are of odd sizes, goes to a file;
// pushed batches come back in a lambda.
#include <algorithm>
#include <memory>
#include <vector>

#include "problem.h"

namespace {

template <class T>
using Handle = std::unique_ptr<T, void (*)(T*)>;

// The mesh as a stream of batches; an indexed one may bring them in any sizes.
class Batches {
 public:
  bool next(tetstream_batch& batch) {
    batch.vertex_count = std::min<int64_t>(POINTS - vertex_, 97);
    batch.cell_count = std::min<int64_t>(CELLS - cell_, 501);
    batch.positions = points[vertex_];
    fields_[0] = pressure + vertex_;
    fields_[1] = velocity[vertex_];
    cell_data_[0] = material + cell_;
    batch.fields = fields_;
    batch.cells = cells[cell_];
    batch.cell_data = cell_data_;
    vertex_ += batch.vertex_count;
    cell_ += batch.cell_count;
    return batch.vertex_count + batch.cell_count > 0;
  }

 private:
  int64_t vertex_ = 0, cell_ = 0;
  const void* fields_[2] = {};
  const void* cell_data_[1] = {};
};

// What comes back, as bytes of one array after the other.
struct Result {
  std::vector<char> arrays[5];

  void add(int array, const void* rows, int64_t count, size_t row_bytes) {
    const char* const bytes = static_cast<const char*>(rows);
    if (count > 0)
      arrays[array].insert(arrays[array].end(), bytes,
                           bytes + static_cast<size_t>(count) * row_bytes);
  }
  void take(const tetstream_batch& batch) {
    const int64_t n = batch.vertex_count, m = batch.cell_count;
    add(0, batch.positions, n, sizeof points[0]);
    add(1, n > 0 ? batch.fields[0] : nullptr, n, sizeof pressure[0]);
    add(2, n > 0 ? batch.fields[1] : nullptr, n, sizeof velocity[0]);
    add(3, batch.cells, m, sizeof cells[0]);
    add(4, m > 0 ? batch.cell_data[0] : nullptr, m, sizeof material[0]);
  }
  std::vector<char> together() const {
    std::vector<char> all;
    for (const std::vector<char>& array : arrays) all.insert(all.end(), array.begin(), array.end());
    return all;
  }
};

Handle<tetstream_options> ownOptions() {
  tetstream_options* options = nullptr;
  const tetstream_status status = make_options(&options);
  Handle<tetstream_options> own(options, tetstream_options_destroy);
  if (status < 0) throw status;
  return own;
}

Handle<tetstream_simplifier> ownSimplifier(tetstream_writer* writer) {
  tetstream_simplifier* simplifier = nullptr;
  const tetstream_status status =
      tetstream_simplifier_create(ownOptions().get(), writer, &simplifier);
  Handle<tetstream_simplifier> own(simplifier, tetstream_simplifier_destroy);
  if (status < 0) throw status;
  return own;
}

tetstream_status pull(const char* path) {
  Batches batches;
  tetstream_reader_callbacks callbacks = {};
  callbacks.struct_size = sizeof callbacks;
  callbacks.user = &batches;
  callbacks.open = [](void*, tetstream_stream_info* info) -> int32_t {
    describe(info);
    return 0;
  };
  callbacks.next = [](void* user, tetstream_batch* batch) -> int32_t {
    static_cast<Batches*>(user)->next(*batch);
    return 0;
  };
  tetstream_reader* reader = nullptr;
  tetstream_writer* writer = nullptr;
  tetstream_status status = tetstream_reader_create(&callbacks, &reader);
  const Handle<tetstream_reader> own_reader(reader, tetstream_reader_destroy);
  if (status >= 0) status = tetstream_writer_create_file(path, nullptr, &writer);
  const Handle<tetstream_writer> own_writer(writer, tetstream_writer_destroy);
  return status < 0 ? status : tetstream_simplifier_run(ownSimplifier(writer).get(), reader);
}

tetstream_status push(Result& result) {
  tetstream_writer_callbacks callbacks = {};
  callbacks.struct_size = sizeof callbacks;
  callbacks.user = &result;
  callbacks.put = [](void* user, const tetstream_batch* batch) -> int32_t {
    static_cast<Result*>(user)->take(*batch);
    return 0;
  };
  tetstream_writer* writer = nullptr;
  tetstream_status status = tetstream_writer_create(&callbacks, &writer);
  const Handle<tetstream_writer> own_writer(writer, tetstream_writer_destroy);
  if (status < 0) return status;
  const Handle<tetstream_simplifier> simplifier = ownSimplifier(writer);
  tetstream_stream_info info = {};
  describe(&info);
  status = tetstream_simplifier_begin(simplifier.get(), &info);
  Batches batches;
  for (tetstream_batch batch = {}; status >= 0; batch = {}) {
    batch.struct_size = sizeof batch;
    if (!batches.next(batch)) return tetstream_simplifier_finish(simplifier.get());
    status = tetstream_simplifier_push(simplifier.get(), &batch);
  }
  std::fprintf(stderr, "C++: %s\n", tetstream_simplifier_message(simplifier.get()));
  return status;
}

}  // namespace

int main() {
  make_points();
  make_cells();
  try {
    Result result;
    if (pull("cpp.tets") != TETSTREAM_OK || push(result) != TETSTREAM_OK) return 1;
    const std::vector<char> all = result.together();
    return write_bytes("cpp.raw", all.data(), all.size());
  } catch (tetstream_status status) {
    std::fprintf(stderr, "C++: %s\n", tetstream_status_name(status));
    return 1;
  }
}
