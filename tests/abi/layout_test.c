/* Where the members of the public structs lie on x86-64. Later versions may add members at the
 * end; what stands here stays. */
#include "check.h"
#include "tetstream/tetstream.h"

#define MEMBER(type, member, offset) CHECK_EQUAL(offsetof(type, member), offset)

static void structs_keep_their_layout(void) {
  CHECK_EQUAL(sizeof(tetstream_option_info), 64);
  MEMBER(tetstream_option_info, struct_size, 0);
  MEMBER(tetstream_option_info, id, 8);
  MEMBER(tetstream_option_info, type, 12);
  MEMBER(tetstream_option_info, name, 16);
  MEMBER(tetstream_option_info, text, 24);
  MEMBER(tetstream_option_info, minimum, 32);
  MEMBER(tetstream_option_info, maximum, 40);
  MEMBER(tetstream_option_info, default_text, 48);
  MEMBER(tetstream_option_info, choices, 56);
  CHECK_EQUAL(sizeof(tetstream_column), 16);
  MEMBER(tetstream_column, name, 0);
  MEMBER(tetstream_column, components, 8);
  MEMBER(tetstream_column, type, 12);
  CHECK_EQUAL(sizeof(tetstream_stream_info), 104);
  MEMBER(tetstream_stream_info, struct_size, 0);
  MEMBER(tetstream_stream_info, position_type, 8);
  MEMBER(tetstream_stream_info, flags, 12);
  MEMBER(tetstream_stream_info, field_count, 16);
  MEMBER(tetstream_stream_info, cell_data_count, 20);
  MEMBER(tetstream_stream_info, fields, 24);
  MEMBER(tetstream_stream_info, cell_data, 32);
  MEMBER(tetstream_stream_info, vertex_count, 40);
  MEMBER(tetstream_stream_info, cell_count, 48);
  MEMBER(tetstream_stream_info, front_width, 56);
  MEMBER(tetstream_stream_info, front_span, 64);
  MEMBER(tetstream_stream_info, front_cells, 72);
  MEMBER(tetstream_stream_info, box_min, 80);
  MEMBER(tetstream_stream_info, box_max, 88);
  MEMBER(tetstream_stream_info, face_count, 96);
  CHECK_EQUAL(sizeof(tetstream_batch), 136);
  MEMBER(tetstream_batch, struct_size, 0);
  MEMBER(tetstream_batch, vertex_count, 8);
  MEMBER(tetstream_batch, positions, 16);
  MEMBER(tetstream_batch, fields, 24);
  MEMBER(tetstream_batch, locked, 32);
  MEMBER(tetstream_batch, cell_count, 40);
  MEMBER(tetstream_batch, cells, 48);
  MEMBER(tetstream_batch, last_uses, 56);
  MEMBER(tetstream_batch, cell_data, 64);
  MEMBER(tetstream_batch, finalized_count, 72);
  MEMBER(tetstream_batch, finalized, 80);
  MEMBER(tetstream_batch, face_count, 88);
  MEMBER(tetstream_batch, faces, 96);
  MEMBER(tetstream_batch, face_labels, 104);
  MEMBER(tetstream_batch, locked_faces, 112);
  MEMBER(tetstream_batch, locked_edge_count, 120);
  MEMBER(tetstream_batch, locked_edges, 128);

  CHECK_EQUAL(sizeof(tetstream_pool_callbacks), 32);
  MEMBER(tetstream_pool_callbacks, struct_size, 0);
  MEMBER(tetstream_pool_callbacks, user, 8);
  MEMBER(tetstream_pool_callbacks, threads, 16);
  MEMBER(tetstream_pool_callbacks, submit, 24);

  CHECK_EQUAL(sizeof(tetstream_reader_callbacks), 40);
  MEMBER(tetstream_reader_callbacks, struct_size, 0);
  MEMBER(tetstream_reader_callbacks, user, 8);
  MEMBER(tetstream_reader_callbacks, open, 16);
  MEMBER(tetstream_reader_callbacks, next, 24);
  MEMBER(tetstream_reader_callbacks, close, 32);
  CHECK_EQUAL(sizeof(tetstream_writer_callbacks), 48);
  MEMBER(tetstream_writer_callbacks, struct_size, 0);
  MEMBER(tetstream_writer_callbacks, user, 8);
  MEMBER(tetstream_writer_callbacks, open, 16);
  MEMBER(tetstream_writer_callbacks, put, 24);
  MEMBER(tetstream_writer_callbacks, finish, 32);
  MEMBER(tetstream_writer_callbacks, close, 40);
  CHECK_EQUAL(sizeof(tetstream_map_rows), 40);
  MEMBER(tetstream_map_rows, struct_size, 0);
  MEMBER(tetstream_map_rows, count, 8);
  MEMBER(tetstream_map_rows, vertices, 16);
  MEMBER(tetstream_map_rows, cells, 24);
  MEMBER(tetstream_map_rows, weights, 32);
  CHECK_EQUAL(sizeof(tetstream_map_callbacks), 48);
  MEMBER(tetstream_map_callbacks, struct_size, 0);
  MEMBER(tetstream_map_callbacks, user, 8);
  MEMBER(tetstream_map_callbacks, open, 16);
  MEMBER(tetstream_map_callbacks, put, 24);
  MEMBER(tetstream_map_callbacks, finish, 32);
  MEMBER(tetstream_map_callbacks, close, 40);
  CHECK_EQUAL(sizeof(tetstream_log_rows), 56);
  MEMBER(tetstream_log_rows, struct_size, 0);
  MEMBER(tetstream_log_rows, count, 8);
  MEMBER(tetstream_log_rows, kept, 16);
  MEMBER(tetstream_log_rows, removed, 24);
  MEMBER(tetstream_log_rows, positions, 32);
  MEMBER(tetstream_log_rows, values, 40);
  MEMBER(tetstream_log_rows, errors, 48);
  CHECK_EQUAL(sizeof(tetstream_log_callbacks), 48);
  MEMBER(tetstream_log_callbacks, struct_size, 0);
  MEMBER(tetstream_log_callbacks, user, 8);
  MEMBER(tetstream_log_callbacks, open, 16);
  MEMBER(tetstream_log_callbacks, put, 24);
  MEMBER(tetstream_log_callbacks, finish, 32);
  MEMBER(tetstream_log_callbacks, close, 40);
  CHECK_EQUAL(sizeof(tetstream_progress), 56);
  MEMBER(tetstream_progress, struct_size, 0);
  MEMBER(tetstream_progress, cells_read, 8);
  MEMBER(tetstream_progress, cells_total, 16);
  MEMBER(tetstream_progress, cells_written, 24);
  MEMBER(tetstream_progress, fraction, 32);
  MEMBER(tetstream_progress, phase, 40);
  MEMBER(tetstream_progress, temporary_bytes, 48);
  CHECK_EQUAL(sizeof(tetstream_report), 208);
  MEMBER(tetstream_report, struct_size, 0);
  MEMBER(tetstream_report, cells_in, 8);
  MEMBER(tetstream_report, vertices_in, 16);
  MEMBER(tetstream_report, cells_out, 24);
  MEMBER(tetstream_report, vertices_out, 32);
  MEMBER(tetstream_report, target_cells, 40);
  MEMBER(tetstream_report, window_cells, 48);
  MEMBER(tetstream_report, front_width, 56);
  MEMBER(tetstream_report, front_span, 64);
  MEMBER(tetstream_report, front_cells, 72);
  MEMBER(tetstream_report, collapses, 80);
  MEMBER(tetstream_report, rejected_orientation, 88);
  MEMBER(tetstream_report, rejected_link, 96);
  MEMBER(tetstream_report, rejected_locked, 104);
  MEMBER(tetstream_report, rejected_other, 112);
  MEMBER(tetstream_report, locked_cells, 120);
  MEMBER(tetstream_report, unused_vertices, 128);
  MEMBER(tetstream_report, largest_error, 136);
  MEMBER(tetstream_report, seconds, 144);
  MEMBER(tetstream_report, peak_window_bytes, 152);
  MEMBER(tetstream_report, peak_resident_bytes, 160);
  MEMBER(tetstream_report, regions, 168);
  MEMBER(tetstream_report, limited_by, 176);
  MEMBER(tetstream_report, estimated_error, 184);
  MEMBER(tetstream_report, reached, 192);
  MEMBER(tetstream_report, order, 200);
  CHECK_EQUAL(sizeof(tetstream_front_info), 72);
  MEMBER(tetstream_front_info, struct_size, 0);
  MEMBER(tetstream_front_info, width, 8);
  MEMBER(tetstream_front_info, span, 16);
  MEMBER(tetstream_front_info, cells, 24);
  MEMBER(tetstream_front_info, mean_width, 32);
  MEMBER(tetstream_front_info, mean_span, 40);
  MEMBER(tetstream_front_info, mean_life, 48);
  MEMBER(tetstream_front_info, longest_life, 56);
  MEMBER(tetstream_front_info, window_cells, 64);
  CHECK_EQUAL(sizeof(tetstream_face_label_info), 24);
  MEMBER(tetstream_face_label_info, struct_size, 0);
  MEMBER(tetstream_face_label_info, label, 8);
  MEMBER(tetstream_face_label_info, faces, 16);
  CHECK_EQUAL(sizeof(tetstream_layout_report), 80);
  MEMBER(tetstream_layout_report, struct_size, 0);
  MEMBER(tetstream_layout_report, order, 8);
  MEMBER(tetstream_layout_report, vertices, 16);
  MEMBER(tetstream_layout_report, cells, 24);
  MEMBER(tetstream_layout_report, unused_vertices, 32);
  MEMBER(tetstream_layout_report, front_width, 40);
  MEMBER(tetstream_layout_report, front_span, 48);
  MEMBER(tetstream_layout_report, front_cells, 56);
  MEMBER(tetstream_layout_report, temporary_bytes, 64);
  MEMBER(tetstream_layout_report, seconds, 72);
  CHECK_EQUAL(sizeof(tetstream_diagram_info), 152);
  MEMBER(tetstream_diagram_info, struct_size, 0);
  MEMBER(tetstream_diagram_info, cell_count, 8);
  MEMBER(tetstream_diagram_info, vertex_count, 16);
  MEMBER(tetstream_diagram_info, front_width, 24);
  MEMBER(tetstream_diagram_info, front_span, 32);
  MEMBER(tetstream_diagram_info, front_cells, 40);
  MEMBER(tetstream_diagram_info, mean_width, 48);
  MEMBER(tetstream_diagram_info, mean_span, 56);
  MEMBER(tetstream_diagram_info, mean_life, 64);
  MEMBER(tetstream_diagram_info, longest_life, 72);
  MEMBER(tetstream_diagram_info, widest_cell, 80);
  MEMBER(tetstream_diagram_info, longest_cell, 88);
  MEMBER(tetstream_diagram_info, columns, 96);
  MEMBER(tetstream_diagram_info, rows, 100);
  MEMBER(tetstream_diagram_info, cells_per_column, 104);
  MEMBER(tetstream_diagram_info, vertices_per_row, 112);
  MEMBER(tetstream_diagram_info, coverage, 120);
  MEMBER(tetstream_diagram_info, widths, 128);
  MEMBER(tetstream_diagram_info, lowest, 136);
  MEMBER(tetstream_diagram_info, newest, 144);
}

