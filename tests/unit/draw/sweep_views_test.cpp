// The moments of a sweep against the arrays of the mesh.
#include "sweep_views.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <memory>
#include <set>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

std::unique_ptr<SweepViews> viewsOf(const TestMesh& mesh, Cut cut) {
  cut.say_box = true;
  MeshStream stream(mesh, cut);
  auto views = std::make_unique<SweepViews>(stream.schema());
  BatchView batch;
  while (stream.next(batch)) views->put(batch);
  views->finish();
  return views;
}

// Cells read that touch a vertex which a later cell uses, and the active vertices, by definition.
void expectMoment(const TestMesh& mesh, const SweepViews::Moment& moment) {
  const size_t read = moment.cell;
  std::set<int64_t> needed, active;
  for (size_t i = 4 * read; i < mesh.cells.size(); ++i) needed.insert(mesh.cells[i]);
  int64_t highest = -1;
  for (size_t i = 0; i < 4 * read; ++i) highest = std::max(highest, mesh.cells[i]);
  for (int64_t v : needed)
    if (v <= highest) active.insert(v);
  uint64_t in_core = 0;
  for (size_t c = 0; c < read; ++c)
    in_core += std::any_of(&mesh.cells[4 * c], &mesh.cells[4 * c] + 4,
                           [&](int64_t v) { return active.count(v) > 0; });
  EXPECT_EQ(moment.vertices_in_core, active.size());
  EXPECT_EQ(moment.cells_in_core, in_core);
}

TEST(SweepViews, KnowWhatIsInCore) {
  const TestMesh swept = fullGrid(2, 2, 5);
  const TestMesh mixed = inStreamOrder(shuffled(swept, 3));
  for (const TestMesh* mesh : {&swept, &mixed}) {
    if (slowRun() && mesh == &swept) continue;
    const auto views = viewsOf(*mesh, {});
    ASSERT_EQ(views->moments().size(), SweepViews::kMoments);
    for (size_t i = 0; i < SweepViews::kMoments; ++i) {
      EXPECT_EQ(views->moments()[i].cell, mesh->cellCount() * (i + 1) / 5);
      expectMoment(*mesh, views->moments()[i]);
    }
  }
}

// Pixels of each tag; kNothing is 0.
std::vector<size_t> pixelsOf(const DepthImage& image) {
  std::vector<size_t> count(3);
  for (size_t y = 0; y < image.height(); ++y)
    for (size_t x = 0; x < image.width(); ++x) ++count[image.tag(x, y)];
  return count;
}

// A long bar, swept along: less and less of it is left, and always some of it is in core.
TEST(SweepViews, ShowLessAndLessToCome) {
  const auto views = viewsOf(fullGrid(10, 2, 2), {});
  const size_t whole = pixelsOf(views->whole())[SweepViews::kToCome];
  EXPECT_GT(whole, SweepViews::kWidth * SweepViews::kHeight / 10);
  size_t before = whole;
  for (const SweepViews::Moment& moment : views->moments()) {
    const std::vector<size_t> pixels = pixelsOf(moment.view);
    EXPECT_LT(pixels[SweepViews::kToCome], before);
    EXPECT_GT(pixels[SweepViews::kToCome], whole / 20);
    EXPECT_GT(pixels[SweepViews::kInCore], whole / 100);
    before = pixels[SweepViews::kToCome];
  }
}

// What is left is where the whole is, and never nearer.
TEST(SweepViews, ShowPartsOfTheWhole) {
  const auto views = viewsOf(shellGrid(4), {});
  for (const SweepViews::Moment& moment : views->moments())
    for (size_t y = 0; y < SweepViews::kHeight; ++y)
      for (size_t x = 0; x < SweepViews::kWidth; ++x) {
        if (moment.view.tag(x, y) == DepthImage::kNothing) continue;
        ASSERT_NE(views->whole().tag(x, y), DepthImage::kNothing);
        ASSERT_LE(views->whole().depth(x, y), moment.view.depth(x, y));
      }
}

void expectSame(const DepthImage& a, const DepthImage& b) {
  for (size_t y = 0; y < a.height(); ++y)
    for (size_t x = 0; x < a.width(); ++x) ASSERT_EQ(a.tag(x, y), b.tag(x, y));
}

TEST(SweepViews, DoNotDependOnTheBatches) {
  const TestMesh mesh = inStreamOrder(shuffled(fullGrid(2, 3, 2, 0.1, ScalarType::kFloat32), 5));
  const auto wanted = viewsOf(mesh, {});
  for (int form = slowRun() ? 2 : 0; form < 3; ++form) {
    Cut cut;
    cut.batch_cells = form == 0 ? 1 : 7;
    cut.all_vertices_first = form == 1;
    cut.empty_batches = form == 2;
    const auto views = viewsOf(mesh, cut);
    expectSame(views->whole(), wanted->whole());
    for (size_t i = 0; i < SweepViews::kMoments; ++i) {
      EXPECT_EQ(views->moments()[i].cells_in_core, wanted->moments()[i].cells_in_core);
      expectSame(views->moments()[i].view, wanted->moments()[i].view);
    }
  }
}

