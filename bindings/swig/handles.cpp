#include "handles.h"

#include <chrono>

#include "failure.h"

namespace tetstream::swig {

// ------------------------------------------------------------------- what the handles share

static const char* messageOf(const tetstream_options* h) {
  return tetstream_options_message(h);
}
static const char* messageOf(const tetstream_reader* h) {
  return tetstream_reader_message(h);
}
static const char* messageOf(const tetstream_writer* h) {
  return tetstream_writer_message(h);
}
static const char* messageOf(const tetstream_simplifier* h) {
  return tetstream_simplifier_message(h);
}
static const char* messageOf(const tetstream_diagram* h) {
  return tetstream_diagram_message(h);
}
static const char* messageOf(const tetstream_comparison* h) {
  return tetstream_comparison_message(h);
}

// Throws the handle's sentence if the status is a failure.
template <class T>
static tetstream_status check(tetstream_status status, const Handle<T>& handle) {
  if (status >= 0) return status;
  const char* const sentence = handle ? messageOf(handle.get()) : nullptr;
  throw Failure(status, sentence && *sentence ? sentence : tetstream_status_name(status));
}

// A creating function gives a handle also when it fails, for the message.
template <class T, class Create>
static void createInto(Handle<T>& handle, Create&& create) {
  T* made = nullptr;
  const tetstream_status status = inLibrary([&] { return create(&made); });
  handle.reset(made);
  check(status, handle);
}

// A struct of the library's that a function fills.
template <class S, class Fill>
static S filled(Fill&& fill) {
  S out = {};
  out.struct_size = sizeof out;
  fill(out);
  return out;
}

// Between the library's progress callback, which may come often, and the language's function: the
// function is called when a phase begins or ends and some times a second; also without a function,
// the user can interrupt.
class ProgressRelay {
 public:
  explicit ProgressRelay(const Function& function) : function_(function) {}

  static int32_t callback(void* user, const tetstream_progress* progress) {
    return inCallback([&] { static_cast<ProgressRelay*>(user)->tell(*progress); });
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPause{50};

  void tell(const tetstream_progress& progress) {
    const Clock::time_point now = Clock::now();
    const bool is_due = now - last_ >= kPause || progress.phase != phase_ || progress.fraction >= 1;
    if (!is_due) return;
    last_ = now;
    phase_ = progress.phase;
    checkInterrupt();
    tetstream_progress shown = progress;
    if (function_) function_("tetstream_progress *", &shown);
  }

  Function function_;
  Clock::time_point last_;
  const char* phase_ = nullptr;  // static texts
};

// -------------------------------------------------------------------------------------- options

Options::Options() {
  createInto(handle_, tetstream_options_create);
}

void Options::setInt64(int32_t id, int64_t value) {
  check(tetstream_options_set_int64(handle_.get(), id, value), handle_);
}

void Options::setDouble(int32_t id, double value) {
  check(tetstream_options_set_double(handle_.get(), id, value), handle_);
}

void Options::setText(int32_t id, const char* value) {
  check(tetstream_options_set_text(handle_.get(), id, value), handle_);
}

void Options::parse(const char* name, const char* value) {
  check(tetstream_options_parse(handle_.get(), name, value), handle_);
}

int64_t Options::getInt64(int32_t id) const {
  int64_t value = 0;
  check(tetstream_options_get_int64(handle_.get(), id, &value), handle_);
  return value;
}

double Options::getDouble(int32_t id) const {
  double value = 0;
  check(tetstream_options_get_double(handle_.get(), id, &value), handle_);
  return value;
}

const char* Options::getText(int32_t id) const {
  const char* value = nullptr;
  check(tetstream_options_get_text(handle_.get(), id, &value), handle_);
  return value;
}

void Options::addField(const char* name, double weight) {
  check(tetstream_options_add_field(handle_.get(), name, weight), handle_);
}

// --------------------------------------------------------------------------------------- reader

// What a reader of the language's is made of.
struct Reader::Source {
  Source(const StreamInfo& the_info, const Function& the_next) : info(the_info), next(the_next) {}

