/* Labelled faces and locks through the C interface: of meshes in memory and of pushed ones, told by
 * inspections and comparisons. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"

#define SIDE 6 /* cubes along each axis */

static hostile_mesh* mesh;
static int64_t *faces, *labels, face_count;
static uint8_t *locked, *locked_faces;
static int64_t edge[2];

/* The axis and the end of the box's side that a face lies in, 1 to 6; 0: none. */
static int64_t side_of(const int64_t face[3]) {
  for (int axis = 0; axis < 3; ++axis)
    for (int high = 0; high < 2; ++high) {
      int on = 0;
      const double at = high ? mesh->box_max[axis] : mesh->box_min[axis];
      for (int j = 0; j < 3; ++j) on += mesh->positions[3 * face[j] + axis] == at;
      if (on == 3) return 2 * axis + 1 + high;
    }
  return 0;
}

/* Those on the sides 5 and 6, across z. Of side 5 the first is locked; an edge and a vertex are. */
static void make_faces(void) {
  mesh = hostile_mesh_create(SIDE, SIDE, SIDE);
  faces = malloc((size_t)mesh->cell_count * 12 * sizeof *faces);
  labels = malloc((size_t)mesh->cell_count * 4 * sizeof *labels);
  for (int64_t c = 0; c < mesh->cell_count; ++c)
    for (int j = 0; j < 4; ++j) {
      int64_t* face = faces + 3 * face_count;
      for (int k = 0; k < 3; ++k) face[k] = mesh->cells[4 * c + (j + 1 + k) % 4];
      const int64_t side = side_of(face);
      if (side >= 5) labels[face_count++] = 10 * side;
    }
  locked = calloc((size_t)mesh->vertex_count, 1);
  locked_faces = calloc((size_t)face_count, 1);
  locked[mesh->vertex_count / 2] = 1;
  for (int64_t f = 0; f < face_count && !locked_faces[0]; ++f)
    if (labels[f] == 50) locked_faces[f] = 1;
  edge[0] = mesh->cells[400];
  edge[1] = mesh->cells[401];
}

static void free_faces(void) {
  hostile_mesh_destroy(mesh);
  free(faces);
  free(labels);
  free(locked);
  free(locked_faces);
}

static tetstream_stream_info info_of_mesh(uint32_t flags) {
  tetstream_stream_info info;
  hostile_mesh_info(mesh, &info);
  info.flags = flags;
  info.face_count = face_count;
  return info;
}

static tetstream_batch whole_mesh(void) {
  static const void* columns[3];
  tetstream_batch batch;
  hostile_mesh_batch(mesh, &batch, columns);
  batch.locked = locked;
  batch.face_count = face_count;
  batch.faces = faces;
  batch.face_labels = labels;
  batch.locked_faces = locked_faces;
  batch.locked_edge_count = 1;
  batch.locked_edges = edge;
  return batch;
}

static tetstream_reader* in_memory(void) {
  const tetstream_stream_info info = info_of_mesh(0);
  const tetstream_batch batch = whole_mesh();
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
  return reader;
}

/* What came out. */
typedef struct {
  int64_t of_50, of_60, wrong, vertices;
  double* places;
} taken;

static int32_t take(void* user, const tetstream_batch* batch) {
  taken* t = user;
  t->places =
      realloc(t->places, (size_t)(t->vertices + batch->vertex_count + 1) * 3 * sizeof(double));
  memcpy(t->places + 3 * t->vertices, batch->positions,
         (size_t)batch->vertex_count * 3 * sizeof(double));
  t->vertices += batch->vertex_count;
  for (int64_t i = 0; i < batch->face_count; ++i) {
    const int64_t label = batch->face_labels[i];
    t->of_50 += label == 50;
    t->of_60 += label == 60;
    for (int j = 0; j < 3; ++j) {
      const double z = t->places[3 * batch->faces[3 * i + j] + 2];
      const double side = label == 50 ? mesh->box_min[2] : mesh->box_max[2];
      t->wrong += !(z - side < 1e-3 && side - z < 1e-3);
    }
  }
  return 0;
}

static int holds(const taken* t, int64_t vertex) {
  for (int64_t v = 0; v < t->vertices; ++v)
    if (memcmp(t->places + 3 * v, mesh->positions + 3 * vertex, 3 * sizeof(double)) == 0) return 1;
  return 0;
}

