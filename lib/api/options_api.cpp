// api: options of the public header.
#include "caller_workers.h"
#include "handles.h"

using namespace tetstream;

int32_t tetstream_option_count(void) {
  return optionCount();
}

tetstream_status tetstream_option_at(int32_t index, tetstream_option_info* info) {
  return guard([&] {
    checkStruct(info, "info");
    const OptionRow& row = optionRow(index);
    tetstream_option_info out = {};
    out.id = row.id;
    out.type = row.type;
    out.name = row.name;
    out.text = row.text;
    out.minimum = row.minimum;
    out.maximum = row.maximum;
    out.default_text = row.default_text;
    out.choices = row.choices;
    out.scope = row.scope;
    out.lowest = row.lowest;
    out.highest = row.highest;
    writeStruct(info, out);
  });
}

tetstream_status tetstream_options_create(tetstream_options** options) {
  return guardCreate(__func__, options, [](tetstream_options& o) { o.values.emplace(); });
}

void tetstream_options_destroy(tetstream_options* options) {
  destroy(options);
}

tetstream_status tetstream_options_set_int64(tetstream_options* options, int32_t id,
                                             int64_t value) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    o.values->setInt64(id, value);
  });
}

tetstream_status tetstream_options_set_double(tetstream_options* options, int32_t id,
                                              double value) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    o.values->setDouble(id, value);
  });
}

tetstream_status tetstream_options_set_text(tetstream_options* options, int32_t id,
                                            const char* value) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    needPlace(value, "value");
    o.values->setText(id, value);
  });
}

tetstream_status tetstream_options_parse(tetstream_options* options, const char* name,
                                         const char* value) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    needPlace(name, "name");
    needPlace(value, "value");
    o.values->parse(name, value);
  });
}

tetstream_status tetstream_options_get_int64(const tetstream_options* options, int32_t id,
                                             int64_t* value) {
  return guard(__func__, options, [&](const tetstream_options& o) {
    needState(o, State::kReady);
    needPlace(value, "value");
    *value = o.values->getInt64(id);
  });
}

tetstream_status tetstream_options_get_double(const tetstream_options* options, int32_t id,
                                              double* value) {
  return guard(__func__, options, [&](const tetstream_options& o) {
    needState(o, State::kReady);
    needPlace(value, "value");
    *value = o.values->getDouble(id);
  });
}

tetstream_status tetstream_options_get_text(const tetstream_options* options, int32_t id,
                                            const char** value) {
  return guard(__func__, options, [&](const tetstream_options& o) {
    needState(o, State::kReady);
    needPlace(value, "value");
    *value = o.values->getText(id);
  });
}

tetstream_status tetstream_options_add_field(tetstream_options* options, const char* name,
                                             double weight) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    needPlace(name, "name");
    o.values->addField(name, weight);
  });
}

tetstream_status tetstream_options_set_pool(tetstream_options* options,
                                            const tetstream_pool_callbacks* pool) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    o.values->setWorkers(pool ? callerWorkers(readStruct(pool, "pool")) : nullptr);
  });
}

tetstream_status tetstream_options_set_progress(tetstream_options* options,
                                                tetstream_progress_callback progress, void* user) {
  return guard(__func__, options, [&](tetstream_options& o) {
    needState(o, State::kReady);
    o.values->setProgress(progressOf(progress, user));
  });
}

const char* tetstream_options_message(const tetstream_options* options) {
  return messageOf(options);
}
