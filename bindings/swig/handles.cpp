// swig: options, simplifiers, diagrams, comparisons and the tables.
#include "handles.h"

#include "calls.h"

namespace tetstream::swig {

// -------------------------------------------------------------------------------------- options

Options::Options() {
  createInto(handle_, tetstream_options_create);
  setProgress({});
}

Options::~Options() = default;

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

void Options::setProgress(const Function& progress) {
  auto relay = std::make_unique<ProgressRelay>(progress);
  check(tetstream_options_set_progress(handle_.get(), ProgressRelay::callback, relay.get()),
        handle_);
  progress_ = std::move(relay);
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

tetstream_face_label_comparison Comparison::getFaceLabel(int32_t index) const {
  return filled<tetstream_face_label_comparison>([&](tetstream_face_label_comparison& out) {
    check(tetstream_comparison_get_face_label(handle_.get(), index, &out), handle_);
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
