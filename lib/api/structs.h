// api: the public structs: their sizes, and how they become schemas and batches and back.
// Depends on tetstream.h, batch.h.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "batch.h"
#include "guard.h"

namespace tetstream {

// The size of each struct when it was first published: what a caller must bring at least. Members
// that came later are missing in old programs and count as NULL or 0.
template <class T>
constexpr size_t kFirstSize = 0;
#define TETSTREAM_FIRST_SIZE(T, last_member) \
  template <>                                \
  inline constexpr size_t kFirstSize<T> = offsetof(T, last_member) + sizeof(T::last_member)
TETSTREAM_FIRST_SIZE(tetstream_option_info, choices);
TETSTREAM_FIRST_SIZE(tetstream_pool_callbacks, submit);
TETSTREAM_FIRST_SIZE(tetstream_stream_info, box_max);
TETSTREAM_FIRST_SIZE(tetstream_batch, finalized);
TETSTREAM_FIRST_SIZE(tetstream_reader_callbacks, close);
TETSTREAM_FIRST_SIZE(tetstream_writer_callbacks, close);
TETSTREAM_FIRST_SIZE(tetstream_map_callbacks, close);
TETSTREAM_FIRST_SIZE(tetstream_log_callbacks, close);
TETSTREAM_FIRST_SIZE(tetstream_report, limited_by);
TETSTREAM_FIRST_SIZE(tetstream_layout_report, seconds);
TETSTREAM_FIRST_SIZE(tetstream_front_info, window_cells);
TETSTREAM_FIRST_SIZE(tetstream_diagram_info, newest);
TETSTREAM_FIRST_SIZE(tetstream_comparison_info, peak_bytes);
TETSTREAM_FIRST_SIZE(tetstream_mesh_figures, largest_aspect);
TETSTREAM_FIRST_SIZE(tetstream_field_comparison, rms_percent);
TETSTREAM_FIRST_SIZE(tetstream_region_comparison, simplified_parts);
TETSTREAM_FIRST_SIZE(tetstream_face_label_info, faces);
TETSTREAM_FIRST_SIZE(tetstream_face_label_comparison, simplified_area);
#undef TETSTREAM_FIRST_SIZE

[[noreturn]] void failStruct(const char* argument, size_t size, size_t needed);

// Throws kBadArgument unless *in is a struct that can be read or filled.
template <class T>
void checkStruct(const T* in, const char* argument) {
  static_assert(kFirstSize<T> != 0);
  needPlace(in, argument);
  if (in->struct_size < kFirstSize<T>) failStruct(argument, in->struct_size, kFirstSize<T>);
}

// What the caller's struct covers of ours; the rest is zero.
template <class T>
T readStruct(const T* in, const char* argument) {
  checkStruct(in, argument);
  T out = {};
  std::memcpy(&out, in, in->struct_size < sizeof(T) ? in->struct_size : sizeof(T));
  return out;
}

// Fills what the caller's struct covers; its struct_size stays. *out was checked before.
template <class T>
void writeStruct(T* out, T value) {
  value.struct_size = out->struct_size;
  std::memcpy(out, &value, out->struct_size < sizeof(T) ? out->struct_size : sizeof(T));
}

// A time is told only with the place that it has.
void writeStruct(tetstream_stream_info* out, tetstream_stream_info value);

// Throw kBadArgument. A count of 0 beforehand is taken as not known.
Schema schemaOf(const tetstream_stream_info& info);

// A schema as the public struct, with the arrays that it points to.
class PublicSchema {
 public:
  PublicSchema(const Schema& schema, bool indexed);
  PublicSchema(const PublicSchema&) = delete;
  PublicSchema& operator=(const PublicSchema&) = delete;
  const tetstream_stream_info& info() const { return info_; }

 private:
  Schema schema_;
  std::vector<tetstream_column> fields_, cell_data_;
  std::vector<tetstream_label_name> label_names_;
  tetstream_stream_info info_ = {};
};

// Checks the caller's batches of one stream and gives them their place in it. Throws kBadData,
// naming the batch: counts below 0, missing arrays, bits of last_uses that mean nothing. What the
// numbers mean is checked by those who use them.
class BatchChecker {
 public:
  explicit BatchChecker(const Schema& schema)
      : fields_(schema.fields.size()), cell_data_(schema.cell_data.size()) {}
  // Borrows the batch's arrays.
  BatchView view(const tetstream_batch& batch);
  // The same for a whole mesh, whose cells may be in cells32: the view has none then.
  BatchView viewMesh(const tetstream_batch& batch);

 private:
  size_t fields_, cell_data_;
  uint64_t batches_ = 0, vertices_ = 0;
};

tetstream_batch publicBatch(const BatchView& view);

}  // namespace tetstream
