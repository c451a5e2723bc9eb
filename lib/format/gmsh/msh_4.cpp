// Entities, nodes and elements of Gmsh's formats 4.1 and 4.0: blocks, each of one entity.
#include <algorithm>
#include <cmath>
#include <utility>

#include "msh_mesh.h"
#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

// Numbers that say nothing to us.
void skipIntegers(MshMesh& mesh, uint64_t count, const char* what) {
  for (uint64_t i = 0; i < count; ++i) mesh.numbers.integer(kMshInt, what);
}

void skipReals(MshMesh& mesh, size_t count, const char* what) {
  double values[6];
  mesh.numbers.reals(values, count, kMshDouble, what);
}

void readEntity(MshMesh& mesh, int dimension, bool partitioned) {
  const int64_t tag = mesh.numbers.integer(kMshInt, "the tag of an entity");
  MshMesh::Entity entity = {0, tag, false};
  if (partitioned) {
    const int64_t parent_dimension = mesh.numbers.integer(kMshInt, "the parent of an entity");
    entity.label = mesh.numbers.integer(kMshInt, "the parent of an entity");
    entity.is_between_parts = parent_dimension != dimension;
    const uint64_t parts =
        mesh.numbers.count(mesh.size_bytes, 1, "the number of partitions of an entity");
    skipIntegers(mesh, parts, "a partition of an entity");
  }
  const bool has_place = dimension == 0 && !mesh.is_4_0;
  skipReals(mesh, has_place ? 3 : 6, "the box of an entity");
  const uint64_t groups =
      mesh.numbers.count(mesh.size_bytes, 1, "the number of physical groups of an entity");
  for (uint64_t i = 0; i < groups; ++i) {
    const int64_t group = mesh.numbers.integer(kMshInt, "a physical group of an entity");
    if (i == 0)
      entity.group = mesh.labelOf(dimension, std::abs(group));
    else
      mesh.further_groups.emplace(dimension, std::abs(group));
  }
  mesh.entities[{dimension, tag}] = entity;
  if (dimension == 0) return;
  const uint64_t bounds =
      mesh.numbers.count(mesh.size_bytes, 1, "the number of bounds of an entity");
  skipIntegers(mesh, bounds, "a bound of an entity");
}

// The head of a section of blocks: their number, and that of what is in all of them.
struct BlockCounts {
  uint64_t blocks, rows;
};

BlockCounts readCounts(MshMesh& mesh, size_t least_bytes, const char* blocks, const char* rows) {
  BlockCounts counts;
  counts.blocks = mesh.numbers.count(mesh.size_bytes, 1, blocks);
  counts.rows = mesh.numbers.count(mesh.size_bytes, least_bytes, rows);
  if (mesh.is_4_0) return counts;
  mesh.numbers.integer(mesh.size_bytes, "the smallest tag");
  mesh.numbers.integer(mesh.size_bytes, "the largest tag");
  return counts;
}

// Of a block: the dimension and the number of its entity, and a third number.
struct BlockHead {
  int dimension;
  int64_t entity, more;
};

BlockHead readHead(MshMesh& mesh, const char* what) {
  int64_t head[3];
  mesh.numbers.integers(head, 3, kMshInt, what);
  if (mesh.is_4_0) std::swap(head[0], head[1]);
  if (head[0] < 0 || head[0] > 3)
    mesh.file.failBad(textOf("an entity of dimension %lld", static_cast<long long>(head[0])));
  return {static_cast<int>(head[0]), head[1], head[2]};
}

// The number of rows of the next block, of which no more than `left` can be there.
uint64_t rowsOfBlock(MshMesh& mesh, uint64_t left, const char* what) {
  const uint64_t rows = mesh.numbers.count(mesh.size_bytes, 1, what);
  if (rows > left)
    mesh.file.failBad(textOf("%s is %llu, where only %llu are left", what,
                             static_cast<unsigned long long>(rows),
                             static_cast<unsigned long long>(left)));
  return rows;
}

void checkRead(MshMesh& mesh, uint64_t left, const char* what) {
  if (left == 0) return;
  mesh.file.failBad(textOf("the blocks hold %llu %s less than there should be",
                           static_cast<unsigned long long>(left), what));
}

void readNodeTags(MshMesh& mesh, uint64_t first, uint64_t count) {
  if (mesh.passTags4(count, first)) return;
  int64_t tags[kRowsAtOnce];
  mesh.numbers.expectRows(count, {{{false, 1}}});
  for (uint64_t done = 0; done < count;) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - done));
    mesh.numbers.integers(tags, n, mesh.size_bytes, "the tag of a node");
    for (size_t i = 0; i < n; ++i) {
      mesh.checkTag(tags[i]);
      mesh.points->add(tags[i], static_cast<int64_t>(first + done + i));
    }
    done += n;
  }
}