/* Runs it all: pull from arrays, or push of an indexed mesh in one batch. */
static void labels_survive_and_locks_hold(int pushed) {
  taken t = {0};
  tetstream_writer_callbacks writes = {0};
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_options* options = options_of(0.3);
  writes.struct_size = sizeof writes;
  writes.user = &t;
  writes.put = take;
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  if (pushed) {
    const tetstream_stream_info info = info_of_mesh(TETSTREAM_STREAM_INDEXED);
    tetstream_batch batch = whole_mesh();
    batch.last_uses = NULL;
    CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_push(simplifier, &batch), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_finish(simplifier), TETSTREAM_OK);
  } else {
    tetstream_reader* reader = in_memory();
    CHECK_EQUAL(tetstream_simplifier_run(simplifier, reader), TETSTREAM_OK);
    tetstream_reader_destroy(reader);
  }
  CHECK(t.of_50 > 0 && t.of_60 > 0);
  CHECK(t.of_50 + t.of_60 < face_count);
  CHECK_EQUAL(t.wrong, 0);
  CHECK(holds(&t, mesh->vertex_count / 2));
  for (int j = 0; j < 2; ++j) CHECK(holds(&t, edge[j]));
  for (int64_t f = 0; f < face_count; ++f)
    for (int j = 0; locked_faces[f] && j < 3; ++j) CHECK(holds(&t, faces[3 * f + j]));
  free(t.places);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_options_destroy(options);
}

static void labels_survive_in_meshes_in_memory(void) {
  labels_survive_and_locks_hold(0);
}
static void labels_survive_in_indexed_meshes_that_are_pushed(void) {
  labels_survive_and_locks_hold(1);
}

/* The mesh, its labelled faces and its locked edge, each in a batch of its own; then nothing. */
static int32_t open_in_parts(void* user, tetstream_stream_info* info) {
  (void)user;
  *info = info_of_mesh(TETSTREAM_STREAM_INDEXED);
  info->face_count = -1;
  return 0;
}

static int32_t next_part(void* user, tetstream_batch* part) {
  const tetstream_batch all = whole_mesh();
  int* at = user;
  if (*at == 0) {
    *part = all;
    part->last_uses = NULL;
  }
  part->face_count = *at == 1 ? all.face_count : 0;
  part->faces = all.faces;
  part->face_labels = all.face_labels;
  part->locked_faces = all.locked_faces;
  part->locked_edge_count = *at == 2;
  part->locked_edges = all.locked_edges;
  ++*at;
  return 0;
}

