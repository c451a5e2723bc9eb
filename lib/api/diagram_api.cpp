// api: layout diagrams of the public header.
#include "handles.h"
#include "layout_page.h"
#include "named_input.h"
#include "sweep_page.h"

using namespace tetstream;

static void checkSize(int32_t places, const char* what) {
  if (places < 1 || places > TETSTREAM_DIAGRAM_LARGEST)
    fail(Status::kBadArgument, "a diagram of %d %s: 1 to %d are possible", places, what,
         TETSTREAM_DIAGRAM_LARGEST);
}

static void checkPage(int32_t page, bool none_will_do) {
  const bool known = page == TETSTREAM_PAGE_LAYOUT || page == TETSTREAM_PAGE_SWEEP;
  if (!known && !(none_will_do && page == 0))
    fail(Status::kBadArgument, "there is no page %d", page);
}

static void readInto(tetstream_diagram& d, tetstream_reader& reader, bool with_sweep,
                     const ProgressFunction& progress) {
  const Busy busy(d);
  ReaderUse use(reader);
  Input& input = use.input(false, d.options.temp_dir);
  d.diagram = readNamed(
      input, [&] { return readDiagram(input, d.size, with_sweep, d.options, use.told(progress)); });
  for (const DiagramColumn& column : d.diagram.layout->front()) {
    d.widths.push_back(column.width);
    d.lowest.push_back(column.lowest);
    d.newest.push_back(column.newest);
  }
  use.done();
}

template <class T>
static const T* dataOf(const std::vector<T>& values) {
  return values.empty() ? nullptr : values.data();
}

static tetstream_diagram_info publicInfo(const tetstream_diagram& d) {
  const LayoutDiagram& layout = *d.diagram.layout;
  const DiagramFigures& figures = layout.figures();
  tetstream_diagram_info out = {};
  out.cell_count = figures.cells;
  out.vertex_count = figures.vertices;
  out.front_width = figures.front.width;
  out.front_span = figures.front.span;
  out.front_cells = figures.front.cells;
  out.mean_width = figures.mean_width;
  out.mean_span = figures.mean_span;
  out.mean_life = figures.mean_life;
  out.longest_life = figures.longest_life;
  out.widest_cell = figures.widest_cell;
  out.longest_cell = figures.longest_cell;
  out.columns = static_cast<int32_t>(layout.columns());
  out.rows = static_cast<int32_t>(layout.rows());
  out.cells_per_column = layout.cellsPerColumn();
  out.vertices_per_row = layout.verticesPerRow();
  out.coverage = dataOf(layout.coverage());
  out.widths = dataOf(d.widths);
  out.lowest = dataOf(d.lowest);
  out.newest = dataOf(d.newest);
  return out;
}

// ------------------------------------------------------------------------------- the functions

tetstream_status tetstream_diagram_create(const tetstream_options* options, int32_t columns,
                                          int32_t rows, tetstream_diagram** diagram) {
  return guardCreate(__func__, diagram, [&](tetstream_diagram& d) {
    checkSize(columns, "columns");
    checkSize(rows, "rows");
    keepOptions(d, options);
    d.options.automatic = RunOptions::Auto::kKeeps;
    d.size = {static_cast<size_t>(columns), static_cast<size_t>(rows)};
  });
}

void tetstream_diagram_destroy(tetstream_diagram* diagram) {
  destroy(diagram);
}

tetstream_status tetstream_diagram_read(tetstream_diagram* diagram, tetstream_reader* reader,
                                        int32_t page, tetstream_progress_callback progress,
                                        void* user) {
  return guard(__func__, diagram, [&](tetstream_diagram& d) {
    needState(d, State::kReady);
    checkPage(page, true);
    needUnread(reader, "reader");
    d.state = State::kBroken;
    readInto(d, *reader, page == TETSTREAM_PAGE_SWEEP, progressOf(progress, user));
    d.state = State::kFinished;
  });
}

tetstream_status tetstream_diagram_get_info(const tetstream_diagram* diagram,
                                            tetstream_diagram_info* info) {
  return guard(__func__, diagram, [&](const tetstream_diagram& d) {
    checkStruct(info, "info");
    needState(d, State::kFinished);
    writeStruct(info, publicInfo(d));
  });
}

tetstream_status tetstream_diagram_write(tetstream_diagram* diagram, int32_t page, const char* path,
                                         const char* title) {
  return guard(__func__, diagram, [&](tetstream_diagram& d) {
    checkPage(page, false);
    needPlace(path, "path");
    needState(d, State::kFinished);
    const Diagram& found = d.diagram;
    const std::string words = title ? title : "";
    if (page == TETSTREAM_PAGE_LAYOUT) return drawLayout(path, *found.layout, words);
    if (!found.sweep) fail(Status::kBadState, "the diagram was read without a sweep");
    drawSweep(path, *found.sweep, found.layout->figures(), words);
  });
}

tetstream_status tetstream_diagram_check_path(const tetstream_diagram* diagram, const char* path) {
  return guard(__func__, diagram, [&](const tetstream_diagram&) {
    needPlace(path, "path");
    checkPicture(path);
  });
}

const char* tetstream_diagram_message(const tetstream_diagram* diagram) {
  return messageOf(diagram);
}
