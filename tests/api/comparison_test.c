/* Comparisons through the C interface: figures known in closed form, any order of cells, and every
 * way in which one can be asked for too early, too late or for nothing. */
#define _DEFAULT_SOURCE
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

#include "rig.h"

static hostile_mesh* mesh;
static int layers; /* of its cubes: 3 x 4 x layers */

static tetstream_reader* callbacks(hostile_reader* hostile, const hostile_mesh* of, int cut,
                                   uint32_t flags) {
  tetstream_reader* reader = NULL;
  memset(hostile, 0, sizeof *hostile);
  hostile->mesh = of;
  hostile->cut = cut;
  hostile->flags = flags;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(hostile);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  return reader;
}

/* Slow runs take fewer points of boundaries, and fewer pixels, of which there are more with more
 * memory: nothing that is looked at depends on their number. */
static tetstream_options* options_with(const char* name, const char* value) {
  tetstream_options* options = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  if (getenv("TETSTREAM_SLOW")) {
    CHECK_EQUAL(tetstream_options_parse(options, "boundary-samples", "2000"), TETSTREAM_OK);
    if (name && strcmp(name, "cut") == 0)
      CHECK_EQUAL(tetstream_options_parse(options, "memory", "1M"), TETSTREAM_OK);
  }
  if (name) CHECK_EQUAL(tetstream_options_parse(options, name, value), TETSTREAM_OK);
  return options;
}

static tetstream_comparison* comparison_with(const char* name, const char* value) {
  tetstream_options* options = options_with(name, value);
  tetstream_comparison* comparison = NULL;
  CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
  tetstream_options_destroy(options);
  return comparison;
}

/* The status of a reading of both meshes, the second one as callbacks give it. */
static tetstream_status compare(tetstream_comparison* comparison, const hostile_mesh* simplified,
                                int cut, uint32_t flags) {
  hostile_reader hostile;
  tetstream_reader* first = arrays_of(mesh);
  tetstream_reader* second = callbacks(&hostile, simplified, cut, flags);
  const tetstream_status status = tetstream_comparison_read(comparison, first, second, NULL, NULL);
  tetstream_reader_destroy(first);
  tetstream_reader_destroy(second);
  hostile_reader_free(&hostile);
  return status;
}

static tetstream_comparison_info info_of(const tetstream_comparison* comparison) {
  tetstream_comparison_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_comparison_get_info(comparison, &info), TETSTREAM_OK);
  return info;
}

static tetstream_mesh_figures figures_of(const tetstream_comparison* comparison, int32_t which) {
  tetstream_mesh_figures figures = {0};
  figures.struct_size = sizeof figures;
  CHECK_EQUAL(tetstream_comparison_get_mesh(comparison, which, &figures), TETSTREAM_OK);
  return figures;
}

static tetstream_field_comparison field_of(const tetstream_comparison* comparison, int32_t index) {
  tetstream_field_comparison field = {0};
  field.struct_size = sizeof field;
  CHECK_EQUAL(tetstream_comparison_get_field(comparison, index, &field), TETSTREAM_OK);
  return field;
}

