#include "breadth_first_pieces.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

constexpr size_t kCellBytes = 150;  // of a piece, with its vertices and their traversal
constexpr size_t kLeastPiece = 4096, kLargestPiece = size_t{1} << 29;

PiecewiseBreadthFirst::PiecewiseBreadthFirst(size_t memory_bytes, Account& account,
                                             const std::string& temp_dir)
    : account_(account),
      piece_cells_(std::clamp(memory_bytes / 8 * 5 / kCellBytes, kLeastPiece, kLargestPiece)),
      corners_(account),
      vertex_(account),
      rank_of_(account),
      final_(account),
      local_of_(account),
      ranks_(sizeof(uint64_t), memory_bytes / 4, account, temp_dir) {}

uint32_t PiecewiseBreadthFirst::localOf(int64_t vertex) {
  const auto id = static_cast<uint64_t>(vertex);
  const uint32_t known = local_of_.find(id);
  if (known != kNoSlot) return known;
  if (vertices_ == vertex_.size()) {
    const size_t size = 2 * size_t{vertices_} + 1024;
    vertex_.resize(size);
    rank_of_.resize(size);
    final_.resize(size);
  }
  vertex_[vertices_] = vertex;
  rank_of_[vertices_] = kNoRank;
  final_[vertices_] = 0;
  local_of_.add(id, vertices_);
  return vertices_++;
}

void PiecewiseBreadthFirst::put(const BatchView& batch) {
  for (size_t c = 0; c < batch.cell_count; ++c) {
    if (cells_ >= piece_cells_) rankPiece();
    if (4 * size_t{cells_} == corners_.size())
      corners_.resize(std::min(2 * corners_.size() + 4096, 4 * piece_cells_));
    for (size_t j = 0; j < 4; ++j)
      corners_[4 * size_t{cells_} + j] = localOf(batch.cells[4 * c + j]);
    for (size_t j = 0; j < 4; ++j)
      if (batch.last_uses[c] >> j & 1) {
        final_[corners_[4 * size_t{cells_} + j]] = 1;
        local_of_.remove(static_cast<uint64_t>(batch.cells[4 * c + j]));
      }
    ++cells_;
  }
}

void PiecewiseBreadthFirst::finish() {
  rankPiece();
  ranks_.finish();
  corners_.resize(0);
  vertex_.resize(0);
  rank_of_.resize(0);
  final_.resize(0);
}

uint64_t PiecewiseBreadthFirst::next() {
  uint64_t vertex, rank;
  const unsigned char* payload = ranks_.next(&vertex);
  if (!payload) fail(Status::kInternal, "a vertex has no breadth-first rank");
  std::memcpy(&rank, payload, sizeof rank);
  return rank;
}

// Those of earlier pieces, in their order, are where the queue goes on.
void PiecewiseBreadthFirst::takeRanked(Traversal& traversal) {
  std::vector<std::pair<uint64_t, uint32_t>> ranked;
  for (uint32_t v = 0; v < vertices_; ++v)
    if (rank_of_[v] != kNoRank)
      ranked.emplace_back(rank_of_[v], v);
    else if (!final_[v])
      traversal.block(v);
  std::sort(ranked.begin(), ranked.end());
  for (const auto& [rank, v] : ranked) traversal.take(v);
}

void PiecewiseBreadthFirst::rankPiece() {
  {
    Connectivity mesh(account_);
    mesh.vertices = vertices_;
    mesh.cells = cells_;
    mesh.corners.swap(corners_);
    Meeting meet(account_);
    meet.find(mesh, account_);
    Array<uint32_t> order(account_, vertices_);
    Traversal traversal(mesh, meet, account_, order);
    takeRanked(traversal);
    const uint32_t before = traversal.taken();
    traversal.goOn();
    for (uint32_t v = 0; v < vertices_; ++v) traversal.from(v);  // in the order of the stream
    for (uint32_t k = before; k < traversal.taken(); ++k) {
      const uint32_t v = traversal.vertexAt(k);
      rank_of_[v] = ranked_++;
      std::memcpy(ranks_.add(static_cast<uint64_t>(vertex_[v])), &rank_of_[v], sizeof(uint64_t));
    }
    mesh.corners.swap(corners_);
  }
  keepOpenCells();
  // A front that is nearly as large as the piece: the next one has to be larger.
  if (cells_ > piece_cells_ / 2) piece_cells_ *= 2;
}

// Cells with a vertex that is not ranked, and their vertices.
void PiecewiseBreadthFirst::keepOpenCells() {
  Array<uint32_t> place(account_, vertices_);
  std::fill_n(place.data(), vertices_, kUnused);
  uint32_t kept = 0;
  for (uint32_t c = 0; c < cells_; ++c) {
    const uint32_t* v = &corners_[4 * size_t{c}];
    if (std::none_of(v, v + 4, [this](uint32_t x) { return rank_of_[x] == kNoRank; })) continue;
    for (size_t j = 0; j < 4; ++j) {
      place[v[j]] = 0;
      corners_[4 * size_t{kept} + j] = v[j];
    }
    ++kept;
  }
  local_of_.clear();
  uint32_t end = 0;
  for (uint32_t v = 0; v < vertices_; ++v) {
    if (place[v] == kUnused) continue;
    vertex_[end] = vertex_[v];
    rank_of_[end] = rank_of_[v];
    final_[end] = final_[v];
    if (!final_[end]) local_of_.add(static_cast<uint64_t>(vertex_[end]), end);
    place[v] = end++;
  }
  for (size_t i = 0; i < 4 * size_t{kept}; ++i) corners_[i] = place[corners_[i]];
  cells_ = kept;
  vertices_ = end;
}

}  // namespace tetstream