  tetstream_reader_callbacks callbacks() {
    tetstream_reader_callbacks out = {};
    out.struct_size = sizeof out;
    out.user = this;
    out.open = [](void* user, tetstream_stream_info* filled_in) {
      return inCallback([&] { *filled_in = static_cast<Source*>(user)->info.info(); });
    };
    out.next = [](void* user, tetstream_batch* filled_in) {
      return inCallback([&] {
        auto& source = *static_cast<Source*>(user);
        source.batch.clear();
        source.next("tetstream::swig::StreamBatch *", &source.batch);
        *filled_in = source.batch.batch(source.info);
      });
    };
    return out;
  }

  StreamInfo info;
  Function next;
  StreamBatch batch;
};

Reader::Reader() = default;
Reader::~Reader() = default;

template <class Create>
Reader* Reader::made(std::unique_ptr<Reader> reader, Create&& create) {
  createInto(reader->handle_, create);
  return reader.release();
}

Reader* Reader::openFile(const char* path, const char* format) {
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_open_file(path, format, handle);
  });
}

Reader* Reader::openMemory(const ArrayView& bytes, const char* format) {
  if (bytes.data && bytes.type != kBytes) failArgument("bytes: an array of uint8 is wanted");
  const auto size = static_cast<size_t>(bytes.rows) * static_cast<size_t>(bytes.columns);
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_open_memory(bytes.data, size, format, handle);
  });
}

Reader* Reader::openMesh(const StreamInfo& info, StreamBatch& mesh) {
  tetstream_stream_info announced = info.info();
  if (mesh.cellType() == TETSTREAM_TYPE_INT32) announced.flags |= TETSTREAM_STREAM_INT32_CELLS;
  const tetstream_batch batch = mesh.batch(info, mesh.cellType());
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_open_mesh(&announced, &batch, handle);
  });
}

Reader* Reader::generate(const char* kind, int64_t cells, int64_t seed) {
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_generate(kind, cells, seed, handle);
  });
}

Reader* Reader::create(const StreamInfo& info, const Function& next) {
  std::unique_ptr<Reader> reader(new Reader);
  reader->source_ = std::make_unique<Source>(info, next);
  const tetstream_reader_callbacks callbacks = reader->source_->callbacks();
  return made(std::move(reader), [&](tetstream_reader** handle) {
    return tetstream_reader_create(&callbacks, handle);
  });
}

StreamInfo* Reader::getInfo() {
  const auto info = filled<tetstream_stream_info>([&](tetstream_stream_info& out) {
    check(inLibrary([&] { return tetstream_reader_get_info(handle_.get(), &out); }), handle_);
  });
  return new StreamInfo(info);
}

StreamInfo* Reader::inspect(const Options& options, const Function& progress) {
  ProgressRelay relay(progress);
  const auto info = filled<tetstream_stream_info>([&](tetstream_stream_info& out) {
    check(inLibrary([&] {
            return tetstream_inspect(handle_.get(), options.handle(), ProgressRelay::callback,
                                     &relay, &out);
          }),
          handle_);
  });
  return new StreamInfo(info);
}

tetstream_front_info Reader::getFront() {
  return filled<tetstream_front_info>([&](tetstream_front_info& out) {
    check(tetstream_reader_get_front(handle_.get(), &out), handle_);
  });
}

// --------------------------------------------------------------------------------------- writer

// What a writer of the language's is made of.
struct Writer::Target {
  Target(const Function& the_open, const Function& the_put, const Function& the_finish)
      : open(the_open), put(the_put), finish(the_finish) {}

  static void show(const Function& function, StreamInfo& info) {
    if (function) function("tetstream::swig::StreamInfo *", &info);
  }
  tetstream_writer_callbacks callbacks() {
    tetstream_writer_callbacks out = {};
    out.struct_size = sizeof out;
    out.user = this;
    out.open = [](void* user, const tetstream_stream_info* begun) {
      return inCallback([&] {
        auto& target = *static_cast<Target*>(user);
        target.info = std::make_unique<StreamInfo>(*begun);
        show(target.open, *target.info);
      });
    };
    out.put = [](void* user, const tetstream_batch* given) {
      return inCallback([&] {
        const auto& target = *static_cast<Target*>(user);
        StreamBatch batch(*given, *target.info);
        target.put("tetstream::swig::StreamBatch *", &batch);
      });
    };
    out.finish = [](void* user) {
      return inCallback([&] {
        const auto& target = *static_cast<Target*>(user);
        show(target.finish, *target.info);
      });
    };
    return out;
  }

  Function open, put, finish;
  std::unique_ptr<StreamInfo> info;
};

Writer::Writer() = default;
Writer::~Writer() = default;

