/* tetstream - simplifies tetrahedral meshes with fields as a stream.
 *
 * A mesh goes in cell by cell, in an order that is coherent in space, and comes out smaller, in
 * the same order, while it is still being read. Memory depends on the stream's front, not on the
 * mesh. No cell is inverted or flattened, the topology of the domain is kept, fields are followed
 * as closely as the target allows. After H. T. Vo, S. P. Callahan, P. Lindstrom, V. Pascucci and
 * C. T. Silva, Streaming Simplification of Tetrahedral Meshes, IEEE TVCG 13(1), 2007.
 *
 * In outline, pull (the library asks for data):
 *   1. tetstream_options_create, then set what differs from the defaults
 *   2. tetstream_reader_open_file or another reader; tetstream_writer_create_file or another
 *   3. tetstream_simplifier_create with the options and the writer
 *   4. tetstream_simplifier_run with the reader; the writer's file is complete when it returns
 *   5. tetstream_simplifier_get_report; destroy all handles, in any order
 * and push (a solver hands over data as it computes): in place of 2 and 4
 *   2. tetstream_writer_create with callbacks that take the output
 *   4. tetstream_simplifier_begin, tetstream_simplifier_push for each batch,
 *      tetstream_simplifier_finish
 *
 * Conventions
 *   Ids and counts are 64-bit. A vertex id is the vertex's rank in its stream, from 0.
 *   Arrays are dense rows: positions [n][3], a field [n][components], cells [m][4].
 *   Positions and fields have the caller's units; no result depends on which.
 *   A cell's four vertices may be in either orientation; its order is kept.
 *   Creating functions give a handle that the caller destroys. destroy(NULL) does nothing. When
 *   they fail they give one, too, which can only be asked for its message and destroyed; it is NULL
 *   when there is no memory even for that, or no place to put it. It keeps its message: whatever
 *   else is called with it returns BAD_STATE and leaves that as it is.
 *   Pointers that the library hands out belong to it; each comment says how long they live.
 *   An indexed mesh has 2^32 - 2 points at most; streams have no limit.
 *   Nothing is printed, nothing aborts, and a write that would raise SIGPIPE or SIGXFSZ fails. (When
 *   memory ends, libraries that draw pictures or read HDF5 may do otherwise.) No exception may leave
 *   a callback; no function of the library may be called from inside a callback with a handle that
 *   the run uses.
 *
 * Threads
 *   There is no global state but that of libhdf5, where files of its formats are read or written:
 *   after an application has called H5close() none of them can be opened any more.
 *   A handle is used by one thread at a time; different handles may be used at once, also a reader
 *   and a writer of different simplifiers.
 *   Simplifiers, comparisons and readers of some formats work with threads of their own (option
 *   `threads`), which end with the handle, or with the caller's (tetstream_options_set_pool). With
 *   one thread, or a small option `memory`, the caller's thread does everything.
 *   Callbacks are called on the caller's thread alone, and pipes are written there. With three
 *   threads and more, a pipe is read ahead by another one.
 *   A thread that is cancelled (pthread_cancel, deferred as it is by default) inside a call ends
 *   after it: until then, in its callbacks, too, it cannot be cancelled. Nor may a callback end it.
 *   Calls compute in the default floating-point environment, and so do their callbacks; afterwards
 *   the caller's is as it was: traps, rounding, flushing to zero and exceptions that were raised.
 *
 * A status below 0 is a failure; the handle's message says what happened and where. After a
 * failure in `run`, `begin`, `push` or `finish` the simplifier can only be asked for its message
 * and report, and destroyed; the same holds for the readers and the writer of a failed `run`,
 * `convert`, `layout`, `inspect` or `read`, and for a reader of callbacks that `get_info` could not
 * open. A failure of any other function had no effect, nor has a call that is refused at once:
 * BAD_STATE, or BAD_ARGUMENT for a NULL or a struct_size that is too small.
 */
#ifndef TETSTREAM_H
#define TETSTREAM_H

#include <stddef.h>
#include <stdint.h>

#include "version.h"

#if defined(_WIN32)
#define TETSTREAM_API
#elif defined(__GNUC__)
#define TETSTREAM_API __attribute__((visibility("default")))
#else
#define TETSTREAM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------- version */

/* TETSTREAM_VERSION_NUMBER of the library that runs. Since 0.1. */
TETSTREAM_API int32_t tetstream_version_number(void);
/* Its version and build in words, such as "0.1.0 (zstd, cairo, plain kernels)". Static. Since
 * 0.1. */
TETSTREAM_API const char *tetstream_version_text(void);

/* -------------------------------------------------------------------------------- status */

typedef int32_t tetstream_status;
#define TETSTREAM_OK 0
#define TETSTREAM_END 1            /* no more events; reserved: no function returns it yet */
#define TETSTREAM_TARGET_MISSED 2  /* the output is complete and valid, but has more cells than
                                      asked for; the report says what stopped it */
#define TETSTREAM_BAD_ARGUMENT (-1)
#define TETSTREAM_BAD_STATE (-2)   /* the call is not allowed in the handle's state */
#define TETSTREAM_NO_MEMORY (-3)   /* memory, or the budget set for it, is used up */
#define TETSTREAM_BAD_DATA (-4)    /* a file or a stream breaks its format's rules */
#define TETSTREAM_IO (-5)          /* the system refused a read, a write or an open */
#define TETSTREAM_UNSUPPORTED (-6) /* valid, but this build or this format cannot hold it */
#define TETSTREAM_CANCELLED (-7)   /* the progress callback asked to stop */
#define TETSTREAM_CALLBACK (-8)    /* a callback returned non-zero; the message has its value */
#define TETSTREAM_INTERNAL (-9)    /* a defect of the library: please report it */

/* The name of a status, "TETSTREAM_BAD_DATA"; static, never NULL. Since 0.1. */
TETSTREAM_API const char *tetstream_status_name(tetstream_status status);

/* ---------------------------------------------------------------------- types of numbers */

#define TETSTREAM_TYPE_FLOAT32 1
#define TETSTREAM_TYPE_FLOAT64 2
#define TETSTREAM_TYPE_INT32 3
#define TETSTREAM_TYPE_INT64 4

/* ------------------------------------------------------------------------------- options */

/* Options are numbered; numbers are never reused. The same table gives the flags of the command
 * line; tetstream_option_at lists it. */
