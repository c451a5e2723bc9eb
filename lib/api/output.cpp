#include "output.h"

#include <utility>

#include "compressed_bytes.h"
#include "label_names.h"
#include "rounding_source.h"

namespace tetstream {

const Format& writtenFormat(const std::string& name, const std::string& path) {
  const Format& format = needFormat(name, path, FormatUse::kWriting);
  if (!format.create)
    fail(Status::kUnsupported, "the format \"%s\" is read, but not written", format.name);
  return format;
}

Output::Output(const tetstream_writer_callbacks& callbacks) : callbacks_(callbacks) {
  needPlace(reinterpret_cast<const void*>(callbacks_.put), "the callback put");
}

Output::Output(const Format& format, const std::string& path) : format_(&format) {
  const Wrapping wrapping = wrappingOf(path, &options_.path);
  options_.joint = &files_;
  bytes_ = wrapped(createFile(path, &files_), wrapping);
}

Output::Output(const Format& format, std::unique_ptr<ByteSink> bytes)
    : format_(&format), bytes_(std::move(bytes)) {}

Output::Output(const Format& format) : format_(&format), in_memory_(true) {
  bytes_ = createMemory(memory_);
}

void Output::needReady() const {
  if (state_ != State::kReady) failState("writer", state_);
  files_.needDistinct();
}

void Output::needRunning() const {
  if (state_ != State::kRunning) failState("writer", state_);
}

// ---------------------------------------------------------------------------------- properties

namespace {

// A property of some formats, with its two values; the first one sets the member to true.
struct Property {
  const char *name, *yes, *no;
  const char* formats[4];
  bool WriteOptions::*member;
};

constexpr Property kProperties[] = {
    {"compress", "yes", "no", {"tets", "vtu", "vtkhdf", nullptr}, &WriteOptions::compress},
    {"order", "post", "pre", {"sva", "svb", nullptr}, &WriteOptions::post_order},
    {"encoding", "binary", "text", {"msh", nullptr, nullptr}, &WriteOptions::binary},
    {"version", "4.1", "2.2", {"msh", nullptr, nullptr}, &WriteOptions::newest},
};

}  // namespace

static bool has(const Property& property, const Format& format) {
  for (const char* const* name = property.formats; *name; ++name)
    if (format.name == std::string(*name)) return true;
  return false;
}

void Output::set(const std::string& property, const std::string& value) {
  needReady();
  for (const Property& p : kProperties) {
    if (!format_ || property != p.name || !has(p, *format_)) continue;
    if (value != p.yes && value != p.no)
      fail(Status::kBadArgument, "property \"%s\": \"%s\" is neither \"%s\" nor \"%s\"", p.name,
           value.c_str(), p.yes, p.no);
    options_.*p.member = value == p.yes;
    return;
  }
  fail(Status::kBadArgument, "%s%s has no property \"%s\"", format_ ? "the format " : "a writer",
       format_ ? format_->name : " of callbacks", property.c_str());
}

// ------------------------------------------------------------------------------------ the stream

static std::string roundedNames(const Schema& schema) {
  std::string names = schema.position_type == ScalarType::kFloat64 ? "the positions" : "";
  for (const Column& c : schema.fields)
    if (c.type == ScalarType::kFloat64) names += (names.empty() ? "\"" : ", \"") + c.name + "\"";
  return names;
}

bool Output::mustRound(const Schema& schema) {
  if (!format_ || !format_->float32_only || !Rounding::needed(schema)) return false;
  addNote("rounded to float32, which is all that ." + std::string(format_->name) +
          " holds: " + roundedNames(schema));
  return true;
}

void Output::addNote(const std::string& note) {
  const std::lock_guard<std::mutex> lock(noting_);
  notes_.add(note);
}

const char* Output::note(int32_t index) const noexcept {
  const std::lock_guard<std::mutex> lock(noting_);
  return notes_.at(index);
}

void Output::start(const std::string& temp_dir, bool is_mapped) {
  needReady();
  if (format_) {
    options_.temp_dir = temp_dir;
    options_.is_mapped = is_mapped;
    options_.note = [this](const std::string& note) { addNote(note); };
    stays_with_caller_ = bytes_->waits();
    if (progress_) options_.tell = [this] { beforeWrite(); };
    bytes_ = watched(std::move(bytes_), options_.tell);
    sink_ = format_->create(std::move(bytes_), options_);
  } else {
    sink_ = std::make_unique<CallbackSink>(callbacks_);
  }
  state_ = State::kRunning;
}

void Output::begin(const Schema& schema) {
  if (format_ && !format_->label_names && !schema.label_names.empty())
    addNote(textOf(".%s has no names of labels; they are left out: %s", format_->name,
                   shownLabelNames(schema.label_names).c_str()));
  if (format_ && !format_->time && schema.time.value_or(0) != 0)
    addNote(
        textOf(".%s has no time of its values; it is left out: %.9g", format_->name, *schema.time));
  sink().begin(schema);
}

void Output::finish() {
  struct Scope {
    std::atomic<std::thread::id>& finishing;
    ~Scope() { finishing = std::thread::id(); }
  };
  const Scope scope{finishing_};
  finishing_ = std::this_thread::get_id();
  if (format_ && progress_) tellWriting();
  sink().finish();
}

ProgressFunction Output::watchedBy(ProgressFunction progress) {
  if (!progress) return progress;
  progress_ = std::move(progress);
  return [this](const Progress& p) {
    told_ = p;
    progress_(p);
  };
}

void Output::beforeWrite() {
  if (finishing_.load() == std::this_thread::get_id() && pause_.isOver()) tellWriting();
}

// Nobody knows how much is still to come.
void Output::tellWriting() {
  told_.phase = "write";
  told_.fraction = -1;
  progress_(told_);
}

Sink& Output::sink() {
  if (!sink_) failState("writer", state_);
  return *sink_;
}

void Output::complete() {
  files_.commit();
  state_ = State::kFinished;
  sink_.reset();
}

void Output::stop(State state) noexcept {
  if (state_ == State::kBroken || state_ == State::kDestroyed) return;
  state_ = state;
  if (const auto rest = std::exchange(rest_, nullptr)) rest();
  sink_.reset();
  bytes_.reset();
  files_.forget();
}

const std::vector<unsigned char>& Output::memory() const {
  if (!in_memory_) fail(Status::kBadState, "the writer does not write to memory");
  if (state_ != State::kFinished) failState("writer", state_);
  return memory_;
}

}  // namespace tetstream