template <class Create>
Writer* Writer::made(std::unique_ptr<Writer> writer, Create&& create) {
  createInto(writer->handle_, create);
  return writer.release();
}

Writer* Writer::createFile(const char* path, const char* format) {
  return made(std::unique_ptr<Writer>(new Writer), [&](tetstream_writer** handle) {
    return tetstream_writer_create_file(path, format, handle);
  });
}

Writer* Writer::createMemory(const char* format) {
  return made(std::unique_ptr<Writer>(new Writer), [&](tetstream_writer** handle) {
    return tetstream_writer_create_memory(format, handle);
  });
}

Writer* Writer::create(const Function& open, const Function& put, const Function& finish) {
  if (!put) failArgument("put: a function is wanted");
  std::unique_ptr<Writer> writer(new Writer);
  writer->target_ = std::make_unique<Target>(open, put, finish);
  const tetstream_writer_callbacks callbacks = writer->target_->callbacks();
  return made(std::move(writer), [&](tetstream_writer** handle) {
    return tetstream_writer_create(&callbacks, handle);
  });
}

Writer* Writer::collect(MeshCollector& collector) {
  const tetstream_writer_callbacks callbacks = collector.callbacks();
  return made(std::unique_ptr<Writer>(new Writer), [&](tetstream_writer** handle) {
    return tetstream_writer_create(&callbacks, handle);
  });
}

void Writer::set(const char* property, const char* value) {
  check(tetstream_writer_set(handle_.get(), property, value), handle_);
}

ArrayView Writer::getMemory() const {
  const void* data = nullptr;
  size_t size = 0;
  check(tetstream_writer_get_memory(handle_.get(), &data, &size), handle_);
  return {data, kBytes, static_cast<int64_t>(size), 1};
}

void Writer::convert(Reader& reader, const Options& options, const Function& progress) {
  ProgressRelay relay(progress);
  check(inLibrary([&] {
          return tetstream_convert(reader.handle(), handle_.get(), options.handle(),
                                   ProgressRelay::callback, &relay);
        }),
        handle_);
}

tetstream_layout_report Writer::layout(Reader& reader, const Options& options,
                                       const Function& progress) {
  ProgressRelay relay(progress);
  return filled<tetstream_layout_report>([&](tetstream_layout_report& out) {
    check(inLibrary([&] {
            return tetstream_layout(reader.handle(), handle_.get(), options.handle(),
                                    ProgressRelay::callback, &relay, &out);
          }),
          handle_);
  });
}

// ----------------------------------------------------------------------------------- simplifier

Simplifier::Simplifier(const Options& options, Writer& writer, const Function& progress)
    : progress_(std::make_unique<ProgressRelay>(progress)) {
  createInto(handle_, [&](tetstream_simplifier** handle) {
    return tetstream_simplifier_create(options.handle(), writer.handle(), handle);
  });
  check(tetstream_simplifier_set_progress(handle_.get(), ProgressRelay::callback, progress_.get()),
        handle_);
}

Simplifier::~Simplifier() = default;

void Simplifier::setMap(MapCollector& map) {
  const tetstream_map_callbacks callbacks = map.callbacks();
  check(tetstream_simplifier_set_map(handle_.get(), &callbacks), handle_);
}

void Simplifier::setMapFile(const char* path, const char* format) {
  check(tetstream_simplifier_set_map_file(handle_.get(), path, format), handle_);
}

void Simplifier::setLogFile(const char* path, const char* format) {
  check(tetstream_simplifier_set_log_file(handle_.get(), path, format), handle_);
}

int32_t Simplifier::run(Reader& reader) {
  return check(inLibrary([&] { return tetstream_simplifier_run(handle_.get(), reader.handle()); }),
               handle_);
}

void Simplifier::begin(const StreamInfo& info) {
  info_ = std::make_unique<StreamInfo>(info);
  const tetstream_stream_info announced = info_->info();
  check(inLibrary([&] { return tetstream_simplifier_begin(handle_.get(), &announced); }), handle_);
}

void Simplifier::push(StreamBatch& batch) {
  if (!info_) throw Failure(TETSTREAM_BAD_STATE, "push: the stream has not begun");
  const tetstream_batch events = batch.batch(*info_);
  check(inLibrary([&] { return tetstream_simplifier_push(handle_.get(), &events); }), handle_);
}

