// measure/scan: the topology of a mesh stream and its boundary, in memory of the size of its front.
// Depends on stream, joined_sets.h.
//
// A face is decided when the first of its vertices is final: no further cell can have it. So faces
// are classified, edges counted and the fans of the boundary's vertices looked at as vertices end.
#pragma once

#include <functional>
#include <vector>

#include "joined_sets.h"

namespace tetstream {

struct TopologyFigures {
  int64_t cells = 0, vertices = 0, edges = 0, faces = 0;
  int64_t components = 0;         // of cells joined through vertices
  int64_t nonmanifold_faces = 0;  // with more than two cells
  int64_t folded_faces = 0;       // with both cells on the same side
  int64_t duplicate_cells = 0;    // whose four vertices are those of one before
  int64_t boundary_faces = 0, boundary_edges = 0, boundary_vertices = 0;
  int64_t boundary_components = 0;   // joined through vertices
  int64_t nonmanifold_edges = 0;     // of the boundary: not exactly two faces
  int64_t nonmanifold_vertices = 0;  // of the boundary: more than one fan of faces
  int64_t euler() const { return vertices - edges + faces - cells; }
  int64_t boundaryEuler() const { return boundary_vertices - boundary_edges + boundary_faces; }
};

class FaceFront {
 public:
  struct Events {
    std::function<void(const uint32_t vertices[3])> boundary;         // a face of one cell
    std::function<void(uint32_t first, uint32_t second)> neighbours;  // two cells at a face
    std::function<void(uint32_t cell)> cell_done;                     // it is named no more
    std::function<void(uint32_t vertex)> vertex_done;                 // it is named no more
  };
  FaceFront(Account& account, Events events);

  // Vertices and cells are the caller's small numbers, used again once they are done. `side`: sign
  // of the cell's volume.
  void addCell(uint32_t cell, const uint32_t vertices[4], int side);
  // No further cell has it. A vertex without cells is done at once.
  void finalize(uint32_t vertex);
  bool isUsed(uint32_t vertex) const {
    return vertex < vertices_.size() && vertices_[vertex].faces != kNone;
  }
  const TopologyFigures& figures();  // of what is final

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  struct Vertex {
    uint32_t faces;           // corner 3 * face + j of the list of its faces
    uint32_t held;            // by faces, and until it is final
    uint32_t body, boundary;  // in the sets
    uint32_t mark;
  };
  struct Face {
    uint32_t vertices[3];  // rising
    uint32_t next[3];      // in the lists of the vertices
    uint32_t chain;        // in the table; of free ones the next
    uint32_t cell;         // the first one
    uint32_t apexes[2];    // of the first two: the vertex that is not of the face
    uint16_t cells;
    int8_t side;  // on which the first cell lies; 0: it is flat
    uint8_t folded : 1, decided : 1, on_boundary : 1, gone : 3;
  };
  // Each returns whether a cell of these four vertices is known: of the first two at the face.
  bool addFace(uint32_t cell, const uint32_t vertices[3], uint32_t apex, int side);
  bool meetFace(Face& face, uint32_t cell, uint32_t apex, int side);
  uint32_t takeFace();
  void makeRoomFor(uint32_t vertex);
  uint32_t& bucketOf(const uint32_t vertices[3]);
  void growTable();
  void decide(uint32_t face);
  void countEdges(uint32_t vertex);
  void lookAtFans(uint32_t vertex);
  void leaveFaces(uint32_t vertex);
  void letGo(uint32_t vertex);
  void letGoCell(uint32_t cell);

  Events events_;
  TopologyFigures figures_;
  Array<Vertex> vertices_;
  Array<Face> faces_;
  Array<uint8_t> cell_held_;  // by faces of which it is the first
  Array<uint32_t> table_;
  size_t open_faces_ = 0;
  uint32_t faces_used_ = 0, face_free_ = kNone, mark_ = 0;
  JoinedSets bodies_, boundaries_;
  struct Spoke {
    uint32_t vertex, face;  // an edge of the boundary from the vertex in hand, a face at it
    bool is_gone;
  };
  std::vector<Spoke> spokes_;  // of one vertex
  std::vector<uint32_t> fan_;
};

}  // namespace tetstream
