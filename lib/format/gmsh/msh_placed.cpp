// Rows of Gmsh's binary files that are read where they lie.
#include "msh_mesh.h"
#include "status.h"
#include "stored_number.h"

namespace tetstream {

namespace {

// Of nodes: every reading of cells looks for them, fast where there are few runs of tags.
constexpr uint64_t kMostRuns = 64;

// Whether the integers that rows begin with count on from `tag`.
template <class Stored, bool kSwapped>
bool countsOn(const unsigned char* row, size_t row_bytes, size_t rows, int64_t tag) {
  uint64_t others = 0;
  for (size_t i = 0; i < rows; ++i, row += row_bytes)
    others |= static_cast<uint64_t>(storedNumber<Stored, kSwapped>(row)) -
              (static_cast<uint64_t>(tag) + i);
  return others == 0;
}

bool countsOn(const unsigned char* row, const RowsPlace& place, size_t width, size_t rows,
              int64_t tag) {
  const auto count = place.swapped
                         ? (width == 4 ? countsOn<int32_t, true> : countsOn<int64_t, true>)
                         : (width == 4 ? countsOn<int32_t, false> : countsOn<int64_t, false>);
  return count(row, place.row_bytes, rows, tag);
}

NumbersOfRow mshReals(size_t at_byte, size_t count) {
  return {at_byte, count, kMshDouble, true, false};
}

}  // namespace

void MshMesh::addTags(TagTable& table, const RowsPlace& rows, size_t width, uint64_t first) {
  FileWindow window(rows.file);
  forPlacedRows(window, rows, 0, rows.rows, [&](const unsigned char* row, size_t n, uint64_t at) {
    const int64_t first_tag = storedInteger(row, width, rows.swapped);
    if (first_tag >= 0 && first_tag <= kMostTag - static_cast<int64_t>(n) &&
        countsOn(row, rows, width, n, first_tag)) {
      table.addRun(first_tag, static_cast<int64_t>(first + at), static_cast<int64_t>(n));
      return true;
    }
    for (size_t i = 0; i < n; ++i, row += rows.row_bytes) {
      const int64_t tag = storedInteger(row, width, rows.swapped);
      if (tag < 0 || tag > kMostTag)
        fail(Status::kBadData, "%s: byte %llu: %lld is no tag", file.name().c_str(),
             static_cast<unsigned long long>(rows.begin + (at + i) * rows.row_bytes),
             static_cast<long long>(tag));
      table.add(tag, static_cast<int64_t>(first + at + i));
    }
    return true;
  });
}

bool MshMesh::placeNodes2(uint64_t count) {
  const auto rows = numbers.rowsHere(count, kMshInt + 3 * kMshDouble);
  if (!rows) return false;
  addTags(*points, *rows, kMshInt, 0);
  intake->placePoints(*rows, mshReals(kMshInt, 3));
  numbers.pass(*rows, "the nodes");
  return true;
}

bool MshMesh::passTags4(uint64_t count, uint64_t first) {
  const auto rows = numbers.rowsHere(count, size_bytes);
  if (!rows) return false;
  addTags(*points, *rows, size_bytes, first);
  numbers.pass(*rows, "the tags of nodes");
  return true;
}

bool MshMesh::placePositions4(uint64_t count, size_t reals_of_row) {
  const auto rows = numbers.rowsHere(count, reals_of_row * kMshDouble);
  if (!rows || !intake->mayPlacePoints()) return false;
  intake->placePoints(*rows, mshReals(0, 3));
  numbers.pass(*rows, "the positions of nodes");
  return true;
}

bool MshMesh::placeElements(const Elements& elements) {
  if (elements.kind.shape != CellShape::kTetra || !intake->mayPlaceCells()) return false;
  if (points->runs() > kMostRuns || static_cast<int32_t>(elements.group) != elements.group)
    return false;
  if (!version_4 && !hints.label_of.empty()) return false;  // groups are in the rows
  const size_t before = 1 + elements.others, width = elements.width;
  const auto rows =
      numbers.rowsHere(elements.count, width * (before + static_cast<size_t>(elements.kind.nodes)));
  if (!rows) return false;
  placed_.push_back({*rows, width, intake->cellCount()});
  intake->placeCells(elements.kind, {*rows, {width * before, width, true}, points, notThere});
  placeLabels(elements, *rows);
  numbers.pass(*rows, "the elements");
  return true;
}

// In the order of MshMesh::addCell.
void MshMesh::placeLabels(const Elements& elements, const RowsPlace& rows) {
  const size_t without_group = hints.physical.empty() ? 1 : 0;
  for (size_t k = 0; k < intake->labelColumns(); ++k) {
    const size_t label = k + without_group;
    if (version_4)
      intake->placeCellLabels(k, rows.rows, label == 0 ? elements.group : elements.entity);
    else if (label < elements.others)
      intake->placeCellLabels(k, rows, {kMshInt * (1 + label), 1, kMshInt, false, false});
    else
      intake->placeCellLabels(k, rows.rows, 0);
  }
}

void MshMesh::addPlacedTags() {
  for (const PlacedElements& p : placed_) addTags(cells, p.rows, p.width, p.first);
  placed_.clear();
}

bool MshMesh::placeData(size_t data, bool of_cells, uint64_t rows, size_t components) {
  const uint64_t wanted = of_cells ? intake->cellCount() : intake->mesh().pointCount();
  if (rows != wanted || !intake->mayPlaceData(data)) return false;
  const auto place = numbers.rowsHere(rows, kMshInt + components * kMshDouble);
  if (!place) return false;
  const auto window = std::make_shared<FileWindow>(place->file);
  TagTable& tags = of_cells ? cells : *points;
  int64_t tag = 0, count = 0, first = 0;
  const bool is_one_run =
      tags.isOneRun(&tag, &count, &first) && first == 0 && static_cast<uint64_t>(count) == rows;
  bool in_order = true;
  forPlacedRows(*window, *place, 0, rows, [&](const unsigned char* row, size_t n, uint64_t at) {
    if (is_one_run && countsOn(row, *place, kMshInt, n, tag + static_cast<int64_t>(at)))
      return true;
    for (size_t i = 0; i < n && in_order; ++i, row += place->row_bytes) {
      in_order = tags.find(storedInteger(row, kMshInt, place->swapped), &first, &count) &&
                 count == 1 && static_cast<uint64_t>(first) == at + i;
    }
    return in_order;
  });
  if (!in_order) return false;
  intake->placeData(data, *place, mshReals(kMshInt, components), window);
  numbers.pass(*place, "the values of data");
  return true;
}

}  // namespace tetstream