/* Targets: the first that is reached ends the run, and is named in the report. 0: not given. */
#define TETSTREAM_OPTION_RATIO 100           /* double, cells out / cells in; 0.1 without any target */
#define TETSTREAM_OPTION_CELLS 101           /* int64, cells out */
#define TETSTREAM_OPTION_ERROR 102           /* double, RMS field error in percent of the range */
#define TETSTREAM_OPTION_BOUNDARY_WEIGHT 110 /* double, dimensionless: boundary against field */
#define TETSTREAM_OPTION_FIELD_RANGE 111     /* text: "free": values may leave their range; "keep" */
#define TETSTREAM_OPTION_BALANCE 112         /* text: "auto": nothing starves a smooth field; "none" */
#define TETSTREAM_OPTION_REGIONS 120         /* text: cell array that labels regions; "auto", "none" */
#define TETSTREAM_OPTION_FEATURE_ANGLE 121   /* double, degrees: sharper edges are kept; 0: folds */
#define TETSTREAM_OPTION_MODE 130            /* text: "sweep", "paper", "queue" */
#define TETSTREAM_OPTION_SEED 131            /* int64, of what "paper" draws, and of samples */
#define TETSTREAM_OPTION_QUADRIC 132         /* text: "determinant", "garland-zhou" */
#define TETSTREAM_OPTION_CANDIDATES 133      /* int64, edges "paper" draws for one collapse */
#define TETSTREAM_OPTION_PILOT 134           /* text: "auto": may read input before; "none" */
#define TETSTREAM_OPTION_RELEASE 136         /* text: what leaves the window first: "order", "error" */
#define TETSTREAM_OPTION_EFFORT 137          /* text: "normal"; "high": more time, less error */
#define TETSTREAM_OPTION_SHAPE 140           /* text: "field", "solver": no thin cells */
#define TETSTREAM_OPTION_SAMPLES 150         /* int64, points of a comparison; 0: exact integrals */
#define TETSTREAM_OPTION_CUT 151             /* text: plane of its picture: "none", "auto", "x=0.3" */
#define TETSTREAM_OPTION_BOX 152             /* text: part of the original: "0:1,0.2:0.4,:"; "": all */
#define TETSTREAM_OPTION_BOUNDARY_SAMPLES 153 /* int64, points of boundaries; 0: 200000 at most */
#define TETSTREAM_OPTION_WINDOW 200          /* int64, cells in core; 0: from the front */
#define TETSTREAM_OPTION_MEMORY 201          /* int64, bytes that the window may take; 0: no limit */
#define TETSTREAM_OPTION_TMPDIR 202          /* text: where temporary files go; "": $TMPDIR, /tmp */
#define TETSTREAM_OPTION_THREADS 203         /* int64, at work at once; 0: one for each core */
#define TETSTREAM_OPTION_AXIS 210            /* text: of order "spatial": "auto", "x", "y", "z" */
#define TETSTREAM_OPTION_ORDER 211           /* text: of the input: "auto", "none", "spatial", ... */
#define TETSTREAM_OPTION_SPLIT 220           /* text: other cells into tetrahedra: "no", "yes" */
#define TETSTREAM_OPTION_RECOVER 221         /* text: what is whole of a damaged .tets: "no", "yes" */
#define TETSTREAM_OPTION_STEP 222            /* text: time step of a file: "last", "first", "3" */
#define TETSTREAM_OPTION_JOIN_POINTS 223     /* text: points of one place: "auto", "no", "yes" */
#define TETSTREAM_OPTION_CELLS_TO_POINTS 224 /* text: cell arrays as fields, too: "no", "yes" */

#define TETSTREAM_OPTION_IS_INT64 1
#define TETSTREAM_OPTION_IS_DOUBLE 2
#define TETSTREAM_OPTION_IS_TEXT 3

/* Where an option counts. */
#define TETSTREAM_SCOPE_READ 1     /* where a reader is opened; alone: in what is made of a file */
#define TETSTREAM_SCOPE_ORDER 2    /* where a mesh is ordered, copied, inspected or drawn */
#define TETSTREAM_SCOPE_SIMPLIFY 4 /* where it is simplified */
#define TETSTREAM_SCOPE_COMPARE 8  /* where two are compared */

typedef struct tetstream_options tetstream_options;

/* One row of the table. The library fills as many members as struct_size covers. */
typedef struct tetstream_option_info {
  size_t struct_size;       /* in: sizeof(tetstream_option_info) */
  int32_t id;               /* TETSTREAM_OPTION_... */
  int32_t type;             /* TETSTREAM_OPTION_IS_... */
  const char *name;         /* "boundary-weight"; static */
  const char *text;         /* one line; static */
  double minimum, maximum;  /* of numbers, both included unless the text says otherwise; of
                               integers rounded, for show: the largest int64 is none of a double */
  const char *default_text; /* static */
  const char *choices;      /* of texts, blank-separated; NULL: anything; static */
  int32_t scope;            /* TETSTREAM_SCOPE_..., added up */
  int64_t lowest, highest;  /* of integers, both included; 0 of others. Since 0.1 */
} tetstream_option_info;

/* The number of options. Since 0.1. */
TETSTREAM_API int32_t tetstream_option_count(void);
/* Row `index` of the table, 0 <= index < count. BAD_ARGUMENT outside. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_option_at(int32_t index, tetstream_option_info *info);

/* All defaults. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_options_create(tetstream_options **options);
/* Since 0.1. */
TETSTREAM_API void tetstream_options_destroy(tetstream_options *options);
/* Sets one option. BAD_ARGUMENT, and nothing changes, if there is no such option, it has another
 * type or the value is out of its range. Texts are copied. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_options_set_int64(tetstream_options *options, int32_t id,
                                                           int64_t value);
TETSTREAM_API tetstream_status tetstream_options_set_double(tetstream_options *options, int32_t id,
                                                            double value);
TETSTREAM_API tetstream_status tetstream_options_set_text(tetstream_options *options, int32_t id,
                                                          const char *value);
/* Sets an option of any type by its name and the text of its value, as on a command line; integers
 * may have a suffix k, M, G (powers of 1024 for memory, where B or iB may follow, of 1000 otherwise)
 * or an exponent. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_options_parse(tetstream_options *options,
                                                       const char *name, const char *value);
/* Reads one option. A text lives until the option is set again or the handle destroyed. Since 0.1.
 */
TETSTREAM_API tetstream_status tetstream_options_get_int64(const tetstream_options *options,
                                                           int32_t id, int64_t *value);
TETSTREAM_API tetstream_status tetstream_options_get_double(const tetstream_options *options,
                                                            int32_t id, double *value);
TETSTREAM_API tetstream_status tetstream_options_get_text(const tetstream_options *options,
                                                          int32_t id, const char **value);
/* Measures the field of that name with that weight (>= 0, 1 is usual; 0: carried along, not
 * measured). It multiplies the field's squared error in units of its range, of a vector or tensor
 * the length of the box of its values; so does what TETSTREAM_OPTION_BALANCE finds. Weights tell
 * fields from each other: the largest counts 1, also for TETSTREAM_OPTION_ERROR and in the report,
 * where a lighter field may have an error as much larger as the root of its share. The first call
 * turns off the default, which measures every nodal float field with weight 1; fields not named are
 * then carried. That the field exists, and that not more than 125 components are measured
 * (UNSUPPORTED), is checked when the stream begins. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_options_add_field(tetstream_options *options,
                                                           const char *name, double weight);
/* How far a run is. Fractions need counts: -1 where they are not known. */
typedef struct tetstream_progress {
  size_t struct_size;
  int64_t cells_read, cells_total, cells_written;
  double fraction; /* of the whole run, or of "open", 0 to 1, or -1 */
  const char *phase; /* "open", "order", "pilot", "simplify", "convert", ..., and "write" when all
                        cells have come and the file is completed, of which no fraction is known;
                        static */
  int64_t temporary_bytes; /* of disk that ordering takes at once, about and at most: told from its
                              first call on. Since 0.1 */
} tetstream_progress;

/* Called at least once per window, often enough for a bar, and while an input that is a pipe has
 * nothing to give; non-zero cancels the run, which fails with TETSTREAM_CANCELLED. */
typedef int32_t (*tetstream_progress_callback)(void *user, const tetstream_progress *progress);

/* A piece of work of the library's. */
typedef void (*tetstream_work)(void *argument);

/* Threads of the caller's, in place of those that a simplifier would start. Members may be added at
 * the end in later versions; struct_size says which ones the caller knows. Results do not depend on
 * the pool. */
