// The diagram against one that draws every line cell by cell.
#include "layout_diagram.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <memory>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

// Per vertex the cells [first, end) during which it is active, by definition.
struct Life {
  int64_t first, end;
};

std::vector<Life> livesOf(const TestMesh& mesh) {
  const auto cells = static_cast<int64_t>(mesh.cellCount());
  std::vector<Life> lives(mesh.vertexCount(), {cells, cells});
  size_t introduced = 0;
  for (int64_t c = 0; c < cells; ++c)
    for (size_t j = 0; j < 4; ++j) {
      const auto v = static_cast<size_t>(mesh.cells[4 * static_cast<size_t>(c) + j]);
      for (; introduced <= v; ++introduced) lives[introduced].first = c;
      lives[v].end = c + 1;
    }
  return lives;
}

std::unique_ptr<LayoutDiagram> diagramOf(const TestMesh& mesh, const Cut& cut, size_t columns,
                                         size_t rows) {
  MeshStream stream(mesh, cut);
  auto diagram = std::make_unique<LayoutDiagram>(stream.schema(), columns, rows);
  BatchView batch;
  while (stream.next(batch)) diagram->put(batch);
  diagram->finish();
  return diagram;
}

// Every place of the raster: what its vertices cover of its cells.
void expectRaster(const LayoutDiagram& diagram, const std::vector<Life>& lives, int64_t cells) {
  const int64_t width = diagram.cellsPerColumn(), height = diagram.verticesPerRow();
  const auto vertices = static_cast<int64_t>(lives.size());
  ASSERT_EQ(diagram.columns(), static_cast<size_t>((cells + width - 1) / width));
  ASSERT_EQ(diagram.rows(), static_cast<size_t>((vertices + height - 1) / height));
  for (size_t r = 0; r < diagram.rows(); ++r)
    for (size_t c = 0; c < diagram.columns(); ++c) {
      const int64_t from = static_cast<int64_t>(c) * width, to = std::min(from + width, cells);
      const int64_t top = static_cast<int64_t>(r) * height;
      const int64_t bottom = std::min(top + height, vertices);
      int64_t covered = 0;
      for (int64_t v = top; v < bottom; ++v) {
        const Life& life = lives[static_cast<size_t>(v)];
        covered += std::max<int64_t>(0, std::min(to, life.end) - std::max(from, life.first));
      }
      const double share =
          static_cast<double>(covered) / static_cast<double>((to - from) * (bottom - top));
      ASSERT_NEAR(diagram.coverage()[r * diagram.columns() + c], share, 1e-6)
          << "row " << r << ", column " << c;
    }
}

struct Seen {
  int64_t width = 0, lowest = -1, newest = -1;
};

Seen frontAt(const std::vector<Life>& lives, int64_t cell) {
  Seen seen;
  for (size_t v = 0; v < lives.size(); ++v) {
    if (lives[v].first <= cell) seen.newest = static_cast<int64_t>(v);
    if (lives[v].first > cell || lives[v].end <= cell) continue;
    if (seen.lowest < 0) seen.lowest = static_cast<int64_t>(v);
    ++seen.width;
  }
  return seen;
}

void expectFront(const LayoutDiagram& diagram, const std::vector<Life>& lives, int64_t cells) {
  double widths = 0, spans = 0;
  std::vector<DiagramColumn> columns(diagram.columns());
  for (int64_t at = 0; at < cells; ++at) {
    const Seen seen = frontAt(lives, at);
    DiagramColumn& column = columns[static_cast<size_t>(at / diagram.cellsPerColumn())];
    column.lowest = column.width == 0 ? seen.lowest : std::min(column.lowest, seen.lowest);
    column.width = std::max(column.width, seen.width);
    column.newest = seen.newest;
    widths += static_cast<double>(seen.width);
    spans += static_cast<double>(seen.newest - seen.lowest + 1);
    const DiagramFigures& f = diagram.figures();
    const int64_t span = seen.newest - seen.lowest + 1;
    EXPECT_LE(seen.width, f.front.width - (at < f.widest_cell));
    EXPECT_LE(span, f.front.span - (at < f.longest_cell));
    EXPECT_TRUE(at != f.widest_cell || seen.width == f.front.width);
    EXPECT_TRUE(at != f.longest_cell || span == f.front.span);
  }
  for (size_t c = 0; c < columns.size(); ++c) {
    EXPECT_EQ(diagram.front()[c].width, columns[c].width) << "column " << c;
    EXPECT_EQ(diagram.front()[c].lowest, columns[c].lowest) << "column " << c;
    EXPECT_EQ(diagram.front()[c].newest, columns[c].newest) << "column " << c;
  }
  EXPECT_DOUBLE_EQ(diagram.figures().mean_width, widths / static_cast<double>(cells));
  EXPECT_DOUBLE_EQ(diagram.figures().mean_span, spans / static_cast<double>(cells));
}

void expectLives(const LayoutDiagram& diagram, const std::vector<Life>& lives) {
  int64_t longest = 0, sum = 0;
  for (const Life& life : lives) {
    longest = std::max(longest, life.end - life.first);
    sum += life.end - life.first;
  }
  EXPECT_EQ(diagram.figures().longest_life, longest);
  EXPECT_DOUBLE_EQ(diagram.figures().mean_life,
                   static_cast<double>(sum) / static_cast<double>(lives.size()));
}

