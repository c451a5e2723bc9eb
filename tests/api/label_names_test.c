/* Names of labels through the C interface: they go with a mesh into the files that hold them, a
 * note tells them of others, and wrong ones are refused. */
#include <stdlib.h>
#include <string.h>

#include "rig.h"

static const tetstream_label_name good_names[] = {
    {"steel", "region", 1}, {"inlet", NULL, 60}, {"air", "region", 2}};

static whole named(const hostile_mesh* mesh, const tetstream_label_name* names, int64_t count) {
  whole w = whole_of(mesh);
  w.info.label_names = names;
  w.info.label_name_count = count;
  return w;
}

/* Those of faces come first, the others by array and label. */
static void check_names(const tetstream_stream_info* info) {
  CHECK_EQUAL(info->label_name_count, 3);
  if (info->label_name_count != 3) return;
  CHECK(info->label_names[0].cell_array == NULL);
  CHECK_EQUAL(info->label_names[0].label, 60);
  CHECK(strcmp(info->label_names[0].name, "inlet") == 0);
  CHECK(strcmp(info->label_names[1].cell_array, "region") == 0);
  CHECK_EQUAL(info->label_names[1].label, 1);
  CHECK(strcmp(info->label_names[1].name, "steel") == 0);
  CHECK(strcmp(info->label_names[2].name, "air") == 0);
}

static void simplify_into(tetstream_writer* writer, const hostile_mesh* mesh, int pushed) {
  const whole w = named(mesh, good_names, 3);
  simplify_whole(writer, &w, pushed);
}

static void names_go_with_the_mesh(void) {
  hostile_mesh* mesh = hostile_mesh_create(6, 6, 6);
  for (int pushed = 0; pushed < 2; ++pushed)
    for (int msh = 0; msh < 2; ++msh) {
      const char* format = msh ? "msh" : "tets";
      tetstream_writer* writer = NULL;
      tetstream_stream_info info = {0};
      CHECK_EQUAL(tetstream_writer_create_memory(format, &writer), TETSTREAM_OK);
      simplify_into(writer, mesh, pushed);
      CHECK(tetstream_writer_note(writer, 0) == NULL);
      tetstream_reader* reader = read_back(writer, format, &info);
      if (!msh) check_names(&info); /* no face has the label: Gmsh's groups have faces */
      tetstream_reader_destroy(reader);
      tetstream_writer_destroy(writer);
    }
  hostile_mesh_destroy(mesh);
}

static void notes_tell_names_that_are_left_out(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_writer_create_memory("vtu", &writer), TETSTREAM_OK);
  simplify_into(writer, mesh, 0);
  const char* note = tetstream_writer_note(writer, 0);
  CHECK(note && strcmp(note,
                       ".vtu has no names of labels; they are left out: faces 60 \"inlet\", "
                       "\"region\" 1 \"steel\", \"region\" 2 \"air\"") == 0);
  tetstream_writer_destroy(writer);
  hostile_mesh_destroy(mesh);
}

/* Takes what the writer is told. */
static int32_t look_at_names(void* user, const tetstream_stream_info* info) {
  check_names(info);
  *(int*)user += 1;
  return 0;
}

static int32_t take(void* user, const tetstream_batch* batch) {
  (void)user;
  (void)batch;
  return 0;
}

static void writers_of_callers_get_them(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  tetstream_writer* writer = NULL;
  int opened = 0;
  const tetstream_writer_callbacks callbacks = {
      sizeof callbacks, &opened, look_at_names, take, NULL, NULL};
  CHECK_EQUAL(tetstream_writer_create(&callbacks, &writer), TETSTREAM_OK);
  simplify_into(writer, mesh, 0);
  CHECK_EQUAL(opened, 1);
  tetstream_writer_destroy(writer);
  hostile_mesh_destroy(mesh);
}

static void check_refused(const hostile_mesh* mesh, const tetstream_label_name* names,
                          int64_t count, const char* problem) {
  const whole w = named(mesh, names, count);
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&w.info, &w.batch, &reader), TETSTREAM_BAD_ARGUMENT);
  CHECK(strstr(tetstream_reader_message(reader), problem) != NULL);
  tetstream_reader_destroy(reader);
}

static void wrong_names_are_refused(void) {
  hostile_mesh* mesh = hostile_mesh_create(2, 2, 2);
  const tetstream_label_name twice[] = {{"a", NULL, 3}, {"b", "region", 3}, {"c", NULL, 3}};
  const tetstream_label_name elsewhere = {"a", "regions", 3}, nothing = {NULL, NULL, 3},
                             empty = {"", NULL, 3};
  check_refused(mesh, good_names, -1, "-1 is no possible number of names of labels");
  check_refused(mesh, NULL, 1, "the names of labels are NULL");
  check_refused(mesh, &nothing, 1, "name 0 of labels is NULL");
  check_refused(mesh, &empty, 1, "the name of faces 3 has no bytes");
  check_refused(mesh, &elsewhere, 1, "there is no cell array \"regions\"");
  check_refused(mesh, twice, 3, "faces 3 has two names, \"a\" and \"c\"");
  hostile_mesh_destroy(mesh);
}

int main(void) {
  RUN_CASE(names_go_with_the_mesh);
  RUN_CASE(notes_tell_names_that_are_left_out);
  RUN_CASE(writers_of_callers_get_them);
  RUN_CASE(wrong_names_are_refused);
  return check_end();
}