// The whole box is seen, whatever its shape, also a flat one; so all of the mesh is in the image.
TEST(Eye, SeesTheWholeBox) {
  const double boxes[][3] = {{1, 1, 1}, {1, 2, 30}, {500, 1, 1}, {0.01, 0.03, 0.02}, {4, 4, 0}};
  for (const auto& size : boxes)
    for (int begin = 0; begin < 8; ++begin) {
      Schema schema;
      double first[3];
      for (int a = 0; a < 3; ++a) {
        schema.box_min.push_back(-7);
        schema.box_max.push_back(-7 + size[a]);
        first[a] = begin >> a & 1 ? -7 + size[a] : -7;
      }
      const Eye eye(schema, first, 300, 200);
      for (int corner = 0; corner < 8; ++corner) {
        double at[3];
        for (int a = 0; a < 3; ++a) at[a] = corner >> a & 1 ? -7 + size[a] : -7;
        const Seen seen = eye.look(at);
        EXPECT_TRUE(seen.x > 0 && seen.x < 300 && seen.y > 0 && seen.y < 200);
      }
    }
}

// Of the corners above or below each other, the one where the stream begins is the nearest.
TEST(Eye, LooksFromWhereTheStreamBegins) {
  for (int begin = 0; begin < 8; ++begin) {
    Schema schema;
    schema.box_min = {0, 0, 0};
    schema.box_max = {3, 2, 1};  // right, up, toward the eye
    const auto corner = [](int bits, double* at) {
      for (int a = 0; a < 3; ++a) at[a] = bits >> a & 1 ? 3 - a : 0;
    };
    double first[3], other[3];
    corner(begin, first);
    const Eye eye(schema, first, 300, 200);
    for (int side = 1; side < 8; ++side) {
      if (side & 2) continue;
      corner(begin ^ side, other);
      EXPECT_LT(eye.look(first).depth, eye.look(other).depth) << begin << ", " << side;
    }
  }
}

// Right, down and away make a right-handed frame: the mesh is not shown in a mirror.
TEST(Eye, ShowsNoMirrorImage) {
  for (int order = 0; order < 6; ++order)
    for (int begin = 0; begin < 8; ++begin) {
      const double sizes[6][3] = {{3, 2, 1}, {3, 1, 2}, {2, 3, 1}, {2, 1, 3}, {1, 2, 3}, {1, 3, 2}};
      Schema schema;
      double first[3];
      for (int a = 0; a < 3; ++a) {
        schema.box_min.push_back(0);
        schema.box_max.push_back(sizes[order][a]);
        first[a] = begin >> a & 1 ? sizes[order][a] : 0;
      }
      const Eye eye(schema, first, 300, 200);
      const double places[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      Seen s[4];
      for (int i = 0; i < 4; ++i) s[i] = eye.look(places[i]);
      const double a[3] = {s[1].x - s[0].x, s[1].y - s[0].y, s[1].depth - s[0].depth};
      const double b[3] = {s[2].x - s[0].x, s[2].y - s[0].y, s[2].depth - s[0].depth};
      const double c[3] = {s[3].x - s[0].x, s[3].y - s[0].y, s[3].depth - s[0].depth};
      EXPECT_GT(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                    a[2] * (b[0] * c[1] - b[1] * c[0]),
                0);
    }
}

TEST(SweepViews, OfOneCellAndOfNothing) {
  const auto one = viewsOf(oneCell(), {});
  EXPECT_GT(pixelsOf(one->whole())[SweepViews::kToCome], 1000u);
  EXPECT_EQ(pixelsOf(one->moments()[0].view)[SweepViews::kInCore], 0u);
  Schema schema;
  schema.cell_count = 0;
  schema.box_min = schema.box_max = {0, 0, 0};
  SweepViews none(schema);
  none.finish();
  EXPECT_EQ(pixelsOf(none.whole())[DepthImage::kNothing], SweepViews::kWidth * SweepViews::kHeight);
}

// Fewer cells came than were announced.
TEST(SweepViews, TakeTheEndForMomentsThatNeverCame) {
  const TestMesh mesh = fullGrid(2, 2, 2);
  Cut cut;
  cut.say_box = true;
  MeshStream stream(mesh, cut);
  Schema schema = stream.schema();
  schema.cell_count = 1000000;
  SweepViews views(schema);
  BatchView batch;
  while (stream.next(batch)) views.put(batch);
  views.finish();
  for (const SweepViews::Moment& moment : views.moments()) {
    EXPECT_EQ(moment.cell, mesh.cellCount());
    EXPECT_EQ(moment.cells_in_core, 0u);
  }
}

TEST(SweepViews, NeedToKnowTheBoxAndTheCells) {
  Schema schema;
  EXPECT_FALSE(SweepViews::serves(schema));
  schema.cell_count = 5;
  EXPECT_FALSE(SweepViews::serves(schema));
  schema.box_min = schema.box_max = {0, 0, 0};
  EXPECT_TRUE(SweepViews::serves(schema));
  schema.cell_count = -1;
  EXPECT_FALSE(SweepViews::serves(schema));
}

TEST(SweepViews, RefuseABadStream) {
  TestMesh mesh = oneCell();
  Schema schema = mesh.schema;
  schema.cell_count = 1;
  schema.box_min = {0, 0, 0};
  schema.box_max = {1, 1, 1};
  SweepViews views(schema);
  mesh.cells[1] = 9;
  EXPECT_THROW(views.put(mesh.view()), Error);
}

}  // namespace
}  // namespace tetstream::test
