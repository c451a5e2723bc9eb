// Nodes and elements of Gmsh's formats 2 and 1, which has the same nodes.
#include <algorithm>

#include "msh_mesh.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr int64_t kMostTags = 4096;     // of one element: groups and partitions
constexpr int64_t kMostMshNodes = 125;  // of one element
constexpr size_t kElementsAtOnce = 256;

void addElement(MshMesh& mesh, CellKind kind, int64_t tag, const int64_t* tags, size_t tag_count,
                const int64_t* nodes) {
  const int64_t group = tag_count > 0 ? mesh.labelOf(dimensionOf(kind.shape), tags[0]) : 0;
  mesh.addCell(kind, nodes, tag, group, tag_count > 1 ? tags[1] : 0);
}

CellKind needKind(MshMesh& mesh, int64_t number) {
  if (const CellKind* kind = mshKind(number)) return *kind;
  mesh.file.failHere(Status::kUnsupported,
                     "an element of type " + std::to_string(number) + ", which is not known");
}

// Integers, of which nobody knows how many there are: most elements have fewer.
void expectElements(MshMesh& mesh, uint64_t count) {
  constexpr uint64_t kMostExpected = 32;
  mesh.file.expectRows(count, {{{false, kMostExpected}}});
}

void readTextElements(MshMesh& mesh, uint64_t count) {
  std::vector<int64_t> tags(static_cast<size_t>(kMostTags));
  int64_t nodes[kMostMshNodes];
  expectElements(mesh, count);
  for (uint64_t i = 0; i < count; ++i) {
    int64_t head[3];  // number, type, tags
    mesh.file.integers(head, 3, "an element");
    const CellKind kind = needKind(mesh, head[1]);
    if (head[0] < 0 || head[0] > kMostTag || head[2] < 0 || head[2] > kMostTags)
      mesh.file.failBad(textOf("element %lld has %lld tags", static_cast<long long>(head[0]),
                               static_cast<long long>(head[2])));
    const int64_t tag = head[0], tag_count = head[2];
    mesh.file.integers(tags.data(), static_cast<size_t>(tag_count), "a tag of an element");
    mesh.file.integers(nodes, static_cast<size_t>(kind.nodes), "a node of an element");
    addElement(mesh, kind, tag, tags.data(), static_cast<size_t>(tag_count), nodes);
  }
  mesh.file.endRows();
}

void readBlocks(MshMesh& mesh, uint64_t count) {
  std::vector<int64_t> rows;
  while (count > 0) {
    int64_t head[3];  // type, elements, tags of each
    mesh.numbers.integers(head, 3, kMshInt, "a block of elements");
    const CellKind kind = needKind(mesh, head[0]);
    if (head[1] < 1 || static_cast<uint64_t>(head[1]) > count)
      mesh.file.failBad(textOf("a block of %lld elements, where %llu are left",
                               static_cast<long long>(head[1]),
                               static_cast<unsigned long long>(count)));
    if (head[2] < 0 || head[2] > kMostTags)
      mesh.file.failBad(textOf("elements with %lld tags", static_cast<long long>(head[2])));
    const auto tags = static_cast<size_t>(head[2]);
    const size_t width = 1 + tags + static_cast<size_t>(kind.nodes);
    count -= static_cast<uint64_t>(head[1]);
    // note: blocks of one are Gmsh's, where one element may be there for several groups.
    if (head[1] > 1 &&
        mesh.placeElements({kind, static_cast<uint64_t>(head[1]), kMshInt, tags, 0, 0}))
      continue;
    rows.resize(kElementsAtOnce * width);
    for (auto left = static_cast<size_t>(head[1]); left > 0;) {
      const size_t n = std::min(left, kElementsAtOnce);
      mesh.numbers.integers(rows.data(), n * width, kMshInt, "an element");
      for (size_t i = 0; i < n; ++i) {
        const int64_t* row = &rows[i * width];
        mesh.checkTag(row[0]);
        addElement(mesh, kind, row[0], row + 1, tags, row + 1 + tags);
      }
      left -= n;
    }
  }
}

}  // namespace

static void beginNodes2(MshMesh& mesh) {
  mesh.beginNodes();
  mesh.node_rows = static_cast<uint64_t>(mesh.file.integer("the number of nodes", 0, INT64_MAX));
  mesh.file.checkClaim(mesh.node_rows, mesh.numbers.binary() ? kMshInt + 3 * kMshDouble : 8,
                       "nodes");
  if (mesh.numbers.binary()) mesh.file.line();
}

void readNode(MshMesh& mesh, uint64_t rank) {
  double position[3];
  const int64_t tag = mesh.numbers.integer(kMshInt, "the number of a node");
  mesh.checkTag(tag);
  mesh.numbers.reals(position, 3, kMshDouble, "the position of a node");
  mesh.points->add(tag, static_cast<int64_t>(rank));
  mesh.intake->addPoint(position);
}

void readNodes2(MshMesh& mesh) {
  beginNodes2(mesh);
  if (mesh.placeNodes2(mesh.node_rows)) return mesh.endNodes();
  mesh.numbers.expectRows(mesh.node_rows, {{{false, 1}, {true, 3}}});
  for (uint64_t i = 0; i < mesh.node_rows; ++i) readNode(mesh, i);
  mesh.endNodes();
}

// Behind each node its entity's dimension and number, and a parameter on a curve, two on a surface.
void readParametricNodes2(MshMesh& mesh) {
  beginNodes2(mesh);
  for (uint64_t i = 0; i < mesh.node_rows; ++i) {
    int64_t entity[2];
    double parameters[2];
    readNode(mesh, i);
    mesh.numbers.integers(entity, 2, kMshInt, "the entity of a node");
    if (entity[0] < 0 || entity[0] > 3)
      mesh.file.failBad(textOf("an entity of dimension %lld", static_cast<long long>(entity[0])));
    if (entity[0] == 1 || entity[0] == 2)
      mesh.numbers.reals(parameters, static_cast<size_t>(entity[0]), kMshDouble,
                         "a parameter of a node");
  }
  mesh.endNodes();
}

static uint64_t beginElements2(MshMesh& mesh) {
  mesh.element_rows =
      static_cast<uint64_t>(mesh.file.integer("the number of elements", 0, INT64_MAX));
  mesh.file.checkClaim(mesh.element_rows, mesh.numbers.binary() ? 2 * kMshInt : 8, "elements");
  return mesh.element_rows;
}

// Each tells its number, type, group, entity and how many nodes it has.
void readElements1(MshMesh& mesh) {
  const uint64_t count = beginElements2(mesh);
  int64_t nodes[kMostMshNodes];
  expectElements(mesh, count);
  for (uint64_t i = 0; i < count; ++i) {
    int64_t head[5];
    mesh.file.integers(head, 5, "an element");
    mesh.checkTag(head[0]);
    const CellKind kind = needKind(mesh, head[1]);
    if (head[4] != kind.nodes)
      mesh.file.failBad(textOf("element %lld has %lld nodes, not %d",
                               static_cast<long long>(head[0]), static_cast<long long>(head[4]),
                               kind.nodes));
    mesh.file.integers(nodes, static_cast<size_t>(kind.nodes), "a node of an element");
    mesh.addCell(kind, nodes, head[0], head[2], head[3]);
  }
  mesh.file.endRows();
}

void readElements2(MshMesh& mesh) {
  const uint64_t count = beginElements2(mesh);
  if (!mesh.numbers.binary()) return readTextElements(mesh, count);
  mesh.file.line();
  readBlocks(mesh, count);
}

}  // namespace tetstream
