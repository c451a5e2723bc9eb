#include "face_front.h"

#include <algorithm>

#include "cell_faces.h"
#include "mix.h"
#include "status.h"

namespace tetstream {

constexpr size_t kFirstTable = 4096;

FaceFront::FaceFront(Account& account, Events events)
    : events_(std::move(events)),
      vertices_(account),
      faces_(account),
      cell_held_(account),
      table_(account, kFirstTable),
      bodies_(account),
      boundaries_(account) {
  std::fill_n(table_.data(), table_.size(), kNone);
}

const TopologyFigures& FaceFront::figures() {
  figures_.components = bodies_.sets();
  figures_.boundary_components = boundaries_.sets();
  return figures_;
}

// ---------------------------------------------------------------------------------- the table

uint32_t& FaceFront::bucketOf(const uint32_t v[3]) {
  const uint64_t key = mix((uint64_t{v[0]} << 32 | v[1]) ^ mix(uint64_t{v[2]} + 1));
  return table_[static_cast<size_t>(key) & (table_.size() - 1)];
}

void FaceFront::growTable() {
  const size_t old = table_.size();
  table_.resize(2 * old);
  std::fill_n(table_.data(), table_.size(), kNone);
  for (uint32_t f = 0; f < faces_used_; ++f) {
    Face& face = faces_[f];
    if (face.cells == 0 || face.decided) continue;
    uint32_t& bucket = bucketOf(face.vertices);
    face.chain = bucket;
    bucket = f;
  }
}

uint32_t FaceFront::takeFace() {
  if (face_free_ != kNone) {
    const uint32_t face = face_free_;
    face_free_ = faces_[face].chain;
    return face;
  }
  if (faces_used_ == kNone / 3) fail(Status::kNoMemory, "the stream's front has too many faces");
  if (faces_used_ == faces_.size())
    faces_.resize(std::max<size_t>(1024, faces_.size() + faces_.size() / 2));
  return faces_used_++;
}

void FaceFront::makeRoomFor(uint32_t vertex) {
  const size_t old = vertices_.size();
  if (vertex < old) return;
  vertices_.resize(std::max<size_t>({1024, size_t{vertex} + 1, old + old / 2}));
  for (size_t v = old; v < vertices_.size(); ++v) vertices_[v] = {kNone, 0, kNone, kNone, 0};
}

// ---------------------------------------------------------------------------------- cells come

void FaceFront::addCell(uint32_t cell, const uint32_t vertices[4], int side) {
  for (int j = 0; j < 4; ++j) {
    makeRoomFor(vertices[j]);
    Vertex& vertex = vertices_[vertices[j]];
    if (vertex.body != kNone) continue;
    vertex.body = bodies_.make();
    vertex.held = 1;
  }
  for (int j = 1; j < 4; ++j)
    bodies_.join(vertices_[vertices[0]].body, vertices_[vertices[j]].body);
  if (cell >= cell_held_.size())
    cell_held_.resize(std::max<size_t>({1024, size_t{cell} + 1, 2 * cell_held_.size()}));
  cell_held_[cell] = 1;
  bool is_duplicate = false;
  for (int j = 0; j < 4; ++j) {
    const uint8_t* f = kOpposite[j];
    const uint32_t face[3] = {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
    is_duplicate = addFace(cell, face, vertices[j], side) || is_duplicate;
  }
  figures_.duplicate_cells += is_duplicate;
  letGoCell(cell);
  ++figures_.cells;
}

bool FaceFront::addFace(uint32_t cell, const uint32_t vertices[3], uint32_t apex, int side) {
  uint32_t v[3] = {vertices[0], vertices[1], vertices[2]};
  const auto order = [&](int i, int j) {
    if (v[i] < v[j]) return;
    std::swap(v[i], v[j]);
    side = -side;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  uint32_t* bucket = &bucketOf(v);
  for (uint32_t f = *bucket; f != kNone; f = faces_[f].chain)
    if (std::equal(v, v + 3, faces_[f].vertices)) return meetFace(faces_[f], cell, apex, side);
  if (open_faces_ == table_.size()) {
    growTable();
    bucket = &bucketOf(v);
  }
  const uint32_t f = takeFace();
  Face& face = faces_[f];
  face = {{v[0], v[1], v[2]},
          {},
          *bucket,
          cell,
          {apex, kNone},
          1,
          static_cast<int8_t>(side),
          0,
          0,
          0,
          0};
  *bucket = f;
  ++open_faces_;
  ++cell_held_[cell];
  for (uint32_t j = 0; j < 3; ++j) {
    Vertex& vertex = vertices_[v[j]];
    face.next[j] = vertex.faces;
    vertex.faces = 3 * f + j;
    ++vertex.held;
  }
  return false;
}

bool FaceFront::meetFace(Face& face, uint32_t cell, uint32_t apex, int side) {
  const bool is_known = apex == face.apexes[0] || apex == face.apexes[1];
  if (face.cells < UINT16_MAX) ++face.cells;
  if (face.cells == 2) {
    face.folded = side != 0 && side == face.side;
    face.apexes[1] = apex;
  }
  events_.neighbours(face.cell, cell);
  return is_known;
}

// ------------------------------------------------------------------------------- vertices end

void FaceFront::decide(uint32_t f) {
  Face& face = faces_[f];
  uint32_t* link = &bucketOf(face.vertices);
  while (*link != f) link = &faces_[*link].chain;
  *link = face.chain;
  --open_faces_;
  face.decided = 1;
  ++figures_.faces;
  figures_.nonmanifold_faces += face.cells > 2;
  figures_.folded_faces += face.cells == 2 && face.folded;
  if (face.cells == 1) {
    face.on_boundary = 1;
    ++figures_.boundary_faces;
    for (uint32_t v : face.vertices)
      if (vertices_[v].boundary == kNone) vertices_[v].boundary = boundaries_.make();
    for (int j = 1; j < 3; ++j)
      boundaries_.join(vertices_[face.vertices[0]].boundary, vertices_[face.vertices[j]].boundary);
    events_.boundary(face.vertices);
  }
  letGoCell(face.cell);
}

// Edges to vertices that are not final, each once.
void FaceFront::countEdges(uint32_t vertex) {
  if (++mark_ == 0) {  // after 2^32 vertices
    for (size_t v = 0; v < vertices_.size(); ++v) vertices_[v].mark = 0;
    mark_ = 1;
  }
  for (uint32_t corner = vertices_[vertex].faces; corner != kNone;) {
    const Face& face = faces_[corner / 3];
    for (uint32_t k = 0; k < 3; ++k) {
      Vertex& other = vertices_[face.vertices[k]];
      if (k == corner % 3 || (face.gone >> k & 1) || other.mark == mark_) continue;
      other.mark = mark_;
      ++figures_.edges;
    }
    corner = face.next[corner % 3];
  }
}

// The boundary's faces at a vertex, joined across the edges that have exactly two.
void FaceFront::lookAtFans(uint32_t vertex) {
  spokes_.clear();
  fan_.clear();
  for (uint32_t corner = vertices_[vertex].faces; corner != kNone;) {
    const Face& face = faces_[corner / 3];
    if (face.on_boundary) {
      for (uint32_t k = 0; k < 3; ++k)
        if (k != corner % 3)
          spokes_.push_back(
              {face.vertices[k], static_cast<uint32_t>(fan_.size()), (face.gone >> k & 1) != 0});
      fan_.push_back(static_cast<uint32_t>(fan_.size()));
    }
    corner = face.next[corner % 3];
  }
  if (fan_.empty()) return;
  ++figures_.boundary_vertices;
  std::sort(spokes_.begin(), spokes_.end(),
            [](const Spoke& a, const Spoke& b) { return a.vertex < b.vertex; });
  const auto root = [&](uint32_t f) {
    while (fan_[f] != f) f = fan_[f] = fan_[fan_[f]];
    return f;
  };
  size_t fans = fan_.size();
  for (size_t begin = 0, end; begin < spokes_.size(); begin = end) {
    for (end = begin; end < spokes_.size() && spokes_[end].vertex == spokes_[begin].vertex;) ++end;
    if (!spokes_[begin].is_gone) {
      ++figures_.boundary_edges;
      figures_.nonmanifold_edges += end - begin != 2;
    }
    if (end - begin != 2) continue;
    const uint32_t a = root(spokes_[begin].face), b = root(spokes_[begin + 1].face);
    fans -= a != b;
    fan_[a] = b;
  }
  figures_.nonmanifold_vertices += fans > 1;
}

void FaceFront::letGo(uint32_t vertex) {
  if (--vertices_[vertex].held > 0) return;
  vertices_[vertex] = {kNone, 0, kNone, kNone, 0};
  events_.vertex_done(vertex);
}

void FaceFront::letGoCell(uint32_t cell) {
  if (--cell_held_[cell] == 0) events_.cell_done(cell);
}

// A face goes with the last of its vertices; until then it keeps the others known.
void FaceFront::leaveFaces(uint32_t vertex) {
  for (uint32_t corner = vertices_[vertex].faces; corner != kNone;) {
    const uint32_t f = corner / 3, j = corner % 3;
    Face& face = faces_[f];
    corner = face.next[j];
    face.gone |= static_cast<uint8_t>(1u << j);
    if (face.gone != 7) continue;
    for (uint32_t v : face.vertices) letGo(v);
    face.cells = 0;
    face.chain = face_free_;
    face_free_ = f;
  }
}

void FaceFront::finalize(uint32_t vertex) {
  if (!isUsed(vertex)) return events_.vertex_done(vertex);
  for (uint32_t corner = vertices_[vertex].faces; corner != kNone;) {
    const uint32_t f = corner / 3;
    if (!faces_[f].decided) decide(f);
    corner = faces_[f].next[corner % 3];
  }
  countEdges(vertex);
  lookAtFans(vertex);
  bodies_.release(vertices_[vertex].body);
  if (vertices_[vertex].boundary != kNone) boundaries_.release(vertices_[vertex].boundary);
  ++figures_.vertices;
  leaveFaces(vertex);
  letGo(vertex);
}

}  // namespace tetstream
