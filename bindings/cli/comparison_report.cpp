#include "comparison_report.h"

#include <algorithm>
#include <cmath>

#include "failure.h"
#include "json.h"
#include "text.h"

namespace tetstream::cli {

ComparisonFigures figuresOf(const tetstream_comparison* comparison) {
  ComparisonFigures f = {};
  f.info.struct_size = sizeof f.info;
  f.original.struct_size = f.simplified.struct_size = sizeof f.original;
  check(tetstream_comparison_get_info(comparison, &f.info), comparison);
  check(tetstream_comparison_get_mesh(comparison, TETSTREAM_ORIGINAL, &f.original), comparison);
  check(tetstream_comparison_get_mesh(comparison, TETSTREAM_SIMPLIFIED, &f.simplified), comparison);
  f.fields.resize(static_cast<size_t>(f.info.field_count));
  f.regions.resize(static_cast<size_t>(f.info.region_count));
  for (int32_t i = 0; i < f.info.field_count; ++i) {
    tetstream_field_comparison& field = f.fields[static_cast<size_t>(i)];
    field.struct_size = sizeof field;
    check(tetstream_comparison_get_field(comparison, i, &field), comparison);
  }
  for (int32_t i = 0; i < f.info.region_count; ++i) {
    tetstream_region_comparison& region = f.regions[static_cast<size_t>(i)];
    region.struct_size = sizeof region;
    check(tetstream_comparison_get_region(comparison, i, &region), comparison);
  }
  f.face_labels.resize(static_cast<size_t>(f.info.face_label_count));
  for (int32_t i = 0; i < f.info.face_label_count; ++i) {
    tetstream_face_label_comparison& label = f.face_labels[static_cast<size_t>(i)];
    label.struct_size = sizeof label;
    check(tetstream_comparison_get_face_label(comparison, i, &label), comparison);
  }
  return f;
}

// ---------------------------------------------------------------------------------- for people

namespace {

std::string number(double value, const char* format = "%.6g") {
  if (std::isinf(value)) return value < 0 ? "-infinite" : "infinite";
  return textOf(format, value);
}

std::string short3(double value) {
  return number(value, "%.3g");
}

double percentOf(double part, double whole) {
  return whole > 0 ? 100 * part / whole : 0;
}

// Of sums over all cells, which are rounded.
std::string changeText(double from, double to) {
  constexpr double kRounding = 1e-10;
  const double percent = percentOf(to - from, from);
  return std::fabs(percent) < kRounding ? "0 %" : textOf("%+.3g %%", percent);
}

std::string placeText(const double place[3]) {
  return textOf("(%.6g, %.6g, %.6g)", place[0], place[1], place[2]);
}

constexpr size_t kNameWidth = 24;

// A line of the table of both meshes.
std::string both(const char* name, const std::string& a, const std::string& b,
                 const std::string& note = "", size_t width = kNameWidth) {
  std::string line = textOf("  %-*s%16s%16s", static_cast<int>(width), name, a.c_str(), b.c_str());
  if (!note.empty()) line += "   " + note;
  return line + "\n";
}

std::string count(const char* name, int64_t a, int64_t b) {
  return both(name, std::to_string(a), std::to_string(b), a == b ? "" : "changed");
}

// What should not become more.
std::string faults(const char* name, int64_t a, int64_t b) {
  return both(name, countText(a), countText(b), b > a ? "more" : "");
}

std::string meshesText(const tetstream_mesh_figures& a, const tetstream_mesh_figures& b) {
  const auto share = [](int64_t x, int64_t y) {
    return short3(percentOf(static_cast<double>(y), static_cast<double>(x))) + " % kept";
  };
  return textOf("%-26s%16s%16s\n", "meshes", "original", "simplified") +
         both("cells", countText(a.cells), countText(b.cells), share(a.cells, b.cells)) +
         both("vertices", countText(a.vertices), countText(b.vertices),
              share(a.vertices, b.vertices)) +
         both("volume", number(a.volume), number(b.volume), changeText(a.volume, b.volume)) +
         both("boundary area", number(a.boundary_area), number(b.boundary_area),
              changeText(a.boundary_area, b.boundary_area));
}

std::string cpsnrText(double cpsnr) {
  return std::isnan(cpsnr) ? "none" : short3(cpsnr);
}

// The names in a text, one a line.
std::vector<std::string> linesIn(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string leftOutText(const char* why, const std::vector<std::string>& names) {
  constexpr size_t kNamed = 6;
  if (names.empty()) return "";
  std::string text = textOf("  left out, %s: ", why);
  for (size_t i = 0; i < std::min(kNamed, names.size()); ++i)
    text += (i > 0 ? ", " : "") + oneLine(names[i]);
  if (names.size() > kNamed) text += textOf(" and %zu more", names.size() - kNamed);
  return text + "\n";
}

// What both meshes have, and is left out, differs in its components.
std::string leftOutText(const tetstream_comparison_info& info) {
  std::vector<std::string> lists[2] = {linesIn(info.only_original), linesIn(info.only_simplified)};
  std::vector<std::string> both;
  for (const std::string& name : lists[0])
    if (std::erase(lists[1], name) > 0) both.push_back(name);
  for (const std::string& name : both) std::erase(lists[0], name);
  return leftOutText("only in the original", lists[0]) +
         leftOutText("only in the simplified mesh", lists[1]) +
         leftOutText("with other components in the simplified mesh", both);
}

std::string fieldLine(const tetstream_field_comparison& f, size_t width) {
  if (std::isnan(f.range))
    return textOf("  %-*s  has values that are not finite\n", static_cast<int>(width),
                  oneLine(f.name).c_str());
  return textOf("  %-*s%12s%12s%10s%12s%12s%10s\n", static_cast<int>(width),
                oneLine(f.name).c_str(), short3(f.rms_percent).c_str(),
                short3(f.largest_percent).c_str(), cpsnrText(f.cpsnr).c_str(),
                short3(f.rms).c_str(), short3(f.largest).c_str(), short3(f.range).c_str());
}

bool isPart(const ComparisonFigures& f) {
  return f.info.compared_cells < f.original.cells;
}

std::string partText(const ComparisonFigures& f) {
  if (!isPart(f)) return "";
  return "fields and boundaries are those of a part of " + countText(f.info.compared_cells) +
         " original cells, " + short3(percentOf(f.info.compared_volume, f.original.volume)) +
         " % of the volume\n\n";
}

std::string fieldsText(const ComparisonFigures& f) {
  const std::string how =
      f.info.is_exact ? "exact" : "by " + shortCount(static_cast<double>(f.info.samples));
  const std::string left_out = leftOutText(f.info);
  if (f.fields.empty()) return "fields\n  none that both meshes have\n" + left_out;
  size_t width = 14;
  for (const auto& field : f.fields) width = std::max(width, oneLine(field.name).size() + 2);
  std::string text =
      textOf("%-*s%12s%12s%10s%12s%12s%10s\n", static_cast<int>(width + 2),
             ("fields, " + how).c_str(), "RMS %", "largest %", "CPSNR", "RMS", "largest", "range");
  for (const auto& field : f.fields) text += fieldLine(field, width);
  for (const auto& field : f.fields)
    if (field.largest > 0)
      text +=
          "  largest of " + oneLine(field.name) + " at " + placeText(field.largest_place) +
          (field.largest > field.largest_inside
               ? ", outside; inside " +
                     short3(percentOf(field.largest_inside, field.range > 0 ? field.range : 1)) +
                     " %"
               : "") +
          "\n";
  return text + left_out;
}

std::string boundaryText(const ComparisonFigures& f) {
  const tetstream_comparison_info& i = f.info;
  const auto line = [&](const char* name, double largest, double rms, const double place[3]) {
    if (std::isnan(largest))
      return textOf("  %-24s%12s\n", name, isPart(f) ? "none in the box" : "none");
    return textOf("  %-24s%12s%12s%12s%12s   at %s\n", name,
                  short3(percentOf(largest, i.diagonal)).c_str(),
                  short3(percentOf(rms, i.diagonal)).c_str(), short3(largest).c_str(),
                  short3(rms).c_str(), placeText(place).c_str());
  };
  const double outside = percentOf(i.outside_volume, i.compared_volume);
  std::string text =
      textOf("%-26s%12s%12s%12s%12s\n", "boundary", "largest %", "RMS %", "largest", "RMS") +
      line("original to simplified", i.distance, i.rms_distance, i.distance_place) +
      line("simplified to original", i.distance_back, i.rms_distance_back, i.distance_back_place) +
      "  in percent of the diagonal, " + short3(i.diagonal) + ", by about " +
      std::to_string(i.boundary_samples) + " points and all vertices\n" +
      "  outside the simplified mesh: " + short3(outside) + " % of the " +
      (isPart(f) ? "part's" : "original's") + " volume\n";
  if (i.repeated_volume > 1e-9 * i.compared_volume)
    text += "  in more than one simplified cell: " +
            short3(percentOf(i.repeated_volume, i.compared_volume)) + " %\n";
  return text;
}

std::string topologyText(const ComparisonFigures& f) {
  const tetstream_mesh_figures &a = f.original, &b = f.simplified;
  return std::string("topology: ") + (f.info.topology_kept ? "kept" : "CHANGED") + "\n" +
         count("components", a.components, b.components) +
         count("Euler characteristic", a.euler, b.euler) +
         count("boundary components", a.boundary_components, b.boundary_components) +
         count("boundary Euler", a.boundary_euler, b.boundary_euler) +
         count("non-manifold faces", a.nonmanifold_faces, b.nonmanifold_faces) +
         count("non-manifold edges", a.nonmanifold_edges, b.nonmanifold_edges) +
         count("non-manifold vertices", a.nonmanifold_vertices, b.nonmanifold_vertices);
}

std::string shapesText(const tetstream_mesh_figures& a, const tetstream_mesh_figures& b) {
  const auto line = [](const char* name, double x, double y, const char* unit) {
    return both(name, short3(x) + unit, short3(y) + unit);
  };
  return "shapes\n" + line("least dihedral angle", a.least_angle, b.least_angle, " deg") +
         line("mean of the least", a.mean_least_angle, b.mean_least_angle, " deg") +
         line("cells below 1 deg", 100 * a.share_below_1, 100 * b.share_below_1, " %") +
         line("cells below 5 deg", 100 * a.share_below_5, 100 * b.share_below_5, " %") +
         line("cells below 10 deg", 100 * a.share_below_10, 100 * b.share_below_10, " %") +
         line("aspect, median", a.median_aspect, b.median_aspect, "") +
         line("aspect of 99 %", a.p99_aspect, b.p99_aspect, "") +
         line("aspect, largest", a.largest_aspect, b.largest_aspect, "") +
         faults("inverted cells", a.inverted_cells, b.inverted_cells) +
         faults("flat cells", a.flat_cells, b.flat_cells) +
         faults("folded faces", a.folded_faces, b.folded_faces) +
         faults("duplicate cells", a.duplicate_cells, b.duplicate_cells);
}

// What a line tells of a label, with its name.
template <class Row>
std::string labelText(const char* what, const Row& row) {
  std::string text = textOf("%s of %lld", what, static_cast<long long>(row.label));
  return *row.name ? text + ", " + oneLine(row.name) : text;
}

std::string regionLine(const tetstream_region_comparison& r, const std::string& name,
                       size_t width) {
  std::string note = changeText(r.original_volume, r.simplified_volume);
  if (r.simplified_cells == 0) note = "LOST";
  if (r.original_cells == 0) note = "NEW";
  if (r.original_parts != r.simplified_parts && note != "LOST" && note != "NEW")
    note += ", parts " + countText(r.original_parts) + " -> " + countText(r.simplified_parts);
  return both(name.c_str(), number(r.original_volume), number(r.simplified_volume), note, width);
}

template <class Row>
std::string linesOf(const std::vector<Row>& rows, const char* what,
                    std::string (*line)(const Row&, const std::string& name, size_t width)) {
  std::vector<std::string> names;
  size_t width = kNameWidth;
  for (size_t i = 0; i < std::min(kMostListed, rows.size()); ++i) {
    names.push_back(labelText(what, rows[i]));
    width = std::max(width, names.back().size());
  }
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) text += line(rows[i], names[i], width);
  if (rows.size() > kMostListed)
    text += textOf("  and %zu more, which --report json tells\n", rows.size() - kMostListed);
  return text;
}

std::string regionsText(const ComparisonFigures& f) {
  if (f.regions.empty()) return "regions: " + oneLine(f.info.regions) + "\n";
  size_t lost = 0, changed = 0;
  for (const auto& r : f.regions) {
    lost += r.simplified_cells == 0;
    changed += r.original_parts != r.simplified_parts;
  }
  const std::string text =
      "regions, " + oneLine(f.info.regions) +
      textOf(": %zu, %zu lost, parts changed in %zu\n", f.regions.size(), lost, changed);
  return text + linesOf(f.regions, "volume", regionLine);
}

std::string faceLabelLine(const tetstream_face_label_comparison& l, const std::string& name,
                          size_t width) {
  std::string note = changeText(l.original_area, l.simplified_area);
  if (l.simplified_faces == 0) note = "LOST";
  if (l.original_faces == 0) note = "NEW";
  return both(name.c_str(), number(l.original_area), number(l.simplified_area), note, width);
}

// Nothing where there are none: most meshes have none.
std::string faceLabelsText(const ComparisonFigures& f) {
  if (f.face_labels.empty()) return "";
  size_t lost = 0;
  for (const auto& l : f.face_labels) lost += l.simplified_faces == 0;
  return textOf("labels of faces: %zu, %zu lost\n", f.face_labels.size(), lost) +
         linesOf(f.face_labels, "area", faceLabelLine) + "\n";
}

// ---------------------------------------------------------------------------------- for programs

void addMesh(JsonText& json, const char* name, const tetstream_mesh_figures& m) {
  json.key(name).open('{');
  const auto add = [&](const char* key, auto value) { json.key(key).value(value); };
  add("cells", m.cells);
  add("vertices", m.vertices);
  add("edges", m.edges);
  add("faces", m.faces);
  add("volume", m.volume);
  add("components", m.components);
  add("euler", m.euler);
  add("boundary_faces", m.boundary_faces);
  add("boundary_vertices", m.boundary_vertices);
  add("boundary_components", m.boundary_components);
  add("boundary_euler", m.boundary_euler);
  add("boundary_area", m.boundary_area);
  add("nonmanifold_faces", m.nonmanifold_faces);
  add("nonmanifold_edges", m.nonmanifold_edges);
  add("nonmanifold_vertices", m.nonmanifold_vertices);
  add("inverted_cells", m.inverted_cells);
  add("flat_cells", m.flat_cells);
  add("folded_faces", m.folded_faces);
  add("duplicate_cells", m.duplicate_cells);
  add("least_angle", m.least_angle);
  add("largest_angle", m.largest_angle);
  add("mean_least_angle", m.mean_least_angle);
  add("share_below_1", m.share_below_1);
  add("share_below_5", m.share_below_5);
  add("share_below_10", m.share_below_10);
  add("median_aspect", m.median_aspect);
  add("p99_aspect", m.p99_aspect);
  add("largest_aspect", m.largest_aspect);
  json.close('}');
}

void addField(JsonText& json, const tetstream_field_comparison& f) {
  json.open('{');
  json.key("name").value(std::string_view(f.name));
  json.key("components").value(f.components);
  json.key("range").value(f.range);
  json.key("largest").value(f.largest);
  json.key("largest_place").values(f.largest_place, 3);
  json.key("largest_inside").value(f.largest_inside);
  json.key("cmse").value(f.cmse);
  json.key("rms").value(f.rms);
  json.key("rms_inside").value(f.rms_inside);
  json.key("cpsnr").value(f.cpsnr);
  json.key("largest_percent").value(f.largest_percent);
  json.key("rms_percent").value(f.rms_percent);
  json.close('}');
}

// A label that has no name has null.
void addName(JsonText& json, const char* name) {
  json.key("name");
  if (*name)
    json.value(std::string_view(name));
  else
    json.null();
}

// Of a distance, which is nowhere where there is none.
void addPlace(JsonText& json, const char* name, const double place[3], double distance) {
  json.key(name).values(std::isnan(distance) ? nullptr : place, 3);
}

void addRegion(JsonText& json, const tetstream_region_comparison& r) {
  json.open('{');
  json.key("label").value(r.label);
  addName(json, r.name);
  json.key("original_cells").value(r.original_cells);
  json.key("simplified_cells").value(r.simplified_cells);
  json.key("original_volume").value(r.original_volume);
  json.key("simplified_volume").value(r.simplified_volume);
  json.key("original_parts").value(r.original_parts);
  json.key("simplified_parts").value(r.simplified_parts);
  json.close('}');
}

void addFaceLabel(JsonText& json, const tetstream_face_label_comparison& l) {
  json.open('{');
  json.key("label").value(l.label);
  addName(json, l.name);
  json.key("original_faces").value(l.original_faces);
  json.key("simplified_faces").value(l.simplified_faces);
  json.key("original_area").value(l.original_area);
  json.key("simplified_area").value(l.simplified_area);
  json.close('}');
}

}  // namespace

std::string comparisonText(const ComparisonFigures& f) {
  return meshesText(f.original, f.simplified) + "\n" + partText(f) + fieldsText(f) + "\n" +
         boundaryText(f) + "\n" + topologyText(f) + "\n" + shapesText(f.original, f.simplified) +
         "\n" + regionsText(f) + "\n" + faceLabelsText(f) +
         row("time", textOf("%.2f s, %s cells/s", f.info.seconds,
                            shortCount(static_cast<double>(f.original.cells) /
                                       std::max(f.info.seconds, 1e-9))
                                .c_str())) +
         row("memory", megabytes(f.info.peak_bytes) + " of arrays");
}

std::string comparisonJson(const ComparisonFigures& f, const std::vector<std::string>& notes) {
  JsonText json;
  const tetstream_comparison_info& i = f.info;
  json.open('{');
  json.key("field_count").value(i.field_count);
  json.key("region_count").value(i.region_count);
  json.key("face_label_count").value(i.face_label_count);
  json.key("topology_kept").value(i.topology_kept != 0);
  json.key("is_exact").value(i.is_exact != 0);
  json.key("samples").value(i.samples);
  json.key("diagonal").value(i.diagonal);
  json.key("compared_cells").value(i.compared_cells);
  json.key("compared_volume").value(i.compared_volume);
  json.key("boundary_samples").value(i.boundary_samples);
  json.key("outside_volume").value(i.outside_volume);
  json.key("repeated_volume").value(i.repeated_volume);
  json.key("distance").value(i.distance);
  json.key("rms_distance").value(i.rms_distance);
  json.key("distance_back").value(i.distance_back);
  json.key("rms_distance_back").value(i.rms_distance_back);
  addPlace(json, "distance_place", i.distance_place, i.distance);
  addPlace(json, "distance_back_place", i.distance_back_place, i.distance_back);
  json.key("regions").value(std::string_view(i.regions));
  json.key("seconds").value(i.seconds);
  json.key("peak_bytes").value(i.peak_bytes);
  json.key("only_original").values(linesIn(i.only_original));
  json.key("only_simplified").values(linesIn(i.only_simplified));
  addMesh(json, "original", f.original);
  addMesh(json, "simplified", f.simplified);
  json.key("fields").open('[');
  for (const auto& field : f.fields) addField(json, field);
  json.close(']');
  json.key("labels").open('[');
  for (const auto& region : f.regions) addRegion(json, region);
  json.close(']');
  json.key("face_labels").open('[');
  for (const auto& label : f.face_labels) addFaceLabel(json, label);
  json.close(']');
  json.key("notes").values(notes);
  return json.close('}').take();
}

}  // namespace tetstream::cli
