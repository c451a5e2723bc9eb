#include <algorithm>

#include "commands.h"
#include "json.h"
#include "text.h"

namespace tetstream::cli {

namespace {

using FaceLabels = std::vector<tetstream_face_label_info>;

FaceLabels faceLabelsOf(tetstream_reader* reader) {
  FaceLabels labels;
  tetstream_face_label_info label = {sizeof label, 0, 0};
  for (int32_t i = 0; tetstream_reader_get_face_label(reader, i, &label) == TETSTREAM_OK; ++i)
    labels.push_back(label);
  return labels;
}

// Bounds of `count` numbers of the box, from `first`; none if the box is not known.
struct Bounds {
  const double *low = nullptr, *high = nullptr;
  int32_t count = 0;
};

Bounds boundsAt(const tetstream_stream_info& info, int32_t first, int32_t count) {
  if (!info.box_min || !info.box_max) return {};
  return {info.box_min + first, info.box_max + first, count};
}

std::string boundsText(const Bounds& bounds) {
  std::string text;
  for (int32_t i = 0; i < bounds.count; ++i) {
    if (i > 0) text += ", ";
    text += bounds.low[i] <= bounds.high[i] ? textOf("%.9g .. %.9g", bounds.low[i], bounds.high[i])
                                            : "nothing finite";
  }
  return bounds.count == 0 ? "unknown" : text;
}

std::string columnText(const tetstream_column& column) {
  return textOf("%s, %d x %s", oneLine(column.name).c_str(), static_cast<int>(column.components),
                typeName(column.type).data());
}

std::string frontText(const tetstream_front_info& front) {
  return row("front width", countText(front.width) + " vertices" +
                                textOf(", %.4g in the mean", front.mean_width)) +
         row("front span",
             countText(front.span) + " vertices" + textOf(", %.4g in the mean", front.mean_span)) +
         row("front cells", countText(front.cells)) +
         row("lifetimes", textOf("%.4g cells a vertex in the mean, ", front.mean_life) +
                              countText(front.longest_life) + " at most") +
         row("window", countText(front.window_cells) + " cells for a simplification");
}

std::string faceNameText(const tetstream_stream_info& info, int64_t label) {
  for (int64_t i = 0; i < info.label_name_count; ++i)
    if (!info.label_names[i].cell_array && info.label_names[i].label == label)
      return ", " + oneLine(info.label_names[i].name);
  return "";
}

std::string faceLabelsText(const tetstream_stream_info& info, const FaceLabels& labels) {
  std::string text;
  for (size_t i = 0; i < std::min(kMostListed, labels.size()); ++i)
    text += row("face label", textOf("%lld, ", static_cast<long long>(labels[i].label)) +
                                  countText(labels[i].faces) + " faces" +
                                  faceNameText(info, labels[i].label));
  if (labels.size() > kMostListed)
    text +=
        row("face label", textOf("and %zu more, which --json tells", labels.size() - kMostListed));
  return text;
}

// Of the labels of one cell array.
std::string labelNamesText(const tetstream_stream_info& info, const char* cell_array) {
  std::string text;
  size_t count = 0;
  for (int64_t i = 0; i < info.label_name_count; ++i) {
    const tetstream_label_name& name = info.label_names[i];
    if (!name.cell_array || std::string_view(name.cell_array) != cell_array) continue;
    if (++count <= kMostListed)
      text += row("cell label",
                  textOf("%lld, ", static_cast<long long>(name.label)) + oneLine(name.name));
  }
  if (count > kMostListed)
    text += row("cell label", textOf("and %zu more, which --json tells", count - kMostListed));
  return text;
}

std::string infoText(const tetstream_stream_info& info, const FaceLabels& labels,
                     const tetstream_front_info& front) {
  const bool indexed = (info.flags & TETSTREAM_STREAM_INDEXED) != 0;
  std::string text =
      row("kind", indexed ? "indexed mesh; the front is that of its order here" : "mesh stream") +
      row("vertices", countText(info.vertex_count)) + row("cells", countText(info.cell_count)) +
      row("positions", std::string(typeName(info.position_type))) +
      row("box", boundsText(boundsAt(info, 0, 3)));
  if (info.flags & TETSTREAM_STREAM_TIMED) text += row("time", textOf("%.9g", info.time));
  int32_t first = 3;
  for (int32_t i = 0; i < info.field_count; ++i) {
    const tetstream_column& field = info.fields[i];
    text += row("field",
                columnText(field) + ", " + boundsText(boundsAt(info, first, field.components)));
    first += field.components;
  }
  for (int32_t i = 0; i < info.cell_data_count; ++i)
    text += row("cell array", columnText(info.cell_data[i])) +
            labelNamesText(info, info.cell_data[i].name);
  if (info.face_count > 0) text += row("faces", countText(info.face_count) + ", labelled");
  return text + faceLabelsText(info, labels) + frontText(front);
}

void addColumn(JsonText& json, const tetstream_column& column) {
  json.key("name").value(std::string_view(column.name));
  json.key("components").value(column.components);
  json.key("type").value(typeName(column.type));
}

// A count that is not known is null.
void addCount(JsonText& json, const char* name, int64_t count) {
  json.key(name);
  if (count < 0)
    json.null();
  else
    json.value(count);
}

void addFields(JsonText& json, const tetstream_stream_info& info) {
  json.key("fields").open('[');
  int32_t first = 3;
  for (int32_t i = 0; i < info.field_count; ++i) {
    const tetstream_column& field = info.fields[i];
    const Bounds bounds = boundsAt(info, first, field.components);
    json.open('{');
    addColumn(json, field);
    json.key("min").values(bounds.low, field.components);
    json.key("max").values(bounds.high, field.components);
    json.close('}');
    first += field.components;
  }
  json.close(']');
}

void addLabelNames(JsonText& json, const tetstream_stream_info& info) {
  json.key("label_names").open('[');
  for (int64_t i = 0; i < info.label_name_count; ++i) {
    const tetstream_label_name& name = info.label_names[i];
    json.open('{');
    json.key("cell_array");
    if (name.cell_array)
      json.value(std::string_view(name.cell_array));
    else
      json.null();
    json.key("label").value(name.label);
    json.key("name").value(std::string_view(name.name));
    json.close('}');
  }
  json.close(']');
}

std::string infoJson(const Arguments& arguments, const tetstream_stream_info& info,
                     const FaceLabels& labels, const tetstream_front_info& front,
                     const std::vector<std::string>& notes) {
  JsonText json;
  json.open('{');
  json.key("file").value(std::string_view(arguments.in.path));
  json.key("indexed").value((info.flags & TETSTREAM_STREAM_INDEXED) != 0);
  addCount(json, "vertices", info.vertex_count);
  addCount(json, "cells", info.cell_count);
  json.key("position_type").value(typeName(info.position_type));
  json.key("box_min").values(info.box_min, 3);
  json.key("box_max").values(info.box_max, 3);
  json.key("time");
  if (info.flags & TETSTREAM_STREAM_TIMED)
    json.value(info.time);
  else
    json.null();
  addFields(json, info);
  json.key("cell_arrays").open('[');
  for (int32_t i = 0; i < info.cell_data_count; ++i) {
    json.open('{');
    addColumn(json, info.cell_data[i]);
    json.close('}');
  }
  json.close(']');
  addCount(json, "faces", info.face_count);
  json.key("face_labels").open('[');
  for (const tetstream_face_label_info& label : labels) {
    json.open('{');
    json.key("label").value(label.label);
    json.key("faces").value(label.faces);
    json.close('}');
  }
  json.close(']');
  addLabelNames(json, info);
  addCount(json, "front_width", info.front_width);
  addCount(json, "front_span", info.front_span);
  addCount(json, "front_cells", info.front_cells);
  json.key("mean_width").value(front.mean_width);
  json.key("mean_span").value(front.mean_span);
  json.key("mean_life").value(front.mean_life);
  json.key("longest_life").value(front.longest_life);
  json.key("window_cells").value(front.window_cells);
  json.key("notes").values(notes);
  return json.close('}').take();
}

}  // namespace

ExitCode info(const Arguments& arguments) {
  const Options options = makeOptions(arguments.options);
  ProgressBar bar(progressOf(arguments));
  const Reader reader = openReader(arguments.in, options, bar);
  tetstream_stream_info found = {};
  found.struct_size = sizeof found;
  const tetstream_status status =
      tetstream_inspect(reader.get(), options.get(), ProgressBar::callback, &bar, &found);
  bar.clear();
  const auto notes = printNotes(arguments, reader.get(), nullptr);
  check(status, reader.get());
  tetstream_front_info front = {};
  front.struct_size = sizeof front;
  check(tetstream_reader_get_front(reader.get(), &front), reader.get());
  const FaceLabels labels = faceLabelsOf(reader.get());
  printOut(arguments.report == "json" ? infoJson(arguments, found, labels, front, notes)
                                      : infoText(found, labels, front));
  return exitCodeOf(status);
}

}  // namespace tetstream::cli