typedef struct tetstream_pool_callbacks {
  size_t struct_size;
  void *user;
  /* Threads that may be at work beside the one that calls the library, 0 to 1024. */
  int32_t threads;
  /* Required. Takes a piece of work: `work(argument)` is to be called once, on any thread, at any
   * time: at once, within `submit`, too. Returns 0; or another value if it does not take it, and
   * then must not call it. Called on the thread that calls the library, while it does. No work
   * waits for other work to begin, and no call of the library for work that has not begun: it does
   * that itself. So a pool may be busy with other things, or with the very calls of the library.
   * Work that is late, even after its handles were destroyed, finds nothing left to do; what is
   * never called stays allocated. */
  int32_t (*submit)(void *user, tetstream_work work, void *argument);
} tetstream_pool_callbacks;

/* Simplifiers with these options, and readers opened with them, start no thread, but give work to
 * the pool. The option `threads` then says how many work on cells or text at once, the caller's
 * among them; 0: those of the pool and the caller's. What is read ahead or written behind them may
 * take others. The table is copied; `user` must stay as long as the options and what was created
 * with them. NULL: threads of the library again. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_options_set_pool(tetstream_options *options,
                                                          const tetstream_pool_callbacks *pool);
/* Opening a reader with these options calls `progress`, where it takes long: text formats of indexed
 * meshes are read whole then, and a pipe may be silent. The phase is "open", without counts, and the
 * fraction that of the file's bytes. On the thread that opens; non-zero ends it with
 * TETSTREAM_CANCELLED. NULL: none again. `user` must stay as long as readers are opened. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_options_set_progress(tetstream_options *options,
                                                              tetstream_progress_callback progress,
                                                              void *user);
/* The sentence for the last failure with this handle, "" if there was none. Lives until the next
 * call with the handle. Since 0.1. */
TETSTREAM_API const char *tetstream_options_message(const tetstream_options *options);

/* -------------------------------------------------------- streams: what they are made of */

/* A named array of a stream. */
typedef struct tetstream_column {
  const char *name;    /* 1 to 255 bytes, UTF-8 */
  int32_t components;  /* 1 to 9 */
  int32_t type;        /* TETSTREAM_TYPE_...; floats are interpolated (fields) or averaged by volume
                          (cell data), integers are picked. Values that are not finite are carried:
                          what would be a mean with one is picked. Those of measured and compared
                          fields are BAD_DATA */
} tetstream_column;

/* What a label means: the name of a region or of a part of the boundary, as files have them. Names
 * change nothing in a run; they go with the labels, which are kept, to formats that hold them (.tets,
 * .msh, .exo); of others a note of the writer tells them. */
typedef struct tetstream_label_name {
  const char *name;       /* 1 to 255 bytes, UTF-8 */
  const char *cell_array; /* the cell array, of integers with one component, whose label it is; NULL
                             or empty: a label of faces */
  int64_t label;
} tetstream_label_name;

#define TETSTREAM_STREAM_INDEXED 1 /* nothing is finalized: an indexed mesh in any order, collected
                                      and ordered by the library before it is streamed */
#define TETSTREAM_STREAM_FROM_ONE 4 /* of tetstream_reader_open_mesh alone: the ids in `cells`, `faces`
                                       and `locked_edges` count from 1, as in Fortran, and so does
                                       the message that refuses one; ids of the output are from 0.
                                       Since 0.1 */
#define TETSTREAM_STREAM_TIMED 8 /* `time` is told. Since 0.1 */

/* What a stream carries. Counts that are not known are -1 where the library gives them, and -1 or 0
 * where it takes them. The arrays are read during the call only. */
typedef struct tetstream_stream_info {
  size_t struct_size;    /* sizeof(tetstream_stream_info) */
  int32_t position_type; /* TETSTREAM_TYPE_FLOAT32 or _FLOAT64 */
  uint32_t flags;        /* TETSTREAM_STREAM_... */
  int32_t field_count;
  int32_t cell_data_count;
  const tetstream_column *fields;    /* may be NULL if there are none */
  const tetstream_column *cell_data; /* may be NULL if there are none */
  int64_t vertex_count, cell_count;
  int64_t front_width;               /* vertices between first use and finalization, at most */
  int64_t front_span;                /* highest minus lowest of their ids, plus 1, at most */
  int64_t front_cells;               /* cells that touch a vertex not yet finalized, at most. It
                                        sets the window. */
  const double *box_min; /* x y z and each component of each field, in order, of what is finite (of a
                            component that has nothing finite infinity, in box_max -infinity), or of
                            a whole of which this is a part; NULL: not known */
  const double *box_max;
  int64_t face_count;    /* labelled faces; with the option `memory` their place is kept free */
  int64_t label_name_count;
  const tetstream_label_name *label_names; /* in any order, of a label one at most; may be NULL if
                                              there are none. Since 0.1 */
  double time; /* of the values, with TETSTREAM_STREAM_TIMED, finite, in units of the caller's. It
                  changes nothing in a run and goes to formats that hold one (.tets, .msh, .exo and
                  VTK's); of others a note of the writer tells it. Since 0.1 */
} tetstream_stream_info;

/* Events, some thousands at a time: the batch's vertices, then its cells in order, each with the
 * finalizations that it carries, then the explicit finalizations. A vertex comes in the batch of
 * the first cell that uses it, or before. Unused pointers are NULL. How a stream is cut into
 * batches does not change the result. */
typedef struct tetstream_batch {
  size_t struct_size;        /* sizeof(tetstream_batch) */
  int64_t vertex_count;
  const void *positions;     /* [vertex_count][3] of position_type */
  const void *const *fields; /* one pointer per field: [vertex_count][components] */
  const uint8_t *locked;     /* [vertex_count], non-zero: the vertex is never moved; NULL: none */
  int64_t cell_count;
  const int64_t *cells;         /* [cell_count][4] vertex ids */
  const uint8_t *last_uses;     /* [cell_count], bit j: no later cell uses corner j's vertex; NULL:
                                   none */
  const void *const *cell_data; /* one pointer per cell array: [cell_count][components] */
  int64_t finalized_count;
  const int64_t *finalized;     /* vertices that no later cell uses */
  /* Labelled faces of cells, on the boundary, between regions or inside one, each once, and what
     must stay. They come at the latest with the batch in which the first of their vertices gets
     its last use or is finalized; in an indexed mesh, anywhere. Sheets of them keep their shape and
     topology; curves where they end, meet or change their label are kept like ridges. A face inside
     looks, as it is wound, to the side to which it did, one of the boundary outwards. What is
     locked comes out as locked vertices. */
  int64_t face_count;
  const int64_t *faces;         /* [face_count][3] vertex ids */
  const int64_t *face_labels;   /* [face_count] */
  const uint8_t *locked_faces;  /* [face_count], non-zero: none of its vertices moves; NULL: none */
  int64_t locked_edge_count;
  const int64_t *locked_edges;  /* [locked_edge_count][2] vertex ids; neither end moves, which is
                                   enough: an edge changes only with its ends */
  const int32_t *cells32;       /* [cell_count][4] vertex ids in place of `cells`, which is then NULL:
                                   of tetstream_reader_open_mesh alone. Since 0.1 */
} tetstream_batch;

/* -------------------------------------------------------------------------------- reader */