int32_t Simplifier::finish() {
  return check(inLibrary([&] { return tetstream_simplifier_finish(handle_.get()); }), handle_);
}

tetstream_report Simplifier::getReport() const {
  return filled<tetstream_report>([&](tetstream_report& out) {
    check(tetstream_simplifier_get_report(handle_.get(), &out), handle_);
  });
}

// -------------------------------------------------------------------------------------- diagram

Diagram::Diagram(const Options& options, int32_t columns, int32_t rows) {
  createInto(handle_, [&](tetstream_diagram** handle) {
    return tetstream_diagram_create(options.handle(), columns, rows, handle);
  });
}

void Diagram::read(Reader& reader, int32_t page, const Function& progress) {
  ProgressRelay relay(progress);
  check(inLibrary([&] {
          return tetstream_diagram_read(handle_.get(), reader.handle(), page,
                                        ProgressRelay::callback, &relay);
        }),
        handle_);
}

tetstream_diagram_info Diagram::getInfo() const {
  return filled<tetstream_diagram_info>([&](tetstream_diagram_info& out) {
    check(tetstream_diagram_get_info(handle_.get(), &out), handle_);
  });
}

ArrayView Diagram::coverage() const {
  const tetstream_diagram_info info = getInfo();
  return {info.coverage, TETSTREAM_TYPE_FLOAT32, info.rows, info.columns};
}

ArrayView Diagram::widths() const {
  const tetstream_diagram_info info = getInfo();
  return {info.widths, TETSTREAM_TYPE_INT64, info.columns, 1};
}

ArrayView Diagram::lowest() const {
  const tetstream_diagram_info info = getInfo();
  return {info.lowest, TETSTREAM_TYPE_INT64, info.columns, 1};
}

ArrayView Diagram::newest() const {
  const tetstream_diagram_info info = getInfo();
  return {info.newest, TETSTREAM_TYPE_INT64, info.columns, 1};
}

void Diagram::write(int32_t page, const char* path, const char* title) {
  check(inLibrary([&] { return tetstream_diagram_write(handle_.get(), page, path, title); }),
        handle_);
}

// ----------------------------------------------------------------------------------- comparison

Comparison::Comparison(const Options& options) {
  createInto(handle_, [&](tetstream_comparison** handle) {
    return tetstream_comparison_create(options.handle(), handle);
  });
}

void Comparison::read(Reader& original, Reader& simplified, const Function& progress) {
  ProgressRelay relay(progress);
  check(inLibrary([&] {
          return tetstream_comparison_read(handle_.get(), original.handle(), simplified.handle(),
                                           ProgressRelay::callback, &relay);
        }),
        handle_);
}

tetstream_comparison_info Comparison::getInfo() const {
  return filled<tetstream_comparison_info>([&](tetstream_comparison_info& out) {
    check(tetstream_comparison_get_info(handle_.get(), &out), handle_);
  });
}

tetstream_mesh_figures Comparison::getMesh(int32_t mesh) const {
  return filled<tetstream_mesh_figures>([&](tetstream_mesh_figures& out) {
    check(tetstream_comparison_get_mesh(handle_.get(), mesh, &out), handle_);
  });
}

tetstream_field_comparison Comparison::getField(int32_t index) const {
  return filled<tetstream_field_comparison>([&](tetstream_field_comparison& out) {
    check(tetstream_comparison_get_field(handle_.get(), index, &out), handle_);
  });
}

tetstream_region_comparison Comparison::getRegion(int32_t index) const {
  return filled<tetstream_region_comparison>([&](tetstream_region_comparison& out) {
    check(tetstream_comparison_get_region(handle_.get(), index, &out), handle_);
  });
}

void Comparison::write(const char* path, const char* title) {
  check(inLibrary([&] { return tetstream_comparison_write(handle_.get(), path, title); }), handle_);
}

// --------------------------------------------------------------------------------------- tables

tetstream_option_info optionAt(int32_t index) {
  return filled<tetstream_option_info>([&](tetstream_option_info& out) {
    swig::check(tetstream_option_at(index, &out), "tetstream_option_at");
  });
}

FormatInfo formatAt(int32_t index) {
  FormatInfo out;
  const tetstream_status status = tetstream_format_at(index, &out.name, &out.extensions, &out.text,
                                                      &out.can_read, &out.can_write);
  return status < 0 ? FormatInfo() : out;
}

}  // namespace tetstream::swig
