#include "tets_places.h"

#include "status.h"
#include "tets_codec.h"
#include "tets_input.h"

namespace tetstream::tets {
namespace {

class Places final : public Source {
 public:
  Places(std::unique_ptr<ByteSource> bytes, const ChunkRange* range)
      : in_(std::move(bytes)), stored_(readHeader(in_)), shape_(stored_), unpacked_(account_) {
    completeFromEnd(in_.bytes(), stored_);
    schema_ = stored_;
    schema_.fields.clear();
    schema_.cell_data.clear();
    schema_.label_names.clear();
    for (std::vector<double>* corner : {&schema_.box_min, &schema_.box_max})
      if (!corner->empty()) corner->resize(schema_.boxSize());
    if (!range) return;
    in_.goTo(range->offset, range->first);
    seen_ = range->vertices;
    end_chunk_ = range->end;
  }
  const Schema& schema() const override { return schema_; }

  bool next(BatchView& batch) override {
    batch = BatchView{};
    while (!ended_ && in_.chunks() != end_chunk_) {
      const SectionHead& head = in_.next();
      ended_ = head.is(kEnd);
      if (!head.is(kChunk)) {
        in_.skipBody();
      } else if (readChunk()) {
        batch.first_vertex = seen_;
        batch.vertex_count = shape_[shape_.positions()].rows;
        batch.positions = positions_;
        seen_ += batch.vertex_count;
        return true;
      }
    }
    return false;
  }

 private:
  // False where it has no vertices.
  bool readChunk() {
    const uint32_t codec = setShape(in_, stored_, shape_);
    const unsigned char* const columns = in_.body() + chunkStartBytes(stored_);
    const size_t bytes = shape_[shape_.positions()].bytes;
    positions_ = columns;
    if (codec == kCodecZstd) {
      if (unpacked_.size() < bytes) unpacked_.resize(bytes);
      if (!codec_.decompressFirst(shape_, columns, in_.head().value, unpacked_.data()))
        fail(Status::kBadData, "%s: its columns cannot be decompressed", in_.place().c_str());
      positions_ = unpacked_.data();
    }
    in_.countChunk();
    return bytes > 0;
  }

  SectionReader in_;
  Schema stored_, schema_;  // of the file; of what is handed out
  ChunkShape shape_;
  Codec codec_;
  Account account_;
  Array<unsigned char> unpacked_;
  const unsigned char* positions_ = nullptr;
  uint64_t seen_ = 0, end_chunk_ = ChunkRange().end;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<Source> openPlaces(std::unique_ptr<ByteSource> bytes, const ChunkRange* range) {
  return std::make_unique<Places>(std::move(bytes), range);
}

}  // namespace tetstream::tets