/* Where a stream comes from, as callbacks. Members may be added at the end in later versions;
 * struct_size says which ones the caller knows. Every callback returns 0 to go on; another value
 * stops the run, which fails with TETSTREAM_CALLBACK.
 *
 *   static int32_t next(void *user, tetstream_batch *batch) {
 *     struct mine *m = user;
 *     if (m->at == m->end) return 0;      // an empty batch ends the stream
 *     batch->cells = m->cells + 4 * m->at;  batch->cell_count = ...;  return 0;
 *   }
 */
typedef struct tetstream_reader_callbacks {
  size_t struct_size;
  void *user;
  /* Required. Called once, first. Fills *info, which comes with struct_size set, the counts -1 and
   * the rest zero. What it points to is copied. */
  int32_t (*open)(void *user, tetstream_stream_info *info);
  /* Required. Called until it gives a batch with nothing in it. *batch comes with struct_size set
   * and the rest zero. Its arrays are read before the next call. */
  int32_t (*next)(void *user, tetstream_batch *batch);
  /* Optional, may be NULL. Called once if open was called, whatever happened since. */
  void (*close)(void *user);
} tetstream_reader_callbacks;

typedef struct tetstream_reader tetstream_reader;

/* A reader serves one `run`, `convert`, `inspect` or `read`. */

/* A reader of the caller's. The table is copied. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_create(const tetstream_reader_callbacks *callbacks,
                                                       tetstream_reader **reader);
/* A file. `format` is a name such as "vtu", or NULL: by the path's extension, before which .gz or
 * .zst is taken off. What is compressed by gzip or zstd is decompressed, whatever it is called. The
 * header is read at once; of text formats of indexed meshes everything, into temporary files. The
 * file must stay as it is until the reader is destroyed. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_open_file(const char *path, const char *format,
                                                          tetstream_reader **reader);
/* A file descriptor, which stays the caller's to close, after the reader is destroyed; for formats
 * that must seek, a pipe is spooled to a temporary file in $TMPDIR or /tmp. What does not block is
 * waited for all the same, and a time limit of a socket's is not kept. `format` must be given. IO
 * for a descriptor that is not open for reading. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_open_fd(int32_t fd, const char *format,
                                                        tetstream_reader **reader);
/* The bytes of a file in memory, which must stay as they are until the reader is destroyed.
 * `format` must be given. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_open_memory(const void *data, size_t size,
                                                            const char *format,
                                                            tetstream_reader **reader);
/* As without `_with`, with options for the reading, which may be NULL:
 *   split            cells of other kinds are cut into tetrahedra; else they are UNSUPPORTED
 *   step             which time step of several is read, and a note tells how many there are;
 *                    BAD_ARGUMENT if it is none of them; where there are no steps UNSUPPORTED,
 *                    but for "first", "last" and "0"
 *   join-points      points at the same place become one, with the means of their floats: always,
 *                    never or where no cell shares a point with another; UNSUPPORTED for streams
 *   cells-to-points  float cell arrays are fields, too: at a point the mean of the cells round it;
 *                    UNSUPPORTED for streams
 *   recover          of a damaged or unfinished .tets what is whole is read, and notes tell what is
 *                    missing, when all was read; UNSUPPORTED for other formats
 *   tmpdir, threads, memory, and the pool: as in a run; some formats are parsed and decompressed
 *                    by several threads, in this function or when the mesh is read
 * Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_open_file_with(const char *path, const char *format,
                                                               const tetstream_options *options,
                                                               tetstream_reader **reader);
TETSTREAM_API tetstream_status tetstream_reader_open_fd_with(int32_t fd, const char *format,
                                                             const tetstream_options *options,
                                                             tetstream_reader **reader);
TETSTREAM_API tetstream_status tetstream_reader_open_memory_with(const void *data, size_t size,
                                                                 const char *format,
                                                                 const tetstream_options *options,
                                                                 tetstream_reader **reader);
/* A file to be compared with another that is opened with these options: what they made of that one
 * (TETSTREAM_SCOPE_READ alone) may be made already in this one, as its only step or as a stream.
 * They count as in tetstream_reader_open_file_with, less those that this file does not take: `step`,
 * then join-points and cells-to-points, then all of them; of what is no regular file none counts.
 * Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_open_result(const char *path, const char *format,
                                                            const tetstream_options *options,
                                                            tetstream_reader **reader);
/* An indexed mesh in arrays of the caller's, which must stay as they are until the reader is
 * destroyed: `mesh` is one batch that holds everything, labelled faces and what is locked, too; its
 * last_uses and finalized are not looked at. Counts of `info` are not looked at either. Since 0.1.
 */
TETSTREAM_API tetstream_status tetstream_reader_open_mesh(const tetstream_stream_info *info,
                                                          const tetstream_batch *mesh,
                                                          tetstream_reader **reader);
/* A mesh made on the fly, in constant memory: kind "fluid" (a jittered box of 1 x 1 x 4, swept
 * along its long axis; scalar "density", vector "velocity") or "ball" (a unit ball, scalar
 * "density", vector "velocity"), of about `cells` cells; "fluid+stress" and "ball+stress" also have
 * a symmetric tensor "stress" (xx, yy, zz, xy, yz, xz). The same arguments give the same mesh.
 * Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_generate(const char *kind, int64_t cells,
                                                         int64_t seed, tetstream_reader **reader);
/* Since 0.1. */
TETSTREAM_API void tetstream_reader_destroy(tetstream_reader *reader);
/* What the stream carries, as far as it is known without reading it. For callback readers: opens
 * them; if that fails, the reader can only be asked for its message, and destroyed. The pointers in
 * *info live as long as the reader. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_get_info(tetstream_reader *reader,
                                                         tetstream_stream_info *info);
/* What the reader left out or assumed; after tetstream_inspect also which fields have values that
 * are not finite, and after that or tetstream_convert how many vertices are in no cell: sentences,
 * note `index`, or NULL if there are fewer; of more than 999 the last says so. Lives as long as the
 * reader. Since 0.1. */
TETSTREAM_API const char *tetstream_reader_note(const tetstream_reader *reader, int32_t index);
/* The sentence for the last failure with this handle, "" if there was none. Lives until the next
 * call with the handle. Since 0.1. */
TETSTREAM_API const char *tetstream_reader_message(const tetstream_reader *reader);

/* What the front of a stream is like (Vo et al. 2007, section 3.1). */
typedef struct tetstream_front_info {
  size_t struct_size;           /* in: sizeof(tetstream_front_info) */
  int64_t width, span;          /* vertices, at most */
  int64_t cells;                /* that touch an active vertex, at most */
  double mean_width, mean_span; /* over the cells */
  double mean_life;             /* cells read while a vertex is active, over the vertices */
  int64_t longest_life;         /* cells */
  int64_t window_cells;         /* room of the window, in cells, of a simplification that knows this
                                   front beforehand, without the options `window` and `error` */
} tetstream_front_info;

/* The front as `inspect` found it. BAD_STATE before. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_get_front(tetstream_reader *reader,
                                                          tetstream_front_info *front);

/* The labelled faces of one label. Members may be added at the end. */
typedef struct tetstream_face_label_info {
  size_t struct_size; /* in: sizeof(tetstream_face_label_info) */
  int64_t label;
  int64_t faces;
} tetstream_face_label_info;

/* The labels of faces as `inspect` found them, by label: row `index`. BAD_ARGUMENT past the end,
 * BAD_STATE before. There are none where more than 65536 labels number the faces. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_reader_get_face_label(tetstream_reader *reader,
                                                               int32_t index,
                                                               tetstream_face_label_info *label);

/* -------------------------------------------------------------------------------- writer */

