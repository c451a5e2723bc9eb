#include "callbacks.h"

namespace tetstream {

// -------------------------------------------------------------------------------------- reader

CallbackSource::CallbackSource(const tetstream_reader_callbacks& callbacks)
    : callbacks_(callbacks) {
  needPlace(reinterpret_cast<const void*>(callbacks_.open), "the callback open");
  needPlace(reinterpret_cast<const void*>(callbacks_.next), "the callback next");
}

CallbackSource::~CallbackSource() {
  if (opened_) closeQuietly(callbacks_.close, callbacks_.user);
}

void CallbackSource::open() {
  opened_ = true;
  tetstream_stream_info info = {};
  info.struct_size = sizeof info;
  info.vertex_count = info.cell_count = -1;
  info.front_width = info.front_span = info.front_cells = -1;
  callBack("reader", "open", [&] { return callbacks_.open(callbacks_.user, &info); });
  schema_ = schemaOf(info);
  indexed_ = (info.flags & TETSTREAM_STREAM_INDEXED) != 0;
  checker_.emplace(schema_);
}

bool CallbackSource::next(BatchView& batch) {
  if (ended_) return false;
  tetstream_batch filled = {};
  filled.struct_size = sizeof filled;
  callBack("reader", "next", [&] { return callbacks_.next(callbacks_.user, &filled); });
  batch = checker_->view(filled);
  ended_ = batch.isEmpty();
  return !ended_;
}

// -------------------------------------------------------------------------------------- writer

void CallbackSink::begin(const Schema& schema) {
  const PublicSchema shown(schema, false);
  taker_.open(&shown.info());
}

void CallbackSink::put(const BatchView& batch) {
  taker_.put(publicBatch(batch));
}

}  // namespace tetstream
