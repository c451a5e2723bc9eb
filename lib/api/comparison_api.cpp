// api: comparisons of two meshes.
#include <chrono>

#include "comparison_page.h"
#include "handles.h"

using namespace tetstream;

static void readInto(tetstream_comparison& c, tetstream_reader& original,
                     tetstream_reader& simplified, const ProgressFunction& progress) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const Busy busy(c);
  ReaderUse ours(original), theirs(simplified);
  const std::string& temp_dir = c.options.temp_dir;
  Input& first = ours.input(false, temp_dir);
  c.found = compareInputs(first, theirs.input(false, temp_dir), c.options,
                          theirs.told(ours.told(progress)));
  ours.done();
  theirs.done();
  c.seconds = std::chrono::duration<double>(Clock::now() - start).count();
}

template <class T>
static const T& rowOf(const std::vector<T>& rows, int32_t index, const char* what) {
  if (index < 0 || static_cast<size_t>(index) >= rows.size())
    fail(Status::kBadArgument, "there is no %s %d, there are %zu", what, index, rows.size());
  return rows[static_cast<size_t>(index)];
}

// ------------------------------------------------------------------------- the public structs

static tetstream_comparison_info publicInfo(const tetstream_comparison& c) {
  const Comparison& found = *c.found;
  tetstream_comparison_info out = {};
  out.field_count = static_cast<int32_t>(found.fields().size());
  out.region_count = static_cast<int32_t>(found.regions().size());
  out.topology_kept = found.topologyKept();
  out.is_exact = found.isExact();
  out.samples = found.samples();
  out.diagonal = found.diagonal();
  out.outside_volume = found.volumes().outside;
  out.repeated_volume = found.volumes().twice;
  out.distance = found.toSimplified().largest;
  out.rms_distance = found.toSimplified().rms;
  out.distance_back = found.toOriginal().largest;
  out.rms_distance_back = found.toOriginal().rms;
  for (int k = 0; k < 3; ++k) {
    out.distance_place[k] = found.toSimplified().place[k];
    out.distance_back_place[k] = found.toOriginal().place[k];
  }
  out.regions = found.regionWords().c_str();
  out.seconds = c.seconds;
  out.peak_bytes = found.peakBytes();
  out.face_label_count = static_cast<int32_t>(found.faceLabels().size());
  out.compared_cells = static_cast<int64_t>(found.cellsCompared());
  out.compared_volume = found.volumeCompared();
  out.boundary_samples = found.surfaceSamples();
  out.only_original = found.onlyOriginal().c_str();
  out.only_simplified = found.onlySimplified().c_str();
  return out;
}

static tetstream_mesh_figures publicMesh(const MeshFigures& mesh) {
  const TopologyFigures& t = mesh.topology;
  const ShapeFigures& s = mesh.shapes;
  tetstream_mesh_figures out = {};
  out.cells = t.cells;
  out.vertices = t.vertices;
  out.edges = t.edges;
  out.faces = t.faces;
  out.volume = s.volume;
  out.components = t.components;
  out.euler = t.euler();
  out.boundary_faces = t.boundary_faces;
  out.boundary_vertices = t.boundary_vertices;
  out.boundary_components = t.boundary_components;
  out.boundary_euler = t.boundaryEuler();
  out.boundary_area = mesh.boundary_area;
  out.nonmanifold_faces = t.nonmanifold_faces;
  out.nonmanifold_edges = t.nonmanifold_edges;
  out.nonmanifold_vertices = t.nonmanifold_vertices;
  out.inverted_cells = s.inverted();
  out.flat_cells = s.flat;
  out.folded_faces = t.folded_faces;
  out.least_angle = s.least_angle;
  out.largest_angle = s.largest_angle;
  out.mean_least_angle = s.mean_least_angle;
  out.share_below_1 = s.below_1;
  out.share_below_5 = s.below_5;
  out.share_below_10 = s.below_10;
  out.median_aspect = s.median_aspect;
  out.p99_aspect = s.p99_aspect;
  out.largest_aspect = s.largest_aspect;
  out.duplicate_cells = t.duplicate_cells;
  return out;
}

static tetstream_field_comparison publicField(const FieldComparison& field) {
  tetstream_field_comparison out = {};
  out.name = field.name.c_str();
  out.components = static_cast<int32_t>(field.components);
  out.range = field.range;
  out.largest = field.largest;
  for (int k = 0; k < 3; ++k) out.largest_place[k] = field.largest_place[k];
  out.largest_inside = field.largest_inside;
  out.cmse = field.cmse();
  out.rms = field.rms();
  out.rms_inside = field.rmsInside();
  out.cpsnr = field.cpsnr();
  out.largest_percent = field.percent(field.largest);
  out.rms_percent = field.percent(field.rms());
  return out;
}