/* Where a stream goes, as callbacks; the rules of tetstream_reader_callbacks hold. Output is final:
 * what was handed over is never changed or taken back. */
typedef struct tetstream_writer_callbacks {
  size_t struct_size;
  void *user;
  /* Optional, may be NULL. Called once, first. *info lives during the call; counts are -1 where
   * only the end will tell. */
  int32_t (*open)(void *user, const tetstream_stream_info *info);
  /* Required. Called any number of times. *batch and its arrays live during the call. */
  int32_t (*put)(void *user, const tetstream_batch *batch);
  /* Optional, may be NULL. Called once after a complete stream; never after a failure. */
  int32_t (*finish)(void *user);
  /* Optional, may be NULL. Called once if open was called or would have been, last. */
  void (*close)(void *user);
} tetstream_writer_callbacks;

typedef struct tetstream_writer tetstream_writer;

/* A writer of the caller's. The table is copied. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_writer_create(const tetstream_writer_callbacks *callbacks,
                                                       tetstream_writer **writer);
/* A file, written under a temporary name beside `path` and renamed when complete. `format` as for
 * readers. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_writer_create_file(const char *path, const char *format,
                                                            tetstream_writer **writer);
/* A file descriptor, which stays the caller's to close. `format` must be given, here and for
 * memory. IO for a descriptor that is not open for writing. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_writer_create_fd(int32_t fd, const char *format,
                                                          tetstream_writer **writer);
/* Memory: the bytes of a file of that format. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_writer_create_memory(const char *format,
                                                              tetstream_writer **writer);
/* The bytes of a memory writer, once the stream is finished; they live as long as the writer.
 * BAD_STATE before. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_writer_get_memory(const tetstream_writer *writer,
                                                           const void **data, size_t *size);
/* A property of the format, before the stream begins: "compress" ("yes", "no"; .tets, .vtu,
 * .vtkhdf), "order" ("pre", "post"; .sva, .svb), "encoding" ("binary", "text"; .msh), "version"
 * ("4.1", "2.2"; .msh). BAD_ARGUMENT if there is none such. A .tets that goes where nothing can be
 * sought, as in a pipe, or into .gz or .zst, is not compressed by itself. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_writer_set(tetstream_writer *writer, const char *property,
                                                    const char *value);
/* Since 0.1. */
TETSTREAM_API void tetstream_writer_destroy(tetstream_writer *writer);
/* What the format could not hold and was left out: note `index`, or NULL. Lives as long as the
 * writer. Since 0.1. */
TETSTREAM_API const char *tetstream_writer_note(const tetstream_writer *writer, int32_t index);
/* The sentence for the last failure with this handle, "" if there was none. Lives until the next
 * call with the handle. Since 0.1. */
TETSTREAM_API const char *tetstream_writer_message(const tetstream_writer *writer);

/* ----------------------------------------------------------------------------- simplifier */

/* What came out. Members may be added at the end. The texts live until the stream goes on or the
 * handle is destroyed. */
typedef struct tetstream_report {
  size_t struct_size;
  int64_t cells_in, vertices_in, cells_out, vertices_out; /* in: those that are left out, too */
  int64_t target_cells;      /* the larger one of ratio and cells; 0: only an error was given */
  int64_t window_cells;      /* room of the window, in cells, at most; it need not be full */
  int64_t front_width, front_span, front_cells; /* of the input, as it was streamed; cells -1: not
                                                   known, of a mesh held whole that does not tell */
  int64_t collapses;
  int64_t rejected_orientation; /* a cell would have been flat or inverted */
  int64_t rejected_link;        /* the topology would have changed, or the boundary crossed itself */
  int64_t rejected_locked;      /* 0: edges of locked vertices are passed over, not tried */
  int64_t rejected_other;       /* non-finite results, volumes not kept, overshoot of the target or error */
  int64_t locked_cells;         /* flat or folded in the input, passed on as they are */
  int64_t unused_vertices;      /* in no cell, left out */
  double largest_error;         /* largest quadric error of a collapse: volume times field error
                                   squared, field in units of its range, lengths of the extent */
  double seconds;               /* from begin to finish */
  uint64_t peak_window_bytes;   /* of the arrays that the memory option bounds */
  uint64_t peak_resident_bytes; /* of the process, 0 where the system does not tell */
  const char *regions;          /* what was taken as region labels, in words; at the end also which
                                   changed their volume by more than 1 % */
  const char *limited_by;       /* what stopped the run short of its target, or "" */
  double estimated_error;       /* RMS field error in percent of the range, measured at points of the
                                   input; as a rule not less than the true one; NaN where no field
                                   is measured or quadrics are garland-zhou's. Since 0.1 */
  const char *reached;          /* the target that ended the run: "ratio", "cells", "error", or "" */
  const char *order;            /* how the input was ordered, in words. Since 0.1 */
  const char *balance;          /* what the boundary and interfaces count for less, and fields for
                                   more than asked, which are constant, and which have a value
                                   far from all others, in words, or "". Since 0.1 */
  double volume_in, volume_out; /* of all cells, without signs, in the cube of the positions' unit:
                                   of the input and of what was written. Since 0.1 */
} tetstream_report;

typedef struct tetstream_simplifier tetstream_simplifier;

/* A simplifier that writes to `writer`, which serves one stream. The options are copied; NULL: the
 * defaults. Destroying the writer before the stream ends leaves the simplifier to be destroyed.
 * Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_create(const tetstream_options *options,
                                                           tetstream_writer *writer,
                                                           tetstream_simplifier **simplifier);
/* Since 0.1. */
TETSTREAM_API void tetstream_simplifier_destroy(tetstream_simplifier *simplifier);
/* Optional, before the stream begins. `progress` may be NULL. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_progress(tetstream_simplifier *simplifier,
                                                                 tetstream_progress_callback progress,
                                                                 void *user);
/* Pull: reads everything from `reader`, writes everything, finishes the writer. Returns OK, or
 * TARGET_MISSED, or a failure. Once per simplifier. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_run(tetstream_simplifier *simplifier,
                                                        tetstream_reader *reader);
/* Push: the stream begins. Once per simplifier. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_begin(tetstream_simplifier *simplifier,
                                                          const tetstream_stream_info *info);
/* Push: the next events. Nothing of *batch is kept. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_push(tetstream_simplifier *simplifier,
                                                         const tetstream_batch *batch);
/* Push: the stream ends; the rest is simplified and written, the writer finished. Returns OK,
 * TARGET_MISSED or a failure. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_finish(tetstream_simplifier *simplifier);
/* What was done so far; complete after run or finish. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_get_report(
    const tetstream_simplifier *simplifier, tetstream_report *report);
/* The sentence for the last failure with this handle, "" if there was none. Lives until the next
 * call with the handle. Since 0.1. */
TETSTREAM_API const char *tetstream_simplifier_message(const tetstream_simplifier *simplifier);

/* --------------------------------------------------------------- where the vertices went */