static void labels_survive_in_batches_of_their_own(void) {
  int at = 0;
  taken t = {0};
  tetstream_reader_callbacks reads = {0};
  tetstream_writer_callbacks writes = {0};
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  reads.struct_size = sizeof reads;
  reads.user = &at;
  reads.open = open_in_parts;
  reads.next = next_part;
  writes.struct_size = sizeof writes;
  writes.user = &t;
  writes.put = take;
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(at, 4);
  CHECK_EQUAL(t.of_50 + t.of_60, face_count);
  CHECK_EQUAL(t.wrong, 0);
  free(t.places);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

static void inspections_tell_the_labels(void) {
  tetstream_reader* reader = in_memory();
  tetstream_stream_info info = {0};
  tetstream_face_label_info label = {sizeof label, 0, 0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_get_face_label(reader, 0, &label), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_OK);
  CHECK_EQUAL(info.face_count, face_count);
  CHECK_EQUAL(face_count, 4 * SIDE * SIDE);
  for (int32_t i = 0; i < 2; ++i) {
    CHECK_EQUAL(tetstream_reader_get_face_label(reader, i, &label), TETSTREAM_OK);
    CHECK_EQUAL(label.label, 50 + 10 * i);
    CHECK_EQUAL(label.faces, face_count / 2);
  }
  CHECK_EQUAL(tetstream_reader_get_face_label(reader, 2, &label), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_get_face_label(reader, -1, &label), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_get_face_label(reader, 0, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_get_face_label(NULL, 0, &label), TETSTREAM_BAD_ARGUMENT);
  label.struct_size = 8;
  CHECK_EQUAL(tetstream_reader_get_face_label(reader, 0, &label), TETSTREAM_BAD_ARGUMENT);
  tetstream_reader_destroy(reader);
}

/* Against the mesh without labels: they are lost; against itself, all areas are the same. */
static void comparisons_tell_areas(void) {
  for (int with_labels = 0; with_labels < 2; ++with_labels) {
    tetstream_comparison* comparison = NULL;
    tetstream_comparison_info info = {0};
    tetstream_face_label_comparison label = {0};
    tetstream_reader* first = in_memory();
    tetstream_reader* second = with_labels ? in_memory() : arrays_of(mesh);
    tetstream_options* options = getenv("TETSTREAM_SLOW") ? options_of(1) : NULL;
    if (options)
      CHECK_EQUAL(tetstream_options_parse(options, "boundary-samples", "2000"), TETSTREAM_OK);
    info.struct_size = sizeof info;
    label.struct_size = sizeof label;
    CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
    tetstream_options_destroy(options);
    CHECK_EQUAL(tetstream_comparison_get_face_label(comparison, 0, &label), TETSTREAM_BAD_STATE);
    CHECK_EQUAL(tetstream_comparison_read(comparison, first, second, NULL, NULL), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_comparison_get_info(comparison, &info), TETSTREAM_OK);
    CHECK_EQUAL(info.face_label_count, 2);
    CHECK_EQUAL(tetstream_comparison_get_face_label(comparison, 1, &label), TETSTREAM_OK);
    CHECK_EQUAL(label.label, 60);
    CHECK_EQUAL(label.original_faces, face_count / 2);
    CHECK_EQUAL(label.simplified_faces, with_labels ? face_count / 2 : 0);
    const double area =
        (mesh->box_max[0] - mesh->box_min[0]) * (mesh->box_max[1] - mesh->box_min[1]);
    CHECK(label.original_area > 0.999999 * area && label.original_area < 1.000001 * area);
    CHECK(label.simplified_area == (with_labels ? label.original_area : 0));
    CHECK_EQUAL(tetstream_comparison_get_face_label(comparison, 2, &label), TETSTREAM_BAD_ARGUMENT);
    CHECK_EQUAL(tetstream_comparison_get_face_label(comparison, 0, NULL), TETSTREAM_BAD_ARGUMENT);
    tetstream_comparison_destroy(comparison);
    tetstream_reader_destroy(first);
    tetstream_reader_destroy(second);
  }
}

static void faces_of_unknown_vertices_are_refused(void) {
  for (int kind = 0; kind < 3; ++kind) {
    const tetstream_stream_info info = info_of_mesh(0);
    tetstream_batch batch = whole_mesh();
    tetstream_reader* reader = NULL;
    tetstream_writer* writer = NULL;
    const int64_t unknown[3] = {0, 1, mesh->vertex_count};
    const uint8_t lock = 1;
    batch.face_count = kind < 2;
    batch.faces = unknown;
    batch.locked_faces = kind == 1 ? &lock : NULL;
    batch.locked_edge_count = kind == 2;
    batch.locked_edges = unknown + 1;
    const tetstream_status opened = tetstream_reader_open_mesh(&info, &batch, &reader);
    CHECK_EQUAL(opened, kind == 0 ? TETSTREAM_OK : TETSTREAM_BAD_DATA);
    if (kind == 0) {
      CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
      CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_BAD_DATA);
      CHECK_SAYS(tetstream_writer_message(writer), "labelled face 0: vertex");
      tetstream_writer_destroy(writer);
    } else {
      CHECK_SAYS(tetstream_reader_message(reader), kind == 1 ? "locked face 0" : "locked edge 0");
    }
    tetstream_reader_destroy(reader);
  }
}

/* The bytes that a mesh in memory is converted to, in a writer; `flags` say how its ids are. */
static tetstream_writer* converted(const tetstream_batch* batch, uint32_t flags, const void** bytes,
                                   size_t* size) {
  const tetstream_stream_info info = info_of_mesh(flags);
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, bytes, size), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  return writer;
}

static int64_t* from_one(const int64_t* ids, int64_t count) {
  int64_t* copy = malloc((size_t)count * sizeof *copy);
  for (int64_t i = 0; i < count; ++i) copy[i] = ids[i] + 1;
  return copy;
}

static void ids_may_count_from_one(void) {
  tetstream_batch batch = whole_mesh();
  const void *bytes = NULL, *same = NULL;
  size_t size = 0, same_size = 0;
  tetstream_writer* writer = converted(&batch, 0, &bytes, &size);
  int64_t* cells = from_one(mesh->cells, 4 * mesh->cell_count);
  int64_t* corners = from_one(faces, 3 * face_count);
  const int64_t ends[2] = {edge[0] + 1, edge[1] + 1};
  int32_t* narrow = malloc(4 * sizeof *narrow * (size_t)mesh->cell_count);
  for (int64_t i = 0; i < 4 * mesh->cell_count; ++i) narrow[i] = (int32_t)cells[i];
  batch.faces = corners;
  batch.locked_edges = ends;
  for (int kind = 0; kind < 2; ++kind) {
    batch.cells = kind == 0 ? cells : NULL;
    batch.cells32 = kind == 0 ? NULL : narrow;
    tetstream_writer* again = converted(&batch, TETSTREAM_STREAM_FROM_ONE, &same, &same_size);
    CHECK_EQUAL(same_size, size);
    CHECK(same_size == size && memcmp(same, bytes, size) == 0);
    tetstream_writer_destroy(again);
  }
  tetstream_writer_destroy(writer);
  free(cells);
  free(corners);
  free(narrow);
}

