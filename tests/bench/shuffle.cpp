// shuffle KIND CELLS OUT.vtu [SEED]: the mesh that `tetstream generate` makes as an indexed mesh
// whose points and cells are in random order: the worst that a layout can meet. Holds the mesh in
// memory.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>

#include "generate.h"
#include "random.h"
#include "registry.h"
#include "status.h"

namespace tetstream {
namespace {

using Bytes = std::vector<unsigned char>;

struct Mesh {
  Schema schema;
  std::vector<size_t> widths;  // bytes of a row: of positions, then of each field
  std::vector<Bytes> columns;
  std::vector<uint32_t> cells;
  size_t vertices = 0;
};

Mesh collect(Source& source) {
  Mesh mesh;
  mesh.schema = source.schema();
  mesh.widths.push_back(3 * sizeOf(mesh.schema.position_type));
  for (const Column& c : mesh.schema.fields) mesh.widths.push_back(c.bytesPerRow());
  mesh.columns.resize(mesh.widths.size());
  BatchView batch;
  while (source.next(batch)) {
    for (size_t k = 0; k < mesh.columns.size(); ++k) {
      const auto* rows =
          static_cast<const unsigned char*>(k == 0 ? batch.positions : batch.fields[k - 1]);
      mesh.columns[k].insert(mesh.columns[k].end(), rows,
                             rows + batch.vertex_count * mesh.widths[k]);
    }
    for (size_t i = 0; i < 4 * batch.cell_count; ++i)
      mesh.cells.push_back(static_cast<uint32_t>(batch.cells[i]));
    mesh.vertices += batch.vertex_count;
  }
  return mesh;
}

std::vector<uint32_t> permutation(size_t count, Random& random) {
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<uint32_t>(i))]);
  return order;
}

// All points, then all cells: what is written as an indexed mesh stays in that order.
void write(const Mesh& mesh, uint64_t seed, Sink& out) {
  Random random(seed);
  const std::vector<uint32_t> old_point = permutation(mesh.vertices, random);
  std::vector<uint32_t> place(mesh.vertices);
  for (size_t i = 0; i < mesh.vertices; ++i) place[old_point[i]] = static_cast<uint32_t>(i);
  Batch batch(mesh.schema);
  out.begin(mesh.schema);
  for (size_t at = 0; at < mesh.vertices;) {
    batch.clear(at);
    for (; at < mesh.vertices && batch.vertexCount() < kBatchCells; ++at) {
      const size_t row = batch.addVertices(1);
      for (size_t k = 0; k < mesh.columns.size(); ++k)
        std::memcpy(k == 0 ? batch.position(row) : batch.field(k - 1, row),
                    mesh.columns[k].data() + mesh.widths[k] * old_point[at], mesh.widths[k]);
    }
    out.put(batch.view());
  }
  const std::vector<uint32_t> old_cell = permutation(mesh.cells.size() / 4, random);
  for (size_t at = 0; at < old_cell.size();) {
    batch.clear(mesh.vertices);
    for (; at < old_cell.size() && batch.cellCount() < kBatchCells; ++at) {
      const size_t row = batch.addCells(1);
      for (size_t j = 0; j < 4; ++j)
        batch.cell(row)[j] = place[mesh.cells[4 * size_t{old_cell[at]} + j]];
    }
    out.put(batch.view());
  }
  out.finish();
}

int run(int argc, char** argv) {
  if (argc < 4 || argc > 5) {
    std::fprintf(stderr, "usage: shuffle KIND CELLS OUT.vtu [SEED]\n");
    return 1;
  }
  const std::unique_ptr<Source> source =
      generate(argv[1], static_cast<int64_t>(std::strtod(argv[2], nullptr)), 1);
  const Mesh mesh = collect(*source);
  WriteOptions options;
  options.compress = false;
  const std::unique_ptr<Sink> out = needFormat("", argv[3]).create(createFile(argv[3]), options);
  write(mesh, argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1, *out);
  return 0;
}

}  // namespace
}  // namespace tetstream

int main(int argc, char** argv) {
  try {
    return tetstream::run(argc, argv);
  } catch (const tetstream::Error& error) {
    std::fprintf(stderr, "shuffle: %s\n", error.text().c_str());
    return 1;
  }
}
