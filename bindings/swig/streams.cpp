// swig: readers and writers.
#include "calls.h"

namespace tetstream::swig {

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

Reader* Reader::openFile(const char* path, const char* format, const Options& options) {
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_open_file_with(path, format, options.handle(), handle);
  });
}

Reader* Reader::openResult(const char* path, const char* format, const Options& options) {
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_open_result(path, format, options.handle(), handle);
  });
}

Reader* Reader::openMemory(const ArrayView& bytes, const char* format, const Options& options) {
  if (bytes.data && bytes.type != kBytes) failArgument("bytes: an array of uint8 is wanted");
  const auto size = static_cast<size_t>(bytes.rows) * static_cast<size_t>(bytes.columns);
  return made(std::unique_ptr<Reader>(new Reader), [&](tetstream_reader** handle) {
    return tetstream_reader_open_memory_with(bytes.data, size, format, options.handle(), handle);
  });
}

Reader* Reader::openMesh(const StreamInfo& info, StreamBatch& mesh, bool from_one) {
  tetstream_stream_info announced = info.info();
  if (from_one) announced.flags |= TETSTREAM_STREAM_FROM_ONE;
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

int32_t Reader::faceLabelCount() {
  tetstream_face_label_info label = {};
  label.struct_size = sizeof label;
  int32_t count = 0;
  while (tetstream_reader_get_face_label(handle_.get(), count, &label) == TETSTREAM_OK) ++count;
  return count;
}

tetstream_face_label_info Reader::getFaceLabel(int32_t index) {
  return filled<tetstream_face_label_info>([&](tetstream_face_label_info& out) {
    check(tetstream_reader_get_face_label(handle_.get(), index, &out), handle_);
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

}  // namespace tetstream::swig
