/* tests/support: a small mesh, and readers and writers that are as unpleasant as the contract of
 * tetstream.h allows, and then some. In C99, on the public header alone. */
#ifndef TETSTREAM_TEST_HOSTILE_H
#define TETSTREAM_TEST_HOSTILE_H

#include "tetstream/tetstream.h"

/* A mesh whose vertices are ranked in the order of their first use. */
typedef struct hostile_mesh {
  int64_t vertex_count, cell_count;
  double* positions;  /* [vertex_count][3] */
  double* density;    /* [vertex_count] */
  float* velocity;    /* [vertex_count][3] */
  int64_t* cells;     /* [cell_count][4] */
  uint8_t* last_uses; /* [cell_count] */
  int32_t* region;    /* [cell_count] */
  double box_min[7], box_max[7];
} hostile_mesh;

/* A box of nx x ny x nz cubes of six cells each, slab by slab along z; region 1 below the middle
 * of z, 2 above. NULL when memory is short. */
hostile_mesh* hostile_mesh_create(int nx, int ny, int nz);
void hostile_mesh_destroy(hostile_mesh* mesh);

/* What a stream of it carries: "density" (float64), "velocity" (3 float32), cell data "region". */
void hostile_mesh_info(const hostile_mesh* mesh, tetstream_stream_info* info);
/* All of it as one batch, last_uses included. `columns` holds the pointers of the batch. */
void hostile_mesh_batch(const hostile_mesh* mesh, tetstream_batch* batch, const void* columns[3]);

/* How a reader cuts the mesh into batches. */
#define HOSTILE_WHOLE 0    /* one batch */
#define HOSTILE_ITEMS 1    /* one vertex, one cell or one finalization at a time */
#define HOSTILE_ODD 2      /* 1, 2, 3, 5, 7, 11, ... cells */
#define HOSTILE_VERTICES 3 /* all vertices first, then ten cells at a time */
/* As HOSTILE_ODD, but finalized by a list at the end of each batch: other events, later ones. */
#define HOSTILE_LISTS 4

/* What the n-th batch (from 1) is spoilt with. */
#define HOSTILE_GARBAGE_ID 1
#define HOSTILE_NEGATIVE_ID 2
#define HOSTILE_NEGATIVE_COUNT 3
#define HOSTILE_NULL_POSITIONS 4
#define HOSTILE_NULL_FIELD 5
#define HOSTILE_LAST_USES 6
#define HOSTILE_NAN 7
#define HOSTILE_TWICE 8 /* finalizes a vertex that was finalized before */

typedef struct hostile_reader {
  const hostile_mesh* mesh;
  int cut;
  uint32_t flags;     /* of the stream; indexed ones finalize nothing */
  int fail_call;      /* this call of open and next together, from 1, fails; 0: none */
  int32_t fail_value; /* with this value */
  int spoil, spoil_batch;
  int empty; /* ends at once */
  /* What was called. */
  int opens, nexts, closes, calls_after_end;
  /* Where it is. */
  int64_t vertex, cell;
  int step, ended, explicit_at;
  char* buffer; /* of the last batch; spoilt and freed at the next call */
  size_t buffer_size;
} hostile_reader;

/* The table of callbacks for it; buffers live for one call only. */
tetstream_reader_callbacks hostile_reader_callbacks(hostile_reader* reader);
/* What is left of it; to be called when the reader of the library is gone. */
void hostile_reader_free(hostile_reader* reader);

typedef struct hostile_writer {
  int fail_put; /* this put, from 1, fails; 0: none */
  int fail_open, fail_finish;
  int32_t fail_value;
  /* What was called, and in which order: "o" open, "p" put, "f" finish, "c" close. */
  int opens, puts, finishes, closes;
  char last_call;
  int order_errors; /* calls in an order that the contract excludes */
  /* What came. */
  int64_t vertices, cells, finalized;
  int stream_errors;    /* unknown, finalized or repeated ids */
  unsigned char* state; /* per vertex: 1 known, 2 finalized */
  int64_t state_size;
} hostile_writer;

tetstream_writer_callbacks hostile_writer_callbacks(hostile_writer* writer);
/* The same with put alone. */
tetstream_writer_callbacks hostile_writer_minimal(hostile_writer* writer);
void hostile_writer_free(hostile_writer* writer);

#endif
