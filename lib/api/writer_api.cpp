// api: writers of the public header.
#include "descriptor_name.h"
#include "handles.h"
#include "registry.h"

using namespace tetstream;

tetstream_status tetstream_writer_create(const tetstream_writer_callbacks* callbacks,
                                         tetstream_writer** writer) {
  return guardCreate(__func__, writer, [&](tetstream_writer& w) {
    w.output = std::make_shared<Output>(readStruct(callbacks, "callbacks"));
  });
}

tetstream_status tetstream_writer_create_file(const char* path, const char* format,
                                              tetstream_writer** writer) {
  return guardCreate(__func__, writer, [&](tetstream_writer& w) {
    needPlace(path, "path");
    const Format& found = writtenFormat(format ? format : "", path);
    w.output = std::make_shared<Output>(found, std::string(path));
  });
}

tetstream_status tetstream_writer_create_fd(int32_t fd, const char* format,
                                            tetstream_writer** writer) {
  return guardCreate(__func__, writer, [&](tetstream_writer& w) {
    needPlace(format, "format");
    const Format& found = writtenFormat(format, "");
    w.output = std::make_shared<Output>(found, createDescriptor(fd, descriptorName(fd)));
  });
}

tetstream_status tetstream_writer_create_memory(const char* format, tetstream_writer** writer) {
  return guardCreate(__func__, writer, [&](tetstream_writer& w) {
    needPlace(format, "format");
    w.output = std::make_shared<Output>(writtenFormat(format, ""));
  });
}

tetstream_status tetstream_writer_get_memory(const tetstream_writer* writer, const void** data,
                                             size_t* size) {
  return guard(__func__, writer, [&](const tetstream_writer& w) {
    needPlace(data, "data");
    needPlace(size, "size");
    const std::vector<unsigned char>& memory = outputOf(w).memory();
    *data = memory.data();
    *size = memory.size();
  });
}

tetstream_status tetstream_writer_set(tetstream_writer* writer, const char* property,
                                      const char* value) {
  return guard(__func__, writer, [&](tetstream_writer& w) {
    needPlace(property, "property");
    needPlace(value, "value");
    outputOf(w).set(property, value);
  });
}

void tetstream_writer_destroy(tetstream_writer* writer) {
  const Undisturbed undisturbed;
  if (writer && writer->output) writer->output->stop(State::kDestroyed);
  destroy(writer);
}

const char* tetstream_writer_note(const tetstream_writer* writer, int32_t index) {
  return writer && writer->output ? writer->output->note(index) : nullptr;
}

const char* tetstream_writer_message(const tetstream_writer* writer) {
  return messageOf(writer);
}