static void a_mesh_is_itself_in_any_order(void) {
  const int step =
      getenv("TETSTREAM_SLOW") ? HOSTILE_LISTS : 1; /* one batch, lists: then with indices */
  for (int cut = HOSTILE_WHOLE; cut <= HOSTILE_LISTS + 1; cut += cut < HOSTILE_LISTS ? step : 1) {
    tetstream_comparison* comparison = comparison_with(NULL, NULL);
    const int indexed = cut > HOSTILE_LISTS;
    CHECK_EQUAL(compare(comparison, mesh, indexed ? HOSTILE_ODD : cut,
                        indexed ? TETSTREAM_STREAM_INDEXED : 0),
                TETSTREAM_OK);
    const tetstream_comparison_info info = info_of(comparison);
    CHECK_EQUAL(info.field_count, 2);
    CHECK_EQUAL(info.region_count, 2);
    CHECK_EQUAL(info.topology_kept, 1);
    CHECK_EQUAL(info.is_exact, 1);
    CHECK(info.distance < 1e-14 && info.distance_back < 1e-14);
    CHECK(info.outside_volume == 0 && info.repeated_volume < 1e-12);
    const tetstream_mesh_figures a = figures_of(comparison, TETSTREAM_ORIGINAL);
    const tetstream_mesh_figures b = figures_of(comparison, TETSTREAM_SIMPLIFIED);
    CHECK_EQUAL(a.cells, mesh->cell_count);
    CHECK_EQUAL(a.vertices, mesh->vertex_count);
    CHECK_EQUAL(a.edges, b.edges);
    CHECK_EQUAL(a.euler, 1);
    CHECK_EQUAL(a.boundary_euler, 2);
    CHECK_EQUAL(a.boundary_faces, 2 * 2 * (3 * 4 + (3 + 4) * layers));
    CHECK_EQUAL(a.components, 1);
    CHECK_EQUAL(b.folded_faces + b.flat_cells + b.inverted_cells, 0);
    CHECK(fabs(a.volume - b.volume) < 1e-12);
    for (int32_t i = 0; i < 2; ++i) {
      const tetstream_field_comparison field = field_of(comparison, i);
      CHECK_SAYS(field.name, i == 0 ? "density" : "velocity");
      CHECK_EQUAL(field.components, i == 0 ? 1 : 3);
      CHECK(field.largest < 1e-12 && field.rms < 1e-12);
    }
    for (int32_t i = 0; i < 2; ++i) {
      tetstream_region_comparison region = {0};
      region.struct_size = sizeof region;
      CHECK_EQUAL(tetstream_comparison_get_region(comparison, i, &region), TETSTREAM_OK);
      CHECK_EQUAL(region.label, i + 1);
      CHECK_EQUAL(region.original_parts, 1);
      CHECK_EQUAL(region.simplified_parts, 1);
      CHECK_EQUAL(region.original_cells, region.simplified_cells);
    }
    tetstream_comparison_destroy(comparison);
  }
}

/* density + 0.25 everywhere, on the same cells: that is the error at each place. */
static void a_constant_shift_of_a_field_is_its_error(void) {
  hostile_mesh* shifted = hostile_mesh_create(3, 4, layers);
  for (int64_t v = 0; v < shifted->vertex_count; ++v) shifted->density[v] += 0.25;
  for (int sampled = 0; sampled < 2; ++sampled) {
    tetstream_comparison* comparison = comparison_with("samples", sampled ? "500" : "0");
    CHECK_EQUAL(compare(comparison, shifted, HOSTILE_ODD, 0), TETSTREAM_OK);
    const tetstream_field_comparison field = field_of(comparison, 0);
    CHECK(fabs(field.rms - 0.25) < (sampled ? 1e-9 : 1e-12));
    CHECK(fabs(field.largest - 0.25) < 1e-9);
    CHECK(fabs(field.cmse - 0.0625) < 1e-9);
    CHECK(fabs(field.cpsnr - 20 * log10(field.range / 0.25)) < 1e-6);
    CHECK(fabs(field.rms_percent - 25 / field.range) < 1e-6);
    CHECK_EQUAL(info_of(comparison).is_exact, !sampled);
    tetstream_comparison_destroy(comparison);
  }
  hostile_mesh_destroy(shifted);
}

/* A shift of values whose squares are no doubles, exactly and by points; the errors are as large.
 */
static void errors_have_the_size_of_the_values_whatever_that_is(void) {
  const int exponents[] = {-900, -500, 500, 900};
  hostile_mesh* original = mesh;
  for (size_t i = 0; i < sizeof exponents / sizeof *exponents; ++i) {
    const double unit = ldexp(1, exponents[i]);
    hostile_mesh* shifted = hostile_mesh_create(3, 4, layers);
    mesh = hostile_mesh_create(3, 4, layers);
    double low = mesh->density[0], high = low;
    for (int64_t v = 0; v < mesh->vertex_count; ++v) {
      low = fmin(low, mesh->density[v]);
      high = fmax(high, mesh->density[v]);
      shifted->density[v] = (mesh->density[v] + 0.25) * unit;
      mesh->density[v] *= unit;
    }
    for (int by_points = 0; by_points < 2; ++by_points) {
      tetstream_comparison* comparison = comparison_with("samples", by_points ? "100" : "0");
      CHECK_EQUAL(compare(comparison, shifted, HOSTILE_ODD, 0), TETSTREAM_OK);
      const tetstream_field_comparison field = field_of(comparison, 0);
      CHECK(fabs(field.range / unit - (high - low)) < 1e-12);
      CHECK(fabs(field.rms / unit - 0.25) < 1e-12);
      CHECK(fabs(field.largest / unit - 0.25) < 1e-12);
      CHECK(fabs(field.largest_percent - 25 / (high - low)) < 1e-10);
      CHECK(isfinite(field.cpsnr) && field.cpsnr < 40);
      tetstream_comparison_destroy(comparison);
    }
    hostile_mesh_destroy(shifted);
    hostile_mesh_destroy(mesh);
  }
  mesh = original;
}