void readPositions(MshMesh& mesh, uint64_t count, size_t parameters) {
  const size_t width = 3 + parameters;
  if (mesh.placePositions4(count, width)) return;
  double rows[kRowsAtOnce];
  mesh.numbers.expectRows(count, {{{true, width}}});
  for (uint64_t done = 0; done < count;) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce / width, count - done));
    mesh.numbers.reals(rows, n * width, kMshDouble, "the position of a node");
    for (size_t i = 0; i < n; ++i) mesh.intake->addPoint(rows + i * width);
    done += n;
  }
}

// Of format 4.0 a row has both, and the parameters.
void readRows40(MshMesh& mesh, uint64_t first, uint64_t count, size_t parameters) {
  double of_entity[3];
  mesh.numbers.expectRows(count, {{{false, 1}, {true, 3 + parameters}}});
  for (uint64_t i = 0; i < count; ++i) {
    readNode(mesh, first + i);
    mesh.numbers.reals(of_entity, parameters, kMshDouble, "a parameter of a node");
  }
}

}  // namespace

void readEntities4(MshMesh& mesh, bool partitioned) {
  if (partitioned) {
    const int64_t parts = mesh.numbers.integer(mesh.size_bytes, "the number of partitions");
    if (mesh.options.note)
      mesh.options.note(mesh.file.name() + ": which of the " + std::to_string(parts) +
                        " parts of a partition cells are in is left out");
    const uint64_t ghosts = mesh.numbers.count(mesh.size_bytes, 2, "the number of ghost entities");
    skipIntegers(mesh, 2 * ghosts, "a ghost entity");
  }
  uint64_t counts[4];
  for (uint64_t& count : counts)
    count = mesh.numbers.count(mesh.size_bytes, 1, "the number of entities");
  for (int dimension = 0; dimension < 4; ++dimension)
    for (uint64_t i = 0; i < counts[dimension]; ++i) readEntity(mesh, dimension, partitioned);
}

uint64_t readRowCount4(MshMesh& mesh) {
  return readCounts(mesh, 4, "the number of blocks", "rows").rows;
}

void readNodes4(MshMesh& mesh) {
  mesh.beginNodes();
  const BlockCounts counts = readCounts(mesh, 8, "the number of blocks of nodes", "nodes");
  uint64_t left = mesh.node_rows = counts.rows;
  for (uint64_t block = 0; block < counts.blocks; ++block) {
    const BlockHead head = readHead(mesh, "a block of nodes");
    const size_t parameters = head.more ? static_cast<size_t>(head.dimension) : 0;
    const uint64_t rows = rowsOfBlock(mesh, left, "the number of nodes of a block");
    const uint64_t first = counts.rows - left;
    if (mesh.is_4_0) {
      readRows40(mesh, first, rows, parameters);
    } else {
      readNodeTags(mesh, first, rows);
      readPositions(mesh, rows, parameters);
    }
    left -= rows;
  }
  checkRead(mesh, left, "nodes");
  mesh.endNodes();
}

void readElements4(MshMesh& mesh) {
  const BlockCounts counts = readCounts(mesh, 4, "the number of blocks of elements", "elements");
  uint64_t left = mesh.element_rows = counts.rows;
  const size_t bytes = mesh.is_4_0 ? kMshInt : mesh.size_bytes;
  std::vector<int64_t> elements;
  for (uint64_t block = 0; block < counts.blocks; ++block) {
    const BlockHead head = readHead(mesh, "a block of elements");
    const CellKind* kind = mshKind(head.more);
    if (!kind)
      mesh.file.failHere(Status::kUnsupported,
                         "elements of type " + std::to_string(head.more) + ", which is not known");
    const auto found = mesh.entities.find({head.dimension, head.entity});
    const MshMesh::Entity entity =
        found != mesh.entities.end() ? found->second : MshMesh::Entity{0, head.entity, false};
    const uint64_t rows = rowsOfBlock(mesh, left, "the number of elements of a block");
    left -= rows;
    if (mesh.placeElements({*kind, rows, bytes, 0, entity.group, entity.label})) continue;
    const size_t width = 1 + static_cast<size_t>(kind->nodes);
    elements.resize(width * kRowsAtOnce);
    mesh.numbers.expectRows(rows, {{{false, width}}});
    for (uint64_t done = 0; done < rows;) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, rows - done));
      mesh.numbers.integers(elements.data(), n * width, bytes, "an element");
      for (size_t i = 0; i < n; ++i) {
        const int64_t* row = &elements[i * width];
        mesh.checkTag(row[0]);
        if (entity.is_between_parts)
          mesh.intake->leaveOut("elements between the parts of a partition");
        else
          mesh.addCell(*kind, row + 1, row[0], entity.group, entity.label);
      }
      done += n;
    }
  }
  checkRead(mesh, left, "elements");
}

}  // namespace tetstream
