#include "mesh_pieces.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

constexpr size_t kMaxNotes = 64;

void MeshPieces::addNoteTo(std::vector<std::string>& notes, const std::string& text) {
  if (notes.size() < kMaxNotes && std::find(notes.begin(), notes.end(), text) == notes.end())
    notes.push_back(text);
}

void MeshPieces::add(MeshPiece piece) {
  if (pieces.size() == kMaxMeshPieces)
    fail(Status::kUnsupported, "%s: there are too many pieces", name.c_str());
  piece.first_point = point_count;
  piece.first_cell = cell_count;
  if (piece.point_count > kMaxMeshCount - point_count ||
      piece.cell_count > kMaxMeshCount - cell_count)
    fail(Status::kBadData, "%s: there are more points or cells than any file can hold",
         name.c_str());
  point_count += piece.point_count;
  cell_count += piece.cell_count;
  pieces.push_back(std::move(piece));
}

}  // namespace tetstream
