// swig: what a stream carries, and its batches, with checks that keep a language's arrays from
// being read beyond their ends.
#pragma once

#include <tetstream/tetstream.h>

#include <deque>
#include <string>
#include <vector>

#include "arrays.h"

namespace tetstream::swig {

// tetstream_stream_info with the arrays that it points to.
class StreamInfo {
 public:
  StreamInfo() = default;
  explicit StreamInfo(const tetstream_stream_info& info);
  StreamInfo(const StreamInfo& other) : StreamInfo(other.info()) {}
  StreamInfo& operator=(const StreamInfo&) = delete;

  void addField(const char* name, int32_t components, int32_t type);
  void addCellData(const char* name, int32_t components, int32_t type);
  // Of a label of that cell array, or, where it is null or empty, of faces.
  void addLabelName(const char* cell_array, int64_t label, const char* name);
  int32_t fieldCount() const { return static_cast<int32_t>(fields_.size()); }
  int32_t cellDataCount() const { return static_cast<int32_t>(cell_data_.size()); }
  const char* fieldName(int32_t index) const { return field(index).name; }
  int32_t fieldComponents(int32_t index) const { return field(index).components; }
  int32_t fieldType(int32_t index) const { return field(index).type; }
  const char* cellDataName(int32_t index) const { return cellData(index).name; }
  int32_t cellDataComponents(int32_t index) const { return cellData(index).components; }
  int32_t cellDataType(int32_t index) const { return cellData(index).type; }
  int64_t labelNameCount() const { return static_cast<int64_t>(label_names_.size()); }
  const char* labelNameCellArray(int64_t index) const;  // "": faces
  int64_t labelNameLabel(int64_t index) const { return labelName(index).label; }
  const char* labelNameText(int64_t index) const { return labelName(index).name; }
  // Of the next of x y z and each component of each field; all are to be told, or none.
  void addBound(double low, double high);
  // x y z and each component of each field; no array where it is not known.
  ArrayView boxMin() const { return view(box_min_); }
  ArrayView boxMax() const { return view(box_max_); }

  int32_t position_type = TETSTREAM_TYPE_FLOAT64;
  bool is_indexed = false, is_timed = false;
  int64_t vertex_count = -1, cell_count = -1, face_count = -1;
  int64_t front_width = -1, front_span = -1, front_cells = -1;
  double time = 0;  // of the values, where it is timed

  const tetstream_column& field(int32_t index) const;
  const tetstream_column& cellData(int32_t index) const;
  // Its pointers live as long as this is not changed.
  tetstream_stream_info info() const;

 private:
  static ArrayView view(const std::vector<double>& box);
  size_t boxSize() const;
  void add(std::vector<tetstream_column>& columns, const char* name, int32_t components,
           int32_t type);
  const tetstream_label_name& labelName(int64_t index) const;

  std::deque<std::string> names_;  // stay where they are
  std::vector<tetstream_column> fields_, cell_data_;
  std::vector<tetstream_label_name> label_names_;
  std::vector<double> box_min_, box_max_;
};

}  // namespace tetstream::swig