/* A run can tell, while it runs, where each vertex of its input lies in its output (a map: the
 * prolongation of a multigrid, a restart, a comparison), and which collapses it did (a log: the
 * hierarchy). A map does not change the output, unless the option `memory` bounds both; for a log
 * no thin cells are flipped (below). Vertices of the input are named by their origins: their ids in
 * the stream, or, of an indexed mesh and of a stream that the library put into another order, the
 * rank of the point in the input as it was. Cells of the output are named by their rank in it, as
 * the writer gets them: tetstream-formats(5) says where an Exodus file has them. Positions are those
 * of the input; where the output's format holds float32 alone, as they were rounded for it. */

/* Rows of a map. */
typedef struct tetstream_map_rows {
  size_t struct_size;      /* sizeof(tetstream_map_rows) */
  int64_t count;           /* some thousands at most */
  const int64_t *vertices; /* [count] origins */
  const int64_t *cells;    /* [count] the cell that the vertex lies in: its rank in the output */
  const double *weights;   /* [count][4] of the cell's vertices, in its order; their sum is 1 */
} tetstream_map_rows;

/* Takes a map; the rules of tetstream_reader_callbacks hold. Every vertex of the input that a cell
 * uses comes once, in the order of the output's cells: a reader that wants them by vertex sorts. For
 * any field that is linear over the output's cells, sum weights[i] * f(corner i) is its value at the
 * vertex; of one that is linear in space, exactly so up to rounding. A vertex that was neither moved
 * nor merged has a 1 at its own corner. One outside of the output, whose boundary has moved, has a
 * weight below 0, of a cell near it; where none is below 0 the vertex lies in the cell. A row may
 * come before its cell and its vertices do. Memory: 12 bytes for each vertex in the window, 20 for
 * each cell, and 24 (float32 throughout) or 40 for each vertex that was moved or merged and whose
 * cell has not been written: at most those that the window's cells stand for, so more where more
 * is taken away. The option `memory` counts them. */
typedef struct tetstream_map_callbacks {
  size_t struct_size;
  void *user;
  /* Optional, may be NULL. Called once, first, after the writer's. */
  int32_t (*open)(void *user);
  /* Required. Called any number of times. *rows and its arrays live during the call. */
  int32_t (*put)(void *user, const tetstream_map_rows *rows);
  /* Optional, may be NULL. Called once when all rows have come; never after a failure. */
  int32_t (*finish)(void *user);
  /* Optional, may be NULL. Called once if open was called or would have been, last. */
  void (*close)(void *user);
} tetstream_map_callbacks;

/* Optional, before the stream begins: the run tells its map to these callbacks, in place of what
 * was set before. The table is copied; NULL: no map. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_map(
    tetstream_simplifier *simplifier, const tetstream_map_callbacks *callbacks);
/* The same into a file, as tetstream-formats(5) describes it: `format` is "tetmap" or "csv", or
 * NULL: by the path's ending. It is written under a temporary name beside `path`; the files of a run
 * are renamed when all of them are complete, and where one cannot be, none is. UNSUPPORTED for
 * another format, IO if it cannot be made; a run with two files of the same name does not begin,
 * BAD_ARGUMENT. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_map_file(tetstream_simplifier *simplifier,
                                                                 const char *path,
                                                                 const char *format);

/* The same to a file descriptor, which stays the caller's to close. `format` must be given. IO for
 * a descriptor that is not open for writing. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_map_fd(tetstream_simplifier *simplifier,
                                                               int32_t fd, const char *format);

/* Rows of a log: the vertex `removed` was merged into `kept`, which has the position and the values
 * from then on. */
typedef struct tetstream_log_rows {
  size_t struct_size;      /* sizeof(tetstream_log_rows) */
  int64_t count;           /* some thousands at most */
  const int64_t *kept;     /* [count] origins, here and below: that of the vertex kept, whatever */
  const int64_t *removed;  /* [count] was merged into it before */
  const double *positions; /* [count][3] as written */
  const double *values;    /* [count][...] every component of every float field, in order; NULL:
                              there are none */
  const double *errors;    /* [count] as largest_error in tetstream_report */
} tetstream_log_rows;

/* Takes a log; the rules of tetstream_reader_callbacks hold. Every collapse comes once, in the order
 * in which it was done. Done in that order on the input (the cells with both vertices go, those with
 * the removed one get the kept one in its place) they make the cells of the output, the last row of
 * a vertex having its position and values; a vertex without a row is as it was. No cells are
 * flipped for that, as thin ones are in a run without a log. With the option `shape` at "solver",
 * where that has an effect, they are, of which the log does not tell: vertices are right, cells are
 * not those of the output. A vertex that was removed is in no later row. The same input and options
 * give the same log. Memory: 8 bytes for each vertex in the window. */
typedef struct tetstream_log_callbacks {
  size_t struct_size;
  void *user;
  /* Optional, may be NULL. Called once, first, after the writer's and the map's. *info, which lives
   * during the call, is that of the input: its float fields are those of the values. */
  int32_t (*open)(void *user, const tetstream_stream_info *info);
  /* Required. Called any number of times. *rows and its arrays live during the call. */
  int32_t (*put)(void *user, const tetstream_log_rows *rows);
  /* Optional, may be NULL. Called once when all rows have come; never after a failure. */
  int32_t (*finish)(void *user);
  /* Optional, may be NULL. Called once if open was called or would have been, last. */
  void (*close)(void *user);
} tetstream_log_callbacks;

/* As set_map. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_log(
    tetstream_simplifier *simplifier, const tetstream_log_callbacks *callbacks);
/* As set_map_file; `format` is "tetlog" or "csv". Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_log_file(tetstream_simplifier *simplifier,
                                                                 const char *path,
                                                                 const char *format);
/* As set_map_fd. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_simplifier_set_log_fd(tetstream_simplifier *simplifier,
                                                               int32_t fd, const char *format);

/* ---------------------------------------------------------------------- without simplifying */

/* Reads everything from `reader` and writes it. An indexed mesh is ordered, as the options say, a
 * stream only if an order other than "auto" is asked for. On failure the message is the writer's.
 * Since 0.1. */
TETSTREAM_API tetstream_status tetstream_convert(tetstream_reader *reader, tetstream_writer *writer,
                                                 const tetstream_options *options,
                                                 tetstream_progress_callback progress, void *user);
/* What bringing a mesh into an order came to. The text lives as long as the writer. */
typedef struct tetstream_layout_report {
  size_t struct_size;        /* in: sizeof(tetstream_layout_report) */
  const char *order;         /* the order, and how it was chosen: "spatial, along z" */
  int64_t vertices, cells;   /* written */
  int64_t unused_vertices;   /* in no cell, left out */
  int64_t front_width, front_span, front_cells; /* of what was written */
  uint64_t temporary_bytes;  /* of disk that was taken at once, at most */
  double seconds;
} tetstream_layout_report;

/* Brings a mesh into the order that the options `order` and `axis` name and writes it as a stream:
 * each vertex just before the first cell that uses it, finalized by the last (Vo et al. 2007,
 * section 3.2). Memory is bounded by the option `memory` (0: 512 MB), whatever the mesh; the rest
 * is in temporary files in `tmpdir`. An indexed mesh is always ordered; a stream with order "auto"
 * only if it tells of n vertices, 20000 or more, and of a front wider than 6 n^(2/3) (so it is in a
 * run and in a comparison, too), with "none" never: it is copied then. "auto" is the sweep
 * or, if the mesh fits the memory, the spectral order where that is narrower; for `run`, and for
 * indexed meshes in `convert` and `inspect`, it is the sweep, whose smooth front lets collapses
 * through that narrower ones hold up. `options` may be NULL:
 * defaults; `report`, too. On failure the message is the writer's. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_layout(tetstream_reader *reader, tetstream_writer *writer,
                                                const tetstream_options *options,
                                                tetstream_progress_callback progress, void *user,
                                                tetstream_layout_report *report);
/* Reads everything and fills *info completely: counts, box, front width, span and cells, as it
 * stands or, for an indexed mesh, as `run` would stream it. As for `convert`, the options `order`,
 * `axis`, `memory` and `tmpdir` count. The pointers in *info live as long as the reader. On failure
 * the message is the reader's. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_inspect(tetstream_reader *reader,
                                                 const tetstream_options *options,
                                                 tetstream_progress_callback progress, void *user,
                                                 tetstream_stream_info *info);

/* ------------------------------------------------------------------------ layout diagrams */

