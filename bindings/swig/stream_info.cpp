#include "stream_info.h"

#include "failure.h"

namespace tetstream::swig {

StreamInfo::StreamInfo(const tetstream_stream_info& info)
    : position_type(info.position_type),
      is_indexed((info.flags & TETSTREAM_STREAM_INDEXED) != 0),
      is_timed((info.flags & TETSTREAM_STREAM_TIMED) != 0),
      vertex_count(info.vertex_count),
      cell_count(info.cell_count),
      face_count(info.face_count),
      front_width(info.front_width),
      front_span(info.front_span),
      front_cells(info.front_cells),
      time(info.time) {
  for (int32_t i = 0; i < info.field_count; ++i) {
    const tetstream_column& c = info.fields[i];
    addField(c.name, c.components, c.type);
  }
  for (int32_t i = 0; i < info.cell_data_count; ++i) {
    const tetstream_column& c = info.cell_data[i];
    addCellData(c.name, c.components, c.type);
  }
  for (int64_t i = 0; i < info.label_name_count; ++i) {
    const tetstream_label_name& n = info.label_names[i];
    addLabelName(n.cell_array, n.label, n.name);
  }
  if (info.box_min) box_min_.assign(info.box_min, info.box_min + boxSize());
  if (info.box_max) box_max_.assign(info.box_max, info.box_max + boxSize());
}

void StreamInfo::add(std::vector<tetstream_column>& columns, const char* name, int32_t components,
                     int32_t type) {
  if (!name) failArgument("an array has no name");
  columns.push_back({names_.emplace_back(name).c_str(), components, type});
}

void StreamInfo::addField(const char* name, int32_t components, int32_t type) {
  add(fields_, name, components, type);
}

void StreamInfo::addCellData(const char* name, int32_t components, int32_t type) {
  add(cell_data_, name, components, type);
}

void StreamInfo::addLabelName(const char* cell_array, int64_t label, const char* name) {
  if (!name) failArgument("a label's name is none");
  const bool is_of_cells = cell_array && *cell_array;
  label_names_.push_back({names_.emplace_back(name).c_str(),
                          is_of_cells ? names_.emplace_back(cell_array).c_str() : nullptr, label});
}

static const tetstream_column& columnAt(const std::vector<tetstream_column>& columns,
                                        int32_t index) {
  if (index < 0 || static_cast<size_t>(index) >= columns.size())
    failArgument("there is no array " + std::to_string(index));
  return columns[static_cast<size_t>(index)];
}

const tetstream_column& StreamInfo::field(int32_t index) const {
  return columnAt(fields_, index);
}

const tetstream_column& StreamInfo::cellData(int32_t index) const {
  return columnAt(cell_data_, index);
}

const tetstream_label_name& StreamInfo::labelName(int64_t index) const {
  if (index < 0 || index >= labelNameCount())
    failArgument("there is no name of a label " + std::to_string(index));
  return label_names_[static_cast<size_t>(index)];
}

const char* StreamInfo::labelNameCellArray(int64_t index) const {
  const char* const cell_array = labelName(index).cell_array;
  return cell_array ? cell_array : "";
}

ArrayView StreamInfo::view(const std::vector<double>& box) {
  if (box.empty()) return {};
  return {box.data(), TETSTREAM_TYPE_FLOAT64, static_cast<int64_t>(box.size()), 1};
}

size_t StreamInfo::boxSize() const {
  size_t size = 3;
  for (const tetstream_column& c : fields_) size += static_cast<size_t>(c.components);
  return size;
}

void StreamInfo::addBound(double low, double high) {
  box_min_.push_back(low);
  box_max_.push_back(high);
}

tetstream_stream_info StreamInfo::info() const {
  if (!box_min_.empty() && box_min_.size() != boxSize())
    failArgument("the box has " + std::to_string(box_min_.size()) + " bounds, " +
                 std::to_string(boxSize()) + " are wanted");
  tetstream_stream_info out = {};
  out.struct_size = sizeof out;
  out.position_type = position_type;
  out.flags = (is_indexed ? TETSTREAM_STREAM_INDEXED : 0) | (is_timed ? TETSTREAM_STREAM_TIMED : 0);
  out.field_count = fieldCount();
  out.cell_data_count = cellDataCount();
  out.fields = fields_.data();
  out.cell_data = cell_data_.data();
  out.vertex_count = vertex_count;
  out.cell_count = cell_count;
  out.face_count = face_count;
  out.front_width = front_width;
  out.front_span = front_span;
  out.front_cells = front_cells;
  out.box_min = box_min_.empty() ? nullptr : box_min_.data();
  out.box_max = box_max_.empty() ? nullptr : box_max_.data();
  out.label_name_count = labelNameCount();
  out.label_names = label_names_.data();
  out.time = time;
  return out;
}

}  // namespace tetstream::swig