void expectDiagram(const TestMesh& mesh, const std::vector<Life>& lives, size_t columns,
                   size_t rows, const Cut& cut) {
  const auto cells = static_cast<int64_t>(mesh.cellCount());
  const auto diagram = diagramOf(mesh, cut, columns, rows);
  EXPECT_EQ(diagram->figures().cells, cells);
  EXPECT_EQ(diagram->figures().vertices, static_cast<int64_t>(lives.size()));
  EXPECT_LE(diagram->columns(), columns);
  EXPECT_LE(diagram->rows(), rows);
  expectRaster(*diagram, lives, cells);
  expectFront(*diagram, lives, cells);
  expectLives(*diagram, lives);
}

TEST(LayoutDiagram, IsTheOneDrawnCellByCell) {
  const TestMesh swept = fullGrid(3, 2, slowRun() ? 2 : 4);
  const TestMesh mixed = inStreamOrder(shuffled(swept, 3));
  for (const TestMesh* mesh : {&swept, &mixed})
    for (size_t size : {1, 2, 7, 16, 1000})
      for (bool known : {true, false}) {
        Cut cut;
        cut.batch_cells = 5;
        cut.say_counts = known;
        expectDiagram(*mesh, livesOf(*mesh), size, size, cut);
        expectDiagram(*mesh, livesOf(*mesh), size, 3, cut);
        expectDiagram(*mesh, livesOf(*mesh), 5, size, cut);
      }
}

// Half of the places at least are used, also where they had to be shared more and more.
TEST(LayoutDiagram, KeepsItsResolution) {
  const TestMesh mesh = fullGrid(4, 4, 4);
  for (bool known : {true, false})
    for (size_t size : {4, 9, 32}) {
      Cut cut;
      cut.say_counts = known;
      const auto diagram = diagramOf(mesh, cut, size, size);
      EXPECT_GE(diagram->columns(), size / 2);
      EXPECT_GE(diagram->rows(), size / 2);
    }
}

// Vertices that no cell uses come and go at the end; those that nobody finalizes stay to the end.
TEST(LayoutDiagram, DrawsWhatTheStreamLeavesOpen) {
  const TestMesh mesh = fullGrid(2, 2, 2);
  const auto cells = static_cast<int64_t>(mesh.cellCount());
  std::vector<Life> lives = livesOf(mesh);
  for (Life& life : lives) life.end = cells;
  LayoutDiagram diagram(mesh.schema, 6, 6);
  TestMesh copy = mesh;
  diagram.put(copy.view());  // nothing is finalized
  diagram.finish();
  expectRaster(diagram, lives, cells);
  expectLives(diagram, lives);
}

TEST(LayoutDiagram, DrawsUnusedVerticesAsNothing) {
  TestMesh mesh = oneCell();
  mesh.positions.bytes.resize(mesh.positions.bytes.size() * 2);
  BatchView batch = mesh.view();
  const int64_t order[] = {6, 0, 1, 2, 3, 4, 5, 7};
  batch.finalized = order;
  batch.finalized_count = 8;
  LayoutDiagram diagram(mesh.schema, 8, 8);
  diagram.put(batch);
  diagram.finish();
  ASSERT_EQ(diagram.columns(), 1u);
  ASSERT_EQ(diagram.rows(), 8u);
  EXPECT_EQ(diagram.coverage(), (std::vector<float>{1, 1, 1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(diagram.figures().longest_life, 1);
}

TEST(LayoutDiagram, OfOneCell) {
  const auto diagram = diagramOf(oneCell(), {}, 1000, 1000);
  EXPECT_EQ(diagram->columns(), 1u);
  EXPECT_EQ(diagram->rows(), 4u);
  EXPECT_EQ(diagram->coverage(), (std::vector<float>{1, 1, 1, 1}));
  EXPECT_EQ(diagram->figures().front.width, 4);
  EXPECT_EQ(diagram->figures().mean_life, 1);
}

TEST(LayoutDiagram, OfNothing) {
  const auto diagram = diagramOf(makeMesh(ScalarType::kFloat64, {}, {}), {}, 10, 10);
  EXPECT_EQ(diagram->columns(), 0u);
  EXPECT_EQ(diagram->rows(), 0u);
  EXPECT_TRUE(diagram->coverage().empty());
  EXPECT_EQ(diagram->figures().mean_width, 0);
  EXPECT_EQ(diagram->figures().widest_cell, -1);
}

// The schema's counts are hopes: both ways they are wrong, the diagram is right.
TEST(LayoutDiagram, DoesNotTrustTheCounts) {
  const TestMesh mesh = fullGrid(3, 3, 2);
  const std::vector<Life> lives = livesOf(mesh);
  for (int64_t count : {int64_t{1}, int64_t{10}, int64_t{1000000}}) {
    Schema schema = mesh.schema;
    schema.cell_count = schema.vertex_count = count;
    LayoutDiagram diagram(schema, 12, 12);
    MeshStream stream(mesh, {});
    BatchView batch;
    while (stream.next(batch)) diagram.put(batch);
    diagram.finish();
    expectRaster(diagram, lives, static_cast<int64_t>(mesh.cellCount()));
    expectFront(diagram, lives, static_cast<int64_t>(mesh.cellCount()));
  }
}

TEST(LayoutDiagram, RefusesABadStream) {
  TestMesh mesh = oneCell();
  LayoutDiagram diagram(mesh.schema, 10, 10);
  mesh.cells[1] = 9;
  EXPECT_THROW(diagram.put(mesh.view()), Error);
}

}  // namespace
}  // namespace tetstream::test