/* The values of one mesh are beyond all that the other's range lets expect, or that one's has none.
 */
static void errors_may_be_far_larger_than_the_range(void) {
  const double scales[][2] = {{1, 1e160}, {1e-199, 1e200}, {1e-310, 1}, {0, 1e300}, {0, 1e-300}};
  hostile_mesh* original = mesh;
  for (size_t i = 0; i < sizeof scales / sizeof *scales; ++i)
    for (int by_points = 0; by_points < 2; ++by_points) {
      hostile_mesh* other = hostile_mesh_create(3, 4, layers);
      mesh = hostile_mesh_create(3, 4, layers);
      for (int64_t v = 0; v < mesh->vertex_count; ++v) {
        other->density[v] = v == 5 ? scales[i][1] : 0;
        mesh->density[v] *= scales[i][0];
      }
      tetstream_comparison* comparison = comparison_with("samples", by_points ? "1000" : "0");
      CHECK_EQUAL(compare(comparison, other, HOSTILE_ODD, 0), TETSTREAM_OK);
      const tetstream_field_comparison field = field_of(comparison, 0);
      CHECK(field.rms > 0 && field.rms < field.largest && field.largest <= 2 * scales[i][1]);
      CHECK(by_points || field.largest >= 0.5 * scales[i][1]);
      CHECK((field.range > 0) == (scales[i][0] > 0));
      tetstream_comparison_destroy(comparison);
      hostile_mesh_destroy(other);
      hostile_mesh_destroy(mesh);
      mesh = original;
    }
}

/* Of either mesh; the other field is compared. */
static void fields_that_are_not_finite_are_told_unless_they_are_named(void) {
  for (int of_original = 0; of_original < 2; ++of_original)
    for (int named = 0; named < 2; ++named) {
      hostile_mesh *original = mesh, *other = hostile_mesh_create(3, 4, layers);
      mesh = hostile_mesh_create(3, 4, layers);
      (of_original ? mesh : other)->density[7] = NAN;
      for (int64_t v = 0; v < 3 * other->vertex_count; ++v) other->velocity[v] += 0.5f;
      tetstream_options* options = options_with("cut", "auto");
      if (named) CHECK_EQUAL(tetstream_options_add_field(options, "density", 1), TETSTREAM_OK);
      tetstream_comparison* comparison = NULL;
      CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
      CHECK_EQUAL(compare(comparison, other, HOSTILE_ODD, 0),
                  named ? TETSTREAM_BAD_DATA : TETSTREAM_OK);
      if (!named) {
        const tetstream_field_comparison density = field_of(comparison, 0);
        const tetstream_field_comparison velocity = field_of(comparison, 1);
        CHECK(isnan(density.range) && isnan(density.rms) && isnan(density.largest_percent));
        CHECK(fabs(velocity.rms - sqrt(0.75)) < 1e-6);
        CHECK(fabs(velocity.largest - sqrt(0.75)) < 1e-6);
      }
      tetstream_comparison_destroy(comparison);
      tetstream_options_destroy(options);
      hostile_mesh_destroy(other);
      hostile_mesh_destroy(mesh);
      mesh = original;
    }
}

/* Against a mesh that is not the same anywhere, exactly and by points, in many pieces. */
static void figures_are_the_same_for_any_number_of_threads(void) {
  const int high = getenv("TETSTREAM_SLOW") ? 6 : 16;
  hostile_mesh *original = mesh, *other = hostile_mesh_create(4, 5, high);
  mesh = hostile_mesh_create(4, 5, high);
  for (int64_t v = 0; v < other->vertex_count; ++v) {
    other->density[v] += 0.1 * sin((double)v);
    for (int k = 0; k < 3; ++k) other->positions[3 * v + k] *= 0.97;
  }
  const char* samples[] = {"0", "3000"};
  for (int s = 0; s < 2; ++s) {
    double wanted[8];
    for (int threads = 1; threads <= 5; threads += 2) {
      tetstream_options* options = options_with("samples", samples[s]);
      tetstream_comparison* comparison = NULL;
      CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, threads),
                  TETSTREAM_OK);
      CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
      CHECK_EQUAL(compare(comparison, other, HOSTILE_ODD, 0), TETSTREAM_OK);
      const tetstream_comparison_info info = info_of(comparison);
      const tetstream_field_comparison f = field_of(comparison, 0);
      CHECK(info.outside_volume > 0 && info.rms_distance_back > 0 && f.rms != f.rms_inside);
      const double found[8] = {
          info.outside_volume, info.distance, info.rms_distance, info.rms_distance_back, f.cmse,
          f.rms_inside,        f.largest,     f.largest_place[0]};
      if (threads == 1) memcpy(wanted, found, sizeof found);
      CHECK(memcmp(wanted, found, sizeof found) == 0);
      tetstream_comparison_destroy(comparison);
      tetstream_options_destroy(options);
    }
  }
  hostile_mesh_destroy(other);
  hostile_mesh_destroy(mesh);
  mesh = original;
}