/* A mesh whose ids count from one, found to be wrong when it is opened, or when it is read. */
static void check_refused(const tetstream_batch* batch, int when_opened, const char* text) {
  tetstream_stream_info info = info_of_mesh(TETSTREAM_STREAM_FROM_ONE);
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, batch, &reader),
              when_opened ? TETSTREAM_BAD_DATA : TETSTREAM_OK);
  if (!when_opened)
    CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_BAD_DATA);
  CHECK_SAYS(tetstream_reader_message(reader), text);
  tetstream_reader_destroy(reader);
}

static void messages_count_as_the_caller_does(void) {
  tetstream_batch batch = whole_mesh();
  int64_t* cells = from_one(mesh->cells, 4 * mesh->cell_count);
  int64_t* corners = from_one(faces, 3 * face_count);
  const int64_t ends[2] = {edge[0] + 1, edge[1] + 1};
  char text[80];
  batch.cells = cells;
  batch.faces = corners;
  batch.locked_edges = ends;

  cells[5] = 0;
  check_refused(&batch, 0, "cell 2: vertex 0 is not one of the mesh's");
  cells[5] = cells[4];
  snprintf(text, sizeof text, "cell 2: point %lld is there twice", (long long)cells[4]);
  check_refused(&batch, 0, text);
  cells[5] = mesh->cells[5] + 1;

  const size_t places = 3 * (size_t)mesh->vertex_count;
  double* torn = malloc(places * sizeof *torn);
  memcpy(torn, batch.positions, places * sizeof *torn);
  torn[3 * mesh->cells[0]] = NAN;
  batch.positions = torn;
  snprintf(text, sizeof text, "point %lld: its position", (long long)cells[0]);
  check_refused(&batch, 0, text);
  batch.positions = mesh->positions;
  free(torn);

  corners[0] = mesh->vertex_count + 1;
  locked_faces[0] = 1;
  check_refused(&batch, 1, "locked face 1: vertex");
  free(cells);
  free(corners);
}

/* The last of the labelled faces is another one; pulled or pushed, ids from 0 or from 1. */
static void check_last_refused(const int64_t last[3], const char* text, int pushed, int first) {
  const size_t bytes = 3 * (size_t)face_count * sizeof *faces;
  int64_t* changed = malloc(bytes);
  memcpy(changed, faces, bytes);
  memcpy(changed + 3 * (face_count - 1), last, 3 * sizeof *last);
  int64_t *cells = from_one(mesh->cells, 4 * mesh->cell_count),
          *corners = from_one(changed, 3 * face_count);
  const int64_t ends[2] = {edge[0] + first, edge[1] + first};
  tetstream_batch batch = whole_mesh();
  batch.faces = first ? corners : changed;
  batch.locked_edges = ends;
  if (first) batch.cells = cells;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_options* options = options_of(0.3);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  const uint32_t from = first ? TETSTREAM_STREAM_FROM_ONE : 0;
  tetstream_stream_info info = info_of_mesh(from);
  if (pushed) {
    info.flags |= TETSTREAM_STREAM_INDEXED;
    batch.last_uses = NULL;
    CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_push(simplifier, &batch), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_finish(simplifier), TETSTREAM_BAD_DATA);
  } else {
    tetstream_reader* reader = NULL;
    CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_run(simplifier, reader), TETSTREAM_BAD_DATA);
    tetstream_reader_destroy(reader);
  }
  CHECK_SAYS(tetstream_simplifier_message(simplifier), text);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_options_destroy(options);
  free(changed);
  free(cells);
  free(corners);
}

static void strange_faces_are_named_by_their_numbers(void) {
  const int64_t stray[3] = {mesh->cells[0], mesh->cells[1], mesh->cells[4 * mesh->cell_count - 1]};
  for (int pushed = 0; pushed < 2; ++pushed)
    for (int first = 0; first < 2 - pushed; ++first) { /* pushed meshes count from 0 */
      char text[80];
      snprintf(text, sizeof text, "labelled faces %d and %d have the same vertices", 2 + first,
               (int)face_count - 1 + first);
      check_last_refused(faces + 3 * 2, text, pushed, first);
      snprintf(text, sizeof text, "labelled face %d is the face of no cell",
               (int)face_count - 1 + first);
      check_last_refused(stray, text, pushed, first);
    }
}

int main(void) {
  make_faces();
  RUN_CASE(labels_survive_in_meshes_in_memory);
  RUN_CASE(labels_survive_in_indexed_meshes_that_are_pushed);
  RUN_CASE(labels_survive_in_batches_of_their_own);
  RUN_CASE(inspections_tell_the_labels);
  RUN_CASE(comparisons_tell_areas);
  RUN_CASE(faces_of_unknown_vertices_are_refused);
  RUN_CASE(ids_may_count_from_one);
  RUN_CASE(messages_count_as_the_caller_does);
  RUN_CASE(strange_faces_are_named_by_their_numbers);
  free_faces();
  return check_end();
}
