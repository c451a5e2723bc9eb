// swig: the library's handles as objects that own them. Methods have the names of the C functions
// without their prefix; a status below 0 is thrown as a Failure with the handle's sentence, a
// missed target is returned. Depends on mesh_collector.h, language.h.
#pragma once

#include <memory>

#include "language.h"
#include "mesh_collector.h"

namespace tetstream::swig {

struct Destroy {
  void operator()(tetstream_options* handle) const { tetstream_options_destroy(handle); }
  void operator()(tetstream_reader* handle) const { tetstream_reader_destroy(handle); }
  void operator()(tetstream_writer* handle) const { tetstream_writer_destroy(handle); }
  void operator()(tetstream_simplifier* handle) const { tetstream_simplifier_destroy(handle); }
  void operator()(tetstream_diagram* handle) const { tetstream_diagram_destroy(handle); }
  void operator()(tetstream_comparison* handle) const { tetstream_comparison_destroy(handle); }
};
template <class T>
using Handle = std::unique_ptr<T, Destroy>;

class ProgressRelay;

class Options {
 public:
  Options();
  ~Options();
  void setInt64(int32_t id, int64_t value);
  void setDouble(int32_t id, double value);
  void setText(int32_t id, const char* value);
  void parse(const char* name, const char* value);
  int64_t getInt64(int32_t id) const;
  double getDouble(int32_t id) const;
  const char* getText(int32_t id) const;
  void addField(const char* name, double weight);
  // Called while a reader is opened; the language keeps it. Without, the user can interrupt.
  void setProgress(const Function& progress);

  const tetstream_options* handle() const { return handle_.get(); }

 private:
  std::unique_ptr<ProgressRelay> progress_;
  Handle<tetstream_options> handle_;
};

// What a reader is made of is kept by it, but for arrays, which the language keeps.
class Reader {
 public:
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader();
  static Reader* openFile(const char* path, const char* format, const Options& options);
  static Reader* openResult(const char* path, const char* format, const Options& options);
  static Reader* openMemory(const ArrayView& bytes, const char* format, const Options& options);
  // With `from_one`, points and, in messages, rows are numbered from 1.
  static Reader* openMesh(const StreamInfo& info, StreamBatch& mesh, bool from_one);
  static Reader* generate(const char* kind, int64_t cells, int64_t seed);
  // `next` is called with an empty StreamBatch to fill.
  static Reader* create(const StreamInfo& info, const Function& next);

  StreamInfo* getInfo();
  // Reads everything.
  StreamInfo* inspect(const Options& options, const Function& progress);
  // Of what inspect found.
  tetstream_front_info getFront();
  int32_t faceLabelCount();
  tetstream_face_label_info getFaceLabel(int32_t index);
  const char* note(int32_t index) const { return tetstream_reader_note(handle_.get(), index); }

  tetstream_reader* handle() const { return handle_.get(); }

 private:
  struct Source;
  Reader();
  // Creates the handle; throws what went wrong.
  template <class Create>
  static Reader* made(std::unique_ptr<Reader> reader, Create&& create);

  std::unique_ptr<Source> source_;
  Handle<tetstream_reader> handle_;
};

class Writer {
 public:
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer();
  static Writer* createFile(const char* path, const char* format);
  static Writer* createMemory(const char* format);
  // `open` is called with a StreamInfo, `put` with a StreamBatch, `finish` with the StreamInfo
  // again; any but put may be empty.
  static Writer* create(const Function& open, const Function& put, const Function& finish);
  // The collector must live as long as the writer.
  static Writer* collect(MeshCollector& collector);

  void set(const char* property, const char* value);
  ArrayView getMemory() const;  // bytes, as long as the writer lives
  const char* note(int32_t index) const { return tetstream_writer_note(handle_.get(), index); }
  // Reads everything from `reader` and writes it.
  void convert(Reader& reader, const Options& options, const Function& progress);
  tetstream_layout_report layout(Reader& reader, const Options& options, const Function& progress);

  tetstream_writer* handle() const { return handle_.get(); }

 private:
  struct Target;
  Writer();
  template <class Create>
  static Writer* made(std::unique_ptr<Writer> writer, Create&& create);

  std::unique_ptr<Target> target_;
  Handle<tetstream_writer> handle_;
};

class Simplifier {
 public:
  Simplifier(const Options& options, Writer& writer, const Function& progress);
  ~Simplifier();
  void setMap(MapCollector& map);
  void setMapFile(const char* path, const char* format);
  void setLogFile(const char* path, const char* format);
  // These give TETSTREAM_OK or TETSTREAM_TARGET_MISSED.
  int32_t run(Reader& reader);
  void begin(const StreamInfo& info);
  void push(StreamBatch& batch);
  int32_t finish();
  tetstream_report getReport() const;

 private:
  std::unique_ptr<ProgressRelay> progress_;
  std::unique_ptr<StreamInfo> info_;
  Handle<tetstream_simplifier> handle_;
};

class Diagram {
 public:
  Diagram(const Options& options, int32_t columns, int32_t rows);
  void read(Reader& reader, int32_t page, const Function& progress);
  tetstream_diagram_info getInfo() const;
  ArrayView coverage() const;  // [rows][columns]
  ArrayView widths() const;    // [columns], here and below
  ArrayView lowest() const;
  ArrayView newest() const;
  void write(int32_t page, const char* path, const char* title);

 private:
  Handle<tetstream_diagram> handle_;
};

class Comparison {
 public:
  explicit Comparison(const Options& options);
  void read(Reader& original, Reader& simplified, const Function& progress);
  tetstream_comparison_info getInfo() const;
  tetstream_mesh_figures getMesh(int32_t mesh) const;
  tetstream_field_comparison getField(int32_t index) const;
  tetstream_region_comparison getRegion(int32_t index) const;
  tetstream_face_label_comparison getFaceLabel(int32_t index) const;
  void write(const char* path, const char* title);

 private:
  Handle<tetstream_comparison> handle_;
};

tetstream_option_info optionAt(int32_t index);
// A row of the table of formats; the name is NULL past the end.
struct FormatInfo {
  const char* name = nullptr;
  const char* extensions = nullptr;
  const char* text = nullptr;
  int32_t can_read = 0, can_write = 0;
};
FormatInfo formatAt(int32_t index);

}  // namespace tetstream::swig