static void boundaries_are_sampled_at_as_many_points_as_asked(void) {
  hostile_mesh* lower = hostile_mesh_create(3, 4, layers - 1);
  tetstream_comparison* comparison = comparison_with("boundary-samples", "3000");
  CHECK_EQUAL(compare(comparison, lower, HOSTILE_ODD, 0), TETSTREAM_OK);
  const tetstream_comparison_info info = info_of(comparison);
  CHECK_EQUAL(info.is_exact, 1);
  CHECK_EQUAL(info.boundary_samples, 3000);
  CHECK(info.rms_distance > 0 && info.rms_distance < info.distance);
  tetstream_comparison_destroy(comparison);
  hostile_mesh_destroy(lower);
}

/* A layer of one fifth of the height is cut off: that share is outside, and as far away. */
static void what_is_cut_off_is_outside(void) {
  hostile_mesh* lower = hostile_mesh_create(3, 4, layers - 1);
  tetstream_comparison* comparison = comparison_with(NULL, NULL);
  CHECK_EQUAL(compare(comparison, lower, HOSTILE_ODD, 0), TETSTREAM_OK);
  const tetstream_comparison_info info = info_of(comparison);
  const tetstream_mesh_figures a = figures_of(comparison, TETSTREAM_ORIGINAL);
  const tetstream_mesh_figures b = figures_of(comparison, TETSTREAM_SIMPLIFIED);
  CHECK(fabs(info.outside_volume - (a.volume - b.volume)) < 1e-9 * a.volume);
  CHECK(fabs(info.outside_volume * layers / a.volume - 1) < 0.05);
  const double layer = info.outside_volume / (3 * 4); /* cubes of side 1, each so high */
  CHECK(fabs(info.distance - layer) < 1e-9);
  CHECK(info.distance_back <= info.distance + 1e-12);
  CHECK_EQUAL(info.topology_kept, 1);
  tetstream_comparison_destroy(comparison);
  hostile_mesh_destroy(lower);
}

static int draws(void) {
  return strstr(tetstream_version_text(), "no cairo") == NULL;
}