static void numbers_keep_their_values(void) {
  CHECK_EQUAL(TETSTREAM_OK, 0);
  CHECK_EQUAL(TETSTREAM_END, 1);
  CHECK_EQUAL(TETSTREAM_TARGET_MISSED, 2);
  CHECK_EQUAL(TETSTREAM_BAD_ARGUMENT, -1);
  CHECK_EQUAL(TETSTREAM_BAD_STATE, -2);
  CHECK_EQUAL(TETSTREAM_NO_MEMORY, -3);
  CHECK_EQUAL(TETSTREAM_BAD_DATA, -4);
  CHECK_EQUAL(TETSTREAM_IO, -5);
  CHECK_EQUAL(TETSTREAM_UNSUPPORTED, -6);
  CHECK_EQUAL(TETSTREAM_CANCELLED, -7);
  CHECK_EQUAL(TETSTREAM_CALLBACK, -8);
  CHECK_EQUAL(TETSTREAM_INTERNAL, -9);
  CHECK_EQUAL(TETSTREAM_TYPE_FLOAT32, 1);
  CHECK_EQUAL(TETSTREAM_TYPE_FLOAT64, 2);
  CHECK_EQUAL(TETSTREAM_TYPE_INT32, 3);
  CHECK_EQUAL(TETSTREAM_TYPE_INT64, 4);
  CHECK_EQUAL(TETSTREAM_OPTION_IS_INT64, 1);
  CHECK_EQUAL(TETSTREAM_OPTION_IS_DOUBLE, 2);
  CHECK_EQUAL(TETSTREAM_OPTION_IS_TEXT, 3);
  CHECK_EQUAL(TETSTREAM_STREAM_INDEXED, 1);
  CHECK_EQUAL(TETSTREAM_OPTION_RATIO, 100);
  CHECK_EQUAL(TETSTREAM_OPTION_CELLS, 101);
  CHECK_EQUAL(TETSTREAM_OPTION_ERROR, 102);
  CHECK_EQUAL(TETSTREAM_OPTION_BOUNDARY_WEIGHT, 110);
  CHECK_EQUAL(TETSTREAM_OPTION_FIELD_RANGE, 111);
  CHECK_EQUAL(TETSTREAM_OPTION_FEATURE_ANGLE, 121);
  CHECK_EQUAL(TETSTREAM_OPTION_REGIONS, 120);
  CHECK_EQUAL(TETSTREAM_OPTION_MODE, 130);
  CHECK_EQUAL(TETSTREAM_OPTION_SEED, 131);
  CHECK_EQUAL(TETSTREAM_OPTION_QUADRIC, 132);
  CHECK_EQUAL(TETSTREAM_OPTION_CANDIDATES, 133);
  CHECK_EQUAL(TETSTREAM_OPTION_PILOT, 134);
  CHECK_EQUAL(TETSTREAM_OPTION_RELEASE, 136);
  CHECK_EQUAL(TETSTREAM_OPTION_SHAPE, 140);
  CHECK_EQUAL(TETSTREAM_OPTION_WINDOW, 200);
  CHECK_EQUAL(TETSTREAM_OPTION_MEMORY, 201);
  CHECK_EQUAL(TETSTREAM_OPTION_TMPDIR, 202);
  CHECK_EQUAL(TETSTREAM_OPTION_AXIS, 210);
  CHECK_EQUAL(TETSTREAM_OPTION_ORDER, 211);
  CHECK_EQUAL(TETSTREAM_OPTION_SPLIT, 220);
  CHECK_EQUAL(TETSTREAM_OPTION_STEP, 222);
  CHECK_EQUAL(TETSTREAM_PAGE_LAYOUT, 1);
  CHECK_EQUAL(TETSTREAM_PAGE_SWEEP, 2);
  CHECK_EQUAL(TETSTREAM_DIAGRAM_LARGEST, 8192);
}

static void the_library_has_the_version_of_its_header(void) {
  CHECK_EQUAL(tetstream_version_number(), TETSTREAM_VERSION_NUMBER);
  CHECK_EQUAL(
      TETSTREAM_VERSION_NUMBER,
      TETSTREAM_VERSION_MAJOR * 10000 + TETSTREAM_VERSION_MINOR * 100 + TETSTREAM_VERSION_PATCH);
}

int main(void) {
#if defined(__x86_64__) && defined(__LP64__)
  RUN_CASE(structs_keep_their_layout);
#endif
  RUN_CASE(numbers_keep_their_values);
  RUN_CASE(the_library_has_the_version_of_its_header);
  return check_end();
}