/* How good the order of a stream is, as a picture and as numbers: cells across, vertices down, one
 * line for each vertex from its introduction to its finalization; a vertical line anywhere meets
 * the front of that moment. Memory is that of the front and of the raster, however long the stream.
 *
 *   tetstream_diagram_create(NULL, 1200, 800, &diagram);
 *   tetstream_diagram_read(diagram, reader, 0, NULL, NULL);
 *   tetstream_diagram_write(diagram, TETSTREAM_PAGE_LAYOUT, "mesh.svg", "mesh.vtu");
 */
typedef struct tetstream_diagram tetstream_diagram;

/* The pages that are drawn. */
#define TETSTREAM_PAGE_LAYOUT 1 /* the diagram, with its figures and the front's width */
#define TETSTREAM_PAGE_SWEEP 2  /* the mesh at four moments: written away, in core, to come */

#define TETSTREAM_DIAGRAM_LARGEST 8192 /* columns or rows */

/* The numbers. Members may be added at the end. The arrays live as long as the diagram; they are
 * NULL if there are no cells. Vertices count from the cell that introduces them or a later vertex,
 * through the cell that finalizes them; the lines of those that are never finalized go to the end.
 */
typedef struct tetstream_diagram_info {
  size_t struct_size;
  int64_t cell_count, vertex_count;
  int64_t front_width, front_span, front_cells; /* as in tetstream_stream_info */
  double mean_width, mean_span;   /* over the cells; the span up to the newest vertex */
  double mean_life;               /* cells, over the vertices */
  int64_t longest_life;           /* cells */
  int64_t widest_cell;            /* the first one of the greatest width; -1: there are no cells */
  int64_t longest_cell;           /* the first one of the greatest span; -1: there are no cells */
  int32_t columns, rows;          /* of the raster: as many as were asked for, or fewer */
  int64_t cells_per_column, vertices_per_row; /* the last column and row may stand for fewer */
  const float *coverage;   /* [rows][columns], 0 to 1: how much of a place, its vertices by its
                              cells, the lines cover */
  const int64_t *widths;   /* [columns]: active vertices, at most */
  const int64_t *lowest;   /* [columns]: the lowest active vertex */
  const int64_t *newest;   /* [columns]: the last vertex that was introduced */
} tetstream_diagram_info;

/* A diagram whose raster has at most `columns` x `rows` places, each 1 to
 * TETSTREAM_DIAGRAM_LARGEST, and at least half as many each way, if there are so many cells and
 * vertices. It takes 12 bytes a place. The options are copied; NULL: the defaults; those count that
 * count for `inspect`. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_diagram_create(const tetstream_options *options,
                                                        int32_t columns, int32_t rows,
                                                        tetstream_diagram **diagram);
/* Since 0.1. */
TETSTREAM_API void tetstream_diagram_destroy(tetstream_diagram *diagram);
/* Reads everything, an indexed mesh as `run` would stream it. `page` is TETSTREAM_PAGE_SWEEP if that
 * page is to be written, too, and TETSTREAM_PAGE_LAYOUT or 0 otherwise. A sweep needs the box and
 * the number of cells beforehand, or an input that can be read twice: otherwise UNSUPPORTED. Once
 * per diagram; after a failure it can only be asked for its message, and destroyed. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_diagram_read(tetstream_diagram *diagram,
                                                      tetstream_reader *reader, int32_t page,
                                                      tetstream_progress_callback progress,
                                                      void *user);
/* The numbers, once the stream was read; BAD_STATE before. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_diagram_get_info(const tetstream_diagram *diagram,
                                                          tetstream_diagram_info *info);
/* Draws a page, once the stream was read, into a file, which is SVG or PNG by the path's extension
 * and takes its name when it is complete. `title` stands above it, UTF-8, other bytes as question
 * marks; NULL: none. UNSUPPORTED for another extension and where cairo is not there; BAD_STATE for
 * a sweep that was not read. The diagram stays as it was, and as many pages are drawn as wanted.
 * Since 0.1. */
TETSTREAM_API tetstream_status tetstream_diagram_write(tetstream_diagram *diagram, int32_t page,
                                                       const char *path, const char *title);
/* Whether `write` could draw to that path, as far as its extension and this build go: what it would
 * return. For those who have much to do before; allowed at any time. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_diagram_check_path(const tetstream_diagram *diagram,
                                                            const char *path);
/* The sentence for the last failure with this handle, "" if there was none. Lives until the next
 * call with the handle. Since 0.1. */
TETSTREAM_API const char *tetstream_diagram_message(const tetstream_diagram *diagram);

/* --------------------------------------------------------------------------- comparing meshes */

/* How well a simplified mesh stands for its original: the difference of their fields, the distance
 * of their boundaries, volumes, topology, shapes and regions. Each mesh is read once, from any
 * reader, in any order; memory is bounded by the option `memory` (0: 512 MB), and what does not fit
 * is in temporary files in `tmpdir`.
 *
 *   tetstream_comparison_create(NULL, &comparison);
 *   tetstream_comparison_read(comparison, original, simplified, NULL, NULL);
 *   tetstream_comparison_get_field(comparison, 0, &field);    // field.rms, field.largest
 *
 * Errors of fields are integrals over the common parts of both meshes' cells, where the difference
 * is linear, without sampling; distances of boundaries are sampled. The options `samples`,
 * `boundary-samples` and `box` change that. tetstream_comparison(3) tells how each figure is made.
 * The same meshes, options and seed give the same figures. */
typedef struct tetstream_comparison tetstream_comparison;

/* Which of the two meshes. */
#define TETSTREAM_ORIGINAL 0
#define TETSTREAM_SIMPLIFIED 1

/* The figures of both meshes together. Members may be added at the end. Lengths and volumes are in
 * the meshes' units; texts live as long as the comparison. */
typedef struct tetstream_comparison_info {
  size_t struct_size;
  int32_t field_count, region_count;
  int32_t topology_kept;       /* 1: components, Euler characteristics and counts of non-manifold
                                  elements are the same */
  int32_t is_exact;            /* 0: fields are sampled */
  int64_t samples;             /* of the fields; 0: exact */
  double diagonal;             /* of the original's box */
  double outside_volume;       /* of what is compared, outside the simplified mesh */
  double repeated_volume;      /* the same in more than one simplified cell; 0 if sampled */
  double distance, rms_distance;   /* from the original's boundary to the simplified one: the
                                      largest, and the root of the mean square; infinite, as are
                                      fields' errors, of a simplified mesh without cells; NaN, as
                                      their places are, where there is no boundary to measure
                                      from: in the `box`, or of a mesh without cells */
  double distance_back, rms_distance_back; /* from the simplified boundary to the original's */
  double distance_place[3];        /* where `distance` is */
  double distance_back_place[3];   /* where `distance_back` is */
  const char *regions;         /* what was taken as region labels, in words */
  double seconds;              /* that `read` took */
  uint64_t peak_bytes;         /* of the arrays that the memory option bounds */
  int32_t face_label_count;
  int64_t compared_cells;      /* of the original: all, or those in the option `box` */
  double compared_volume;      /* of these */
  int64_t boundary_samples;    /* about so many points of each boundary, beside its vertices */
  const char *only_original;   /* fields that the simplified mesh does not have, or not with as many */
  const char *only_simplified; /* components, a name a line, and its own; "" for none, and where */
                               /* fields were added */
} tetstream_comparison_info;