static void a_page_is_drawn_where_a_cut_was_asked_for(void) {
  char folder[] = "/tmp/tetstream-comparison-XXXXXX";
  char svg[64], png[64];
  if (!CHECK(mkdtemp(folder) != NULL)) return;
  snprintf(svg, sizeof svg, "%s/a.svg", folder);
  snprintf(png, sizeof png, "%s/a.png", folder);
  tetstream_comparison* comparison = comparison_with("cut", "x=1.25");
  CHECK_EQUAL(tetstream_comparison_write(comparison, svg, NULL), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(compare(comparison, mesh, HOSTILE_ODD, 0), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_check_path(comparison, "a.gif"), TETSTREAM_UNSUPPORTED);
  if (draws()) {
    CHECK_EQUAL(tetstream_comparison_check_path(comparison, svg), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_comparison_write(comparison, svg, "both"), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_comparison_write(comparison, png, NULL), TETSTREAM_OK);
    CHECK_EQUAL(remove(svg), 0);
    CHECK_EQUAL(remove(png), 0);
  } else {
    CHECK_EQUAL(tetstream_comparison_write(comparison, svg, NULL), TETSTREAM_UNSUPPORTED);
  }
  tetstream_comparison_destroy(comparison);
  comparison = comparison_with("samples", "500");
  CHECK_EQUAL(compare(comparison, mesh, HOSTILE_ODD, 0), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_write(comparison, svg, NULL), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_comparison_message(comparison), "without a cut");
  tetstream_comparison_destroy(comparison);
  CHECK_EQUAL(rmdir(folder), 0);
}

static void failures_of_a_reader_are_told_by_the_comparison(void) {
  const int spoils[] = {0, HOSTILE_GARBAGE_ID, HOSTILE_NAN, HOSTILE_TWICE};
  for (int i = 0; i < 4; ++i) {
    hostile_reader hostile;
    tetstream_comparison* comparison = comparison_with(NULL, NULL);
    tetstream_reader* first = arrays_of(mesh);
    tetstream_reader* second = callbacks(&hostile, mesh, HOSTILE_ODD, 0);
    hostile.fail_call = i == 0 ? 4 : 0;
    hostile.fail_value = 99;
    hostile.spoil = spoils[i];
    hostile.spoil_batch = i == 0 ? 0 : 3;
    CHECK_EQUAL(tetstream_comparison_read(comparison, first, second, NULL, NULL),
                i == 0 ? TETSTREAM_CALLBACK : TETSTREAM_BAD_DATA);
    CHECK_SAYS(tetstream_comparison_message(comparison), i == 0 ? "99" : "the simplified mesh: ");
    tetstream_comparison_info info = {0};
    info.struct_size = sizeof info;
    CHECK_EQUAL(tetstream_comparison_get_info(comparison, &info), TETSTREAM_BAD_STATE);
    tetstream_comparison_destroy(comparison);
    tetstream_reader_destroy(first);
    tetstream_reader_destroy(second);
    CHECK_EQUAL(hostile.closes, 1);
    hostile_reader_free(&hostile);
  }
}

struct stopper {
  int calls, stop_at;
  double last;
};

static int32_t stop(void* user, const tetstream_progress* progress) {
  struct stopper* s = user;
  CHECK(progress->phase && progress->phase[0]);
  CHECK(progress->fraction >= s->last - 1e-9 && progress->fraction <= 1 + 1e-9);
  s->last = progress->fraction;
  return ++s->calls == s->stop_at ? 7 : 0;
}

static void progress_grows_and_cancels_at_any_call(void) {
  struct stopper all = {0, 0, 0};
  const int is_slow = getenv("TETSTREAM_SLOW") != NULL, stops = is_slow ? 4 : 20;
  for (int at = 0; at <= all.calls; at += 1 + all.calls / stops) {
    struct stopper s = {0, at, 0};
    hostile_reader hostile;
    tetstream_comparison* comparison = comparison_with("samples", is_slow ? "500" : "0");
    tetstream_reader* first = arrays_of(mesh);
    tetstream_reader* second = callbacks(&hostile, mesh, HOSTILE_ODD, 0);
    CHECK_EQUAL(tetstream_comparison_read(comparison, first, second, stop, &s),
                at == 0 ? TETSTREAM_OK : TETSTREAM_CANCELLED);
    if (at == 0) all = s;
    tetstream_comparison_destroy(comparison);
    tetstream_reader_destroy(first);
    tetstream_reader_destroy(second);
    hostile_reader_free(&hostile);
  }
  CHECK(all.calls > 5);
}

static void misuse_is_refused_and_does_no_harm(void) {
  tetstream_comparison* comparison = NULL;
  tetstream_options* options = options_with("cut", "w");
  CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_comparison_message(comparison), "x=0.3");
  CHECK_EQUAL(tetstream_comparison_check_path(comparison, "a.svg"), TETSTREAM_BAD_STATE);
  tetstream_comparison_destroy(comparison);
  tetstream_options_destroy(options);
  CHECK_EQUAL(tetstream_comparison_create(NULL, NULL), TETSTREAM_BAD_ARGUMENT);

  const char* wrong[][2] = {{"regions", "density"}, {"regions", "nothing"}};
  for (int i = 0; i < 2; ++i) {
    comparison = comparison_with(wrong[i][0], wrong[i][1]);
    CHECK_EQUAL(compare(comparison, mesh, HOSTILE_ODD, 0), TETSTREAM_BAD_ARGUMENT);
    CHECK_SAYS(tetstream_comparison_message(comparison), wrong[i][1]);
    tetstream_comparison_destroy(comparison);
  }
  options = options_with(NULL, NULL);
  CHECK_EQUAL(tetstream_options_add_field(options, "nothing", 1), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
  tetstream_options_destroy(options);
  CHECK_EQUAL(compare(comparison, mesh, HOSTILE_ODD, 0), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_comparison_message(comparison), "nothing");
  tetstream_comparison_destroy(comparison);

  comparison = comparison_with("samples", "500");
  tetstream_reader* reader = arrays_of(mesh);
  tetstream_comparison_info info = {0};
  tetstream_field_comparison field = {0};
  tetstream_region_comparison region = {0};
  tetstream_mesh_figures figures = {0};
  info.struct_size = sizeof info;
  field.struct_size = sizeof field;
  region.struct_size = sizeof region;
  figures.struct_size = sizeof figures;
  CHECK_EQUAL(tetstream_comparison_get_info(comparison, &info), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_comparison_get_field(comparison, 0, &field), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_comparison_get_region(comparison, 0, &region), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_comparison_get_mesh(comparison, 0, &figures), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_comparison_read(comparison, reader, reader, NULL, NULL),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_read(comparison, reader, NULL, NULL, NULL),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_read(NULL, reader, reader, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(compare(comparison, mesh, HOSTILE_ODD, 0), TETSTREAM_OK);
  CHECK_EQUAL(compare(comparison, mesh, HOSTILE_ODD, 0), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_comparison_get_field(comparison, 2, &field), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_get_field(comparison, -1, &field), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_get_region(comparison, 2, &region), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_get_mesh(comparison, 2, &figures), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_get_info(comparison, NULL), TETSTREAM_BAD_ARGUMENT);
  info.struct_size = offsetof(tetstream_comparison_info, peak_bytes); /* shorter than the first */
  CHECK_EQUAL(tetstream_comparison_get_info(comparison, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_comparison_write(comparison, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_comparison_message(NULL), "NULL");
  tetstream_comparison_destroy(comparison);
  tetstream_comparison_destroy(NULL);
  tetstream_reader_destroy(reader);
}

/* Nothing is near to it; nor does a picture need anything of it on the plane. */
static void a_mesh_of_nothing_can_be_compared(void) {
  char svg[] = "/tmp/tetstream-nothing-XXXXXX.svg";
  hostile_reader hostile;
  tetstream_comparison* comparison = comparison_with("cut", "auto");
  tetstream_reader* first = arrays_of(mesh);
  tetstream_reader* second = callbacks(&hostile, mesh, HOSTILE_ODD, 0);
  hostile.empty = 1;
  CHECK_EQUAL(tetstream_comparison_read(comparison, first, second, NULL, NULL), TETSTREAM_OK);
  const tetstream_comparison_info info = info_of(comparison);
  CHECK_EQUAL(info.topology_kept, 0);
  CHECK_EQUAL(figures_of(comparison, TETSTREAM_SIMPLIFIED).cells, 0);
  CHECK(fabs(info.outside_volume - figures_of(comparison, TETSTREAM_ORIGINAL).volume) < 1e-9);
  CHECK(isinf(info.distance) && isinf(info.rms_distance) && isnan(info.distance_back));
  CHECK(isinf(field_of(comparison, 0).rms) && isinf(field_of(comparison, 0).largest_percent));
  const int fd = mkstemps(svg, 4);
  if (CHECK(fd >= 0)) {
    CHECK_EQUAL(tetstream_comparison_write(comparison, svg, NULL),
                draws() ? TETSTREAM_OK : TETSTREAM_UNSUPPORTED);
    close(fd);
    CHECK_EQUAL(remove(svg), 0);
  }
  tetstream_comparison_destroy(comparison);
  tetstream_reader_destroy(first);
  tetstream_reader_destroy(second);
  hostile_reader_free(&hostile);
}

int main(void) {
  layers = getenv("TETSTREAM_SLOW") ? 3 : 5;
  mesh = hostile_mesh_create(3, 4, layers);
  CHECK(mesh != NULL);
  RUN_CASE(a_mesh_is_itself_in_any_order);
  RUN_CASE(a_constant_shift_of_a_field_is_its_error);
  RUN_CASE(errors_have_the_size_of_the_values_whatever_that_is);
  RUN_CASE(what_is_cut_off_is_outside);
  RUN_CASE(errors_may_be_far_larger_than_the_range);
  RUN_CASE(fields_that_are_not_finite_are_told_unless_they_are_named);
  RUN_CASE(figures_are_the_same_for_any_number_of_threads);
  RUN_CASE(boundaries_are_sampled_at_as_many_points_as_asked);
  RUN_CASE(a_page_is_drawn_where_a_cut_was_asked_for);
  RUN_CASE(failures_of_a_reader_are_told_by_the_comparison);
  RUN_CASE(progress_grows_and_cancels_at_any_call);
  RUN_CASE(misuse_is_refused_and_does_no_harm);
  RUN_CASE(a_mesh_of_nothing_can_be_compared);
  hostile_mesh_destroy(mesh);
  return check_end();
}