static tetstream_region_comparison publicRegion(const RegionComparison& region) {
  tetstream_region_comparison out = {};
  out.label = region.label;
  out.original_cells = region.original.cells;
  out.simplified_cells = region.simplified.cells;
  out.original_volume = region.original.volume;
  out.simplified_volume = region.simplified.volume;
  out.original_parts = region.original.parts;
  out.simplified_parts = region.simplified.parts;
  out.name = region.name.c_str();
  return out;
}

static tetstream_face_label_comparison publicFaceLabel(const FaceLabelComparison& label) {
  tetstream_face_label_comparison out = {};
  out.label = label.label;
  out.original_faces = label.original.faces;
  out.simplified_faces = label.simplified.faces;
  out.original_area = label.original.area;
  out.simplified_area = label.simplified.area;
  out.name = label.name.c_str();
  return out;
}

// ------------------------------------------------------------------------------- the functions

tetstream_status tetstream_comparison_create(const tetstream_options* options,
                                             tetstream_comparison** comparison) {
  return guardCreate(__func__, comparison, [&](tetstream_comparison& c) {
    keepOptions(c, options);
    if (c.options.compare.cut != "none") checkCut(c.options.compare.cut);
    partBoxOf(c.options.compare.box);  // throws for what is none
  });
}

void tetstream_comparison_destroy(tetstream_comparison* comparison) {
  destroy(comparison);
}

tetstream_status tetstream_comparison_read(tetstream_comparison* comparison,
                                           tetstream_reader* original, tetstream_reader* simplified,
                                           tetstream_progress_callback progress, void* user) {
  return guard(__func__, comparison, [&](tetstream_comparison& c) {
    needState(c, State::kReady);
    needUnread(original, "original");
    needUnread(simplified, "simplified");
    if (original == simplified)
      fail(Status::kBadArgument, "both readers are the same: a reader is read once");
    c.state = State::kBroken;
    readInto(c, *original, *simplified, progressOf(progress, user));
    c.state = State::kFinished;
  });
}

tetstream_status tetstream_comparison_get_info(const tetstream_comparison* comparison,
                                               tetstream_comparison_info* info) {
  return guard(__func__, comparison, [&](const tetstream_comparison& c) {
    checkStruct(info, "info");
    needState(c, State::kFinished);
    writeStruct(info, publicInfo(c));
  });
}

tetstream_status tetstream_comparison_get_mesh(const tetstream_comparison* comparison, int32_t mesh,
                                               tetstream_mesh_figures* figures) {
  return guard(__func__, comparison, [&](const tetstream_comparison& c) {
    checkStruct(figures, "figures");
    if (mesh != TETSTREAM_ORIGINAL && mesh != TETSTREAM_SIMPLIFIED)
      fail(Status::kBadArgument, "there is no mesh %d", mesh);
    needState(c, State::kFinished);
    writeStruct(figures, publicMesh(mesh == TETSTREAM_ORIGINAL ? c.found->original()
                                                               : c.found->simplified()));
  });
}

tetstream_status tetstream_comparison_get_field(const tetstream_comparison* comparison,
                                                int32_t index, tetstream_field_comparison* field) {
  return guard(__func__, comparison, [&](const tetstream_comparison& c) {
    checkStruct(field, "field");
    needState(c, State::kFinished);
    writeStruct(field, publicField(rowOf(c.found->fields(), index, "field")));
  });
}

tetstream_status tetstream_comparison_get_region(const tetstream_comparison* comparison,
                                                 int32_t index,
                                                 tetstream_region_comparison* region) {
  return guard(__func__, comparison, [&](const tetstream_comparison& c) {
    checkStruct(region, "region");
    needState(c, State::kFinished);
    writeStruct(region, publicRegion(rowOf(c.found->regions(), index, "region")));
  });
}

tetstream_status tetstream_comparison_get_face_label(const tetstream_comparison* comparison,
                                                     int32_t index,
                                                     tetstream_face_label_comparison* label) {
  return guard(__func__, comparison, [&](const tetstream_comparison& c) {
    checkStruct(label, "label");
    needState(c, State::kFinished);
    writeStruct(label, publicFaceLabel(rowOf(c.found->faceLabels(), index, "label of faces")));
  });
}

tetstream_status tetstream_comparison_write(tetstream_comparison* comparison, const char* path,
                                            const char* title) {
  return guard(__func__, comparison, [&](tetstream_comparison& c) {
    needPlace(path, "path");
    needState(c, State::kFinished);
    if (c.options.compare.cut == "none")
      fail(Status::kBadState, "the meshes were compared without a cut");
    drawComparison(path, *c.found, title ? title : "");
  });
}

tetstream_status tetstream_comparison_check_path(const tetstream_comparison* comparison,
                                                 const char* path) {
  return guard(__func__, comparison, [&](const tetstream_comparison&) {
    needPlace(path, "path");
    checkPicture(path);
  });
}

const char* tetstream_comparison_message(const tetstream_comparison* comparison) {
  return messageOf(comparison);
}