/* The figures of one mesh. Members may be added at the end. */
typedef struct tetstream_mesh_figures {
  size_t struct_size;
  int64_t cells, vertices, edges, faces;  /* vertices that cells use */
  double volume;                /* sum of the cells' volumes without signs */
  int64_t components;           /* sets of cells joined through vertices */
  int64_t euler;                /* vertices - edges + faces - cells */
  int64_t boundary_faces, boundary_vertices;
  int64_t boundary_components;  /* joined through vertices */
  int64_t boundary_euler;
  double boundary_area;
  int64_t nonmanifold_faces;    /* of more than two cells */
  int64_t nonmanifold_edges;    /* of the boundary: not of two faces */
  int64_t nonmanifold_vertices; /* of the boundary: of more than one fan of faces */
  int64_t inverted_cells;       /* whose orientation is not that of most */
  int64_t flat_cells;           /* of no volume, exactly */
  int64_t folded_faces;         /* whose two cells lie on the same side, exactly */
  double least_angle, largest_angle; /* between two faces of a cell, degrees */
  double mean_least_angle;           /* mean of the cells' least ones */
  double share_below_1, share_below_5, share_below_10; /* of cells whose least one is below */
  double median_aspect, p99_aspect;  /* circumradius / (3 inradius): 1 is regular; within 1 % */
  double largest_aspect;             /* infinite if there is a flat cell */
  int64_t duplicate_cells;      /* whose four vertices are those of one before */
} tetstream_mesh_figures;

/* The error of one nodal field that both meshes have. Of several components it is the norm of the
 * difference. All are NaN of a field that has values that are not finite; where fields are named
 * (tetstream_options_add_field) that is BAD_DATA. Members may be added at the end. */
typedef struct tetstream_field_comparison {
  size_t struct_size;
  const char *name;           /* lives as long as the comparison */
  int32_t components;
  double range;               /* of the original: norm of highest minus lowest values */
  double largest;             /* largest error */
  double largest_place[3];    /* where it is */
  double largest_inside;      /* where the original is inside the simplified mesh */
  double cmse;                /* mean of the squared error over the volume that is compared */
  double rms;                 /* root of it */
  double rms_inside;          /* over the volume inside the simplified mesh */
  double cpsnr;               /* 20 log10(range / rms), decibels; infinite if there is no error,
                                 else NaN of a constant field */
  double largest_percent, rms_percent; /* of the range; of a constant field the error times 100 */
} tetstream_field_comparison;

/* A region: the cells of one label. Members may be added at the end. */
typedef struct tetstream_region_comparison {
  size_t struct_size;
  int64_t label;
  int64_t original_cells, simplified_cells; /* 0: the label is not there */
  double original_volume, simplified_volume;
  int64_t original_parts, simplified_parts; /* sets of cells joined through faces */
  const char *name;                         /* of the label, "" if it has none */
} tetstream_region_comparison;

/* The labelled faces of one label. Members may be added at the end. */
typedef struct tetstream_face_label_comparison {
  size_t struct_size;
  int64_t label;
  int64_t original_faces, simplified_faces; /* 0: the label is not there */
  double original_area, simplified_area;
  const char *name;                         /* of the label, "" if it has none */
} tetstream_face_label_comparison;

/* The options are copied; NULL: the defaults. Those count that count for `inspect`, and `samples`,
 * `boundary-samples`, `seed`, `cut`, `box`, `regions`, `threads`, the pool and fields that were
 * added: only these are compared, those of weight 0 left out. BAD_ARGUMENT for a `cut` or a `box`
 * that is none. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_comparison_create(const tetstream_options *options,
                                                           tetstream_comparison **comparison);
/* Since 0.1. */
TETSTREAM_API void tetstream_comparison_destroy(tetstream_comparison *comparison);
/* Reads both meshes to their ends and compares them. Fields are matched by name. BAD_ARGUMENT if
 * an option names a field or cell array that is not in both, a `box` without cells or a `cut` that
 * meets none; BAD_DATA, naming the vertex or the cell, for values that are not finite; NO_MEMORY
 * where the front does not fit the memory. Once per comparison; after a failure it can only be
 * asked for its message, and destroyed. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_comparison_read(tetstream_comparison *comparison,
                                                         tetstream_reader *original,
                                                         tetstream_reader *simplified,
                                                         tetstream_progress_callback progress,
                                                         void *user);
/* The figures, once both were read; BAD_STATE before. BAD_ARGUMENT for an index past the end or a
 * `mesh` other than TETSTREAM_ORIGINAL and _SIMPLIFIED. Regions and labels of faces come by label,
 * those that only the simplified mesh has last. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_comparison_get_info(
    const tetstream_comparison *comparison, tetstream_comparison_info *info);
TETSTREAM_API tetstream_status tetstream_comparison_get_mesh(
    const tetstream_comparison *comparison, int32_t mesh, tetstream_mesh_figures *figures);
TETSTREAM_API tetstream_status tetstream_comparison_get_field(
    const tetstream_comparison *comparison, int32_t index, tetstream_field_comparison *field);
TETSTREAM_API tetstream_status tetstream_comparison_get_region(
    const tetstream_comparison *comparison, int32_t index, tetstream_region_comparison *region);
TETSTREAM_API tetstream_status tetstream_comparison_get_face_label(
    const tetstream_comparison *comparison, int32_t index, tetstream_face_label_comparison *label);
/* Draws a page, once both were read with the option `cut`: a cut through both meshes, coloured by
 * the first field that was compared, the error on it, how the error is spread over the volume, and
 * the figures. SVG or PNG by the path's extension; the file takes its name when it is complete.
 * `title` stands above it; NULL: none. BAD_STATE if the option `cut` was "none"; UNSUPPORTED for
 * another extension and where cairo is not there. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_comparison_write(tetstream_comparison *comparison,
                                                          const char *path, const char *title);
/* Whether `write` could draw to that path, as far as its extension and this build go; allowed at
 * any time. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_comparison_check_path(
    const tetstream_comparison *comparison, const char *path);
/* The sentence for the last failure with this handle, "" if there was none. Lives until the next
 * call with the handle. Since 0.1. */
TETSTREAM_API const char *tetstream_comparison_message(const tetstream_comparison *comparison);

/* ------------------------------------------------------------------------------ file formats */

/* Row `index` of the table of file formats: name, extensions and one line, static, and whether it
 * is read and written. BAD_ARGUMENT past the end. Any pointer may be NULL. Since 0.1. */
TETSTREAM_API tetstream_status tetstream_format_at(int32_t index, const char **name,
                                                   const char **extensions, const char **text,
                                                   int32_t *can_read, int32_t *can_write);

#ifdef __cplusplus
}
#endif

#endif
