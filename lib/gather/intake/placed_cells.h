// gather/intake: tetrahedra that lie in a part of a file, one to a row, read where they lie.
// Depends on column_rows.h, file_window.h, tag_table.h.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "column_rows.h"
#include "file_window.h"
#include "tag_table.h"

namespace tetstream {

struct CornersOfRow {
  size_t at_byte = 0;      // of the row: four corners' tags, each of
  size_t width = 4;        // bytes, 4 or 8
  bool is_tagged = false;  // the row begins with its own tag, of that width
};

struct PlacedCellsPlan {
  RowsPlace place;
  CornersOfRow corners;
  std::shared_ptr<TagTable> points;  // their ranks; finished
  // What is said of a corner that is no point, after the name of the file and the byte.
  std::function<std::string(int64_t tag_of_row, int64_t corner)> missing;
};

// A cell as int64: the ranks of its corners. Every reading checks that they are points: the file
// may have changed since.
std::shared_ptr<RowReader> placeCells(std::shared_ptr<FileWindow> window, PlacedCellsPlan plan);

}  // namespace tetstream
