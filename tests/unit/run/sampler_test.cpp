// The sample of a stream: whole bricks, held at their cuts, and what they tell of the whole.
#include "sampler.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "batch_copy.h"
#include "memory_source.h"
#include "ordered_source.h"
#include "run.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

// Detail in the first half of x, nothing in the second.
TestMesh halfDetailed(int length, int width) {
  TestMesh mesh = fullGrid(length, width, width, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [=](double x, double y, double z) {
    return x < 0.5 * length ? std::sin(x) * std::cos(1.3 * y) * std::sin(0.9 * z) : 0;
  });
  mesh.addCellData({"d", 1, ScalarType::kFloat32}, [](size_t c, int) { return double(c % 5); });
  return mesh;
}

OrderOptions alongX() {
  OrderOptions options;
  options.axis = "x";
  return options;
}

struct Swept {
  explicit Swept(TestMesh& mesh) : indexed(mesh.schema, mesh.view()), stream(indexed, alongX()) {}
  MemorySource indexed;
  OrderedSource stream;
};

// Both readings, of which `use` gets the second one's batches.
template <class Use>
void read(Swept& swept, Sampler& sampler, Use use) {
  const std::unique_ptr<Source> first = swept.stream.again(Part::kAll);
  BatchView batch;
  while (first->next(batch)) sampler.count(batch);
  sampler.takeBricks();
  while (swept.stream.next(batch)) {
    sampler.put(batch);
    use(batch);
  }
}

// What a sample of the mesh tells of a simplification to the ratio.
Pilot pilotOf(TestMesh& mesh, double ratio) {
  Swept swept(mesh);
  SimplifyOptions options;
  options.ratio = ratio;
  Sampler sampler(swept.stream.schema(), options);
  read(swept, sampler, [](const BatchView&) {});
  return sampler.simplify();
}

using Place = std::array<double, 3>;

Place placeIn(const BatchView& batch, size_t row) {
  Place p;
  std::copy_n(static_cast<const double*>(batch.positions) + 3 * row, 3, p.data());
  return p;
}

std::array<Place, 4> placesOf(const BatchView& batch, size_t cell) {
  std::array<Place, 4> places;
  for (size_t j = 0; j < 4; ++j)
    places[j] = placeIn(batch, static_cast<size_t>(batch.cells[4 * cell + j]));
  return places;
}

TEST(Sampler, TakesWholeBricksAndHoldsTheirCuts) {
  TestMesh mesh = halfDetailed(slowRun() ? 20 : 40, 12);
  Swept swept(mesh);
  Sampler sampler(swept.stream.schema(), {});
  std::map<Place, int> uses, sampled;  // cells of a vertex
  std::vector<Place> places;
  size_t cells = 0;
  read(swept, sampler, [&](const BatchView& batch) {
    for (size_t v = 0; v < batch.vertex_count; ++v) places.push_back(placeIn(batch, v));
    for (size_t i = 0; i < 4 * batch.cell_count; ++i)
      ++uses[places[static_cast<size_t>(batch.cells[i])]];
    cells += batch.cell_count;
  });
  const BatchView sample = sampler.mesh();
  EXPECT_EQ(sampler.schema().cell_count, static_cast<int64_t>(sample.cell_count));
  EXPECT_GT(sample.cell_count, cells / 4);
  EXPECT_LT(sample.cell_count, cells);  // those across cuts are missing
  for (size_t i = 0; i < 4 * sample.cell_count; ++i)
    ++sampled[placeIn(sample, static_cast<size_t>(sample.cells[i]))];
  int held = 0, free = 0;
  for (size_t v = 0; v < sample.vertex_count; ++v) {
    const Place place = placeIn(sample, v);
    if (sampled[place] == 0) continue;
    const bool is_cut = sampled[place] < uses[place];
    EXPECT_EQ(sample.locked && sample.locked[v], is_cut);
    ++(is_cut ? held : free);
  }
  EXPECT_GT(held, 0);
  // Of a small mesh the bricks are small, too, and most of their vertices at the cuts.
  EXPECT_GT(free, held / (slowRun() ? 10 : 2));
}

// Both readings in parts: a stretch begins some batches before its own.
void readInStretches(Swept& swept, Sampler& sampler, size_t count) {
  Account account;
  std::vector<std::unique_ptr<BatchCopy>> batches;
  const std::unique_ptr<Source> all = swept.stream.again(Part::kAll);
  BatchView batch;
  for (; all->next(batch); batches.back()->take(batch))
    batches.push_back(std::make_unique<BatchCopy>(all->schema(), account));
  const auto beginOf = [&](size_t stretch) { return stretch * batches.size() / count; };
  sampler.countInStretches(count);
  std::vector<Stretch::Begin> begins(count);
  std::vector<size_t> first(count);
  for (size_t k = 0; k < count; ++k) {
    uint64_t cells = 0;
    for (size_t b = 0; b < batches.size(); ++b) {
      const BatchView& view = batches[b]->view();
      if (b >= beginOf(k) && b < beginOf(k + 1)) sampler.count(view, k);
      if (b == beginOf(k)) begins[k].vertex = view.first_vertex, begins[k].cell = cells;
      cells += view.cell_count;
    }
    for (size_t b = 0; b < beginOf(k); ++b) {
      const BatchView& view = batches[b]->view();
      const bool is_needed =
          view.first_vertex + view.vertex_count + sampler.reach() > begins[k].vertex;
      if (is_needed) break;
      first[k] = b + 1;
      begins[k].first_cell += view.cell_count;
    }
  }
  sampler.takeBricks(begins);
  for (size_t k = count; k-- > 0;)  // in any order
    for (size_t b = first[k]; b < beginOf(k + 1); ++b) sampler.put(batches[b]->view(), k);
  if (!slowRun()) {
    EXPECT_GT(first[count - 1], 0u);
  }
}

void expectSame(const BatchView& a, const BatchView& b) {
  ASSERT_EQ(a.vertex_count, b.vertex_count);
  ASSERT_EQ(a.cell_count, b.cell_count);
  EXPECT_EQ(std::memcmp(a.positions, b.positions, 24 * a.vertex_count), 0);
  EXPECT_EQ(std::memcmp(a.fields[0], b.fields[0], 8 * a.vertex_count), 0);
  EXPECT_EQ(std::memcmp(a.cells, b.cells, 32 * a.cell_count), 0);
  EXPECT_EQ(std::memcmp(a.cell_data[0], b.cell_data[0], 4 * a.cell_count), 0);
  ASSERT_TRUE(a.locked && b.locked);
  EXPECT_EQ(std::memcmp(a.locked, b.locked, a.vertex_count), 0);
}

// Also where bricks are full before all has come: of what lies in one place.
TEST(Sampler, TakesTheSameInStretches) {
  TestMesh mesh = halfDetailed(slowRun() ? 20 : 100, slowRun() ? 12 : 26);
  for (const bool crowded : {false, true}) {
    Swept swept(mesh), again(mesh);
    Schema schema = swept.stream.schema();
    for (size_t i = 0; crowded && i < 3; ++i) schema.box_max[i] += 300;
    Sampler whole(schema, {});
    read(swept, whole, [](const BatchView&) {});
    const BatchView sample = whole.mesh();
    EXPECT_GT(sample.cell_count, 0u);
    const Pilot pilot = whole.simplify();
    for (const size_t count : {2, 3}) {
      if (slowRun() && count == 2) continue;
      Sampler sampler(schema, {});
      readInStretches(again, sampler, count);
      expectSame(sampler.mesh(), sample);
      EXPECT_EQ(sampler.simplify().share, pilot.share);
    }
  }
}

// Those of a wide span would have large tables.
TEST(Sampler, HasFewerStretchesWhereSpansAreWide) {
  TestMesh mesh = halfDetailed(4, 4);
  const Swept swept(mesh);
  Schema schema = swept.stream.schema();
  size_t most = 9;
  for (const int64_t span : {1, 1 << 20, 1 << 21, 1 << 22}) {
    schema.front_span = span;
    const size_t stretches = Sampler(schema, {}).mostStretches();
    EXPECT_LT(stretches, most);
    most = stretches;
  }
  EXPECT_EQ(most, 1u);
}

// More vertices are active at once than announced: those whose rows others have taken are left out
// with their cells. So many vertices without cells come between the others and their cells that
// they take the rows of half of them.
TEST(Sampler, TakesNoWrongCellsWhereTheSpanIsALie) {
  TestMesh mesh = halfDetailed(12, 12);
  Swept swept(mesh);
  Schema schema = swept.stream.schema();
  schema.front_span = 0;
  BatchView all = mesh.view(), vertices = all, others = all, cells = all;
  vertices.cell_count = cells.vertex_count = others.cell_count = 0;
  Sampler sampler(schema, {});
  sampler.count(vertices);
  sampler.takeBricks();
  sampler.put(vertices);
  const size_t count = mesh.vertexCount(), end = (1 << 15) + count / 2;
  for (size_t rank = count; rank < end; rank += others.vertex_count) {
    others.first_vertex = rank;
    others.vertex_count = std::min(count, end - rank);
    sampler.put(others);
  }
  cells.first_vertex = end;
  sampler.put(cells);
  const BatchView sample = sampler.mesh();
  ASSERT_GT(sample.cell_count, 0u);
  ASSERT_LT(sample.cell_count, mesh.cellCount() / 2);
  std::set<std::array<Place, 4>> wanted;
  for (size_t c = 0; c < all.cell_count; ++c) wanted.insert(placesOf(all, c));
  for (size_t c = 0; c < sample.cell_count; ++c)
    EXPECT_TRUE(wanted.count(placesOf(sample, c))) << "cell " << c;
}

// All of the mesh lies in a corner of the box, in one cell of the grid, where a brick is cut
// without knowing. If it has any of the mesh it has all, and takes four times what it should have.
TEST(Sampler, TakesNoMoreThanABrickOfWhatLiesInOnePlace) {
  size_t met = 0;
  for (int length : {12, 13, 14})  // other numbers of vertices: cut elsewhere
    for (int corner = 0; corner < 8; ++corner) {
      TestMesh mesh = halfDetailed(length, 12);
      const uint64_t most = 4 * (mesh.vertexCount() / 16);  // of sixteen bricks
      Swept swept(mesh);
      Schema schema = swept.stream.schema();
      for (size_t i = 0; i < 3; ++i)
        (corner >> i & 1 ? schema.box_min[i] : schema.box_max[i]) += corner >> i & 1 ? -1e9 : 1e9;
      Sampler sampler(schema, {});
      read(swept, sampler, [](const BatchView&) {});
      const size_t vertices = sampler.mesh().vertex_count;
      EXPECT_TRUE(vertices == 0 || vertices == most) << vertices << " of " << most;
      met += vertices > 0;
      EXPECT_FALSE(sampler.simplify().known());  // of one place
    }
  EXPECT_GT(met, 0u);
}

TEST(Sampler, TellsWhereTheCellsShouldBeLeft) {
  TestMesh mesh = halfDetailed(slowRun() ? 30 : 60, slowRun() ? 14 : 16);
  const Pilot pilot = pilotOf(mesh, 0.2);
  ASSERT_TRUE(pilot.known());
  EXPECT_EQ(pilot.shareOf(0), 0);
  EXPECT_EQ(pilot.shareOf(1), 1);
  for (double part = 0; part < 0.95; part += 0.05)
    EXPECT_LE(pilot.shareOf(part), pilot.shareOf(part + 0.05));
  EXPECT_GT(pilot.shareOf(0.5), 0.65);
}

// What the stream locks stays, and so that part of it needs more than the others.
TEST(Sampler, TellsOfPartsThatAreLocked) {
  TestMesh mesh = fullGrid(slowRun() ? 30 : 60, 16, 16, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x) * std::cos(y + z); });
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    mesh.locked.push_back(mesh.position(v, 0) > (slowRun() ? 15 : 30));
  const Pilot pilot = pilotOf(mesh, 0.6);
  ASSERT_TRUE(pilot.known());
  EXPECT_FALSE(pilot.isEven());
  EXPECT_LT(pilot.shareOf(0.5), 0.4);
}

// What comes at the same time has detail and has none: nothing tells what a part should keep.
TEST(Sampler, TellsTheSameOfAllWhereTheStreamIsAsUnevenThroughout) {
  TestMesh mesh = fullGrid(slowRun() ? 30 : 60, 16, 16, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return y < 8 && z > 8 ? std::sin(x) * std::cos(1.3 * y) * std::sin(0.9 * z) : 0.001 * x;
  });
  const Pilot pilot = pilotOf(mesh, 0.3);
  ASSERT_TRUE(pilot.known());
  EXPECT_TRUE(pilot.isEven());
  EXPECT_EQ(pilot.shareOf(0.25), 0.25);
}

// As if no brick lay where these cells do: what they should keep is told by the cells before and
// after them, which have detail, too, not by all.
TEST(Sampler, TellsOfPartsThatItHasNotMet) {
  TestMesh mesh = halfDetailed(slowRun() ? 30 : 60, slowRun() ? 14 : 16);
  SimplifyOptions options;
  options.ratio = 0.2;
  Swept swept(mesh);
  Sampler sampler(swept.stream.schema(), options);
  const std::unique_ptr<Source> first = swept.stream.again(Part::kAll);
  BatchView batch;
  while (first->next(batch)) sampler.count(batch);
  sampler.takeBricks();
  constexpr double kFrom = 0.1, kTo = 0.3;
  const auto all = static_cast<double>(mesh.cellCount());
  const std::vector<int64_t> nowhere(4 * mesh.cellCount(), int64_t{1} << 40);
  double seen = 0;
  while (swept.stream.next(batch)) {
    BatchView cells = batch;
    if (seen >= kFrom * all && seen < kTo * all) cells.cells = nowhere.data();
    sampler.put(cells);
    seen += static_cast<double>(batch.cell_count);
  }
  const Pilot pilot = sampler.simplify();
  ASSERT_TRUE(pilot.known());
  const double unmet = (pilot.shareOf(0.28) - pilot.shareOf(0.14)) / 0.14;
  EXPECT_GT(unmet, 0.8 * pilot.shareOf(0.5) / 0.5);  // 0.5, were it told by all
}

// The sample keeps a quarter of its free vertices. Where more are wanted no part can keep more than
// all of them, and one of which nothing was left there is not given up.
TEST(Sampler, SpreadsTheCellsForAnyTarget) {
  TestMesh mesh = halfDetailed(slowRun() ? 30 : 60, slowRun() ? 14 : 16);
  for (double ratio : {0.9, 0.6, 0.01}) {
    const Pilot pilot = pilotOf(mesh, ratio);
    ASSERT_TRUE(pilot.known());
    for (double part = 0; part < 1; part += 0.125) {
      const double share = pilot.shareOf(part + 0.125) - pilot.shareOf(part);
      EXPECT_LE(ratio * share, 1.01 * 0.125) << ratio << ", " << part;
      EXPECT_GT(share, 0.01 * 0.125) << ratio << ", " << part;
    }
  }
}

TEST(Sampler, ServesStreamsThatTellEnough) {
  TestMesh mesh = halfDetailed(4, 4);
  const Swept swept(mesh);
  const Schema schema = swept.stream.schema();
  EXPECT_TRUE(Sampler::serves(schema, {}));
  for (int k = 0; k < 5; ++k) {
    Schema other = schema;
    if (k == 0) other.cell_count = -1;
    if (k == 1) other.front_span = -1;
    if (k == 2) other.front_span = int64_t{1} << 40;  // whoever claims so
    if (k == 3) other.box_min.clear();
    if (k == 4) other.box_max[1] = other.box_min[1];
    EXPECT_FALSE(Sampler::serves(other, {})) << k;
  }
  Schema bare = schema;
  bare.fields.clear();
  bare.box_min.resize(3);
  bare.box_max.resize(3);
  EXPECT_FALSE(Sampler::serves(bare, {}));
}

// With a budget there is room for a sample that tells something, and for the rows of a span.
TEST(Sampler, ServesWhereABudgetHasRoom) {
  TestMesh mesh = halfDetailed(12, 12);
  const Swept swept(mesh);
  Schema schema = swept.stream.schema();
  SimplifyOptions options;
  for (int64_t budget : {1000, 1000000}) {
    options.memory_bytes = budget;
    EXPECT_FALSE(Sampler::serves(schema, options)) << budget;
  }
  options.memory_bytes = 7000000;
  EXPECT_TRUE(Sampler::serves(schema, options));
  schema.front_span = 1 << 20;
  schema.front_width = 2000;
  EXPECT_FALSE(Sampler::serves(schema, options));
  options.memory_bytes = 17000000;
  EXPECT_TRUE(Sampler::serves(schema, options));
}

TEST(Sampler, PaysWhereABudgetLeavesManyWindowsOfSomeFronts) {
  Schema schema;
  schema.cell_count = 10000000;
  schema.front_cells = 10000;
  SimplifyOptions options;
  options.ratio = 0.01;
  EXPECT_TRUE(Sampler::pays(schema, options)) << "large samples do at any ratio";
  options.memory_bytes = 8000000;
  EXPECT_FALSE(Sampler::pays(schema, options)) << "small ones only where more is left";
  options.memory_bytes = 64000000;
  EXPECT_TRUE(Sampler::pays(schema, options)) << "nor are they small in a large budget";
  options.memory_bytes = 8000000;
  options.ratio = 0.1;
  EXPECT_TRUE(Sampler::pays(schema, options));
  options.error = 1;
  EXPECT_FALSE(Sampler::pays(schema, options)) << "no cells are asked for";
  options.error = 0;
  schema.front_cells = 80000;
  EXPECT_FALSE(Sampler::pays(schema, options)) << "the window has little more than the front";
  schema.front_cells = 10000;
  schema.cell_count = 200000;
  EXPECT_FALSE(Sampler::pays(schema, options)) << "the window has a large part of all cells";
}

// Cells that grow with y and z, to some thousand times what they are at first.
void grade(TestMesh& mesh, double width) {
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int axis : {1, 2}) {
      const double place = mesh.position(v, axis);
      mesh.setPosition(v, axis, std::pow(place / width, 3) * width);
    }
}

struct SampledRun {
  size_t pilots = 0;  // how often it told of one
  Report report;
};
SampledRun simplifiedAsSampled(TestMesh& mesh, const SimplifyOptions& options) {
  RunOptions all;
  all.simplify = options;
  Recorder out;
  SampledRun result;
  double told = 0;
  SimplifyRun run(all, out, [&](const Progress& p) {
    result.pilots += p.phase == std::string("pilot");
    EXPECT_GE(p.fraction, told);
    told = p.fraction;
  });
  Input input;
  input.indexed = std::make_unique<MemorySource>(mesh.schema, mesh.view());
  run.run(input);
  result.report = run.report();
  EXPECT_EQ(result.report.reached, "ratio");
  return result;
}

// Returns the error with the sample over that without.
double expectSampled(TestMesh& mesh, SimplifyOptions options) {
  const SampledRun sampled = simplifiedAsSampled(mesh, options);
  EXPECT_GT(sampled.pilots, 0u);
  if (slowRun()) return 0;
  options.pilot = PilotUse::kNever;
  const SampledRun plain = simplifiedAsSampled(mesh, options);
  EXPECT_EQ(plain.pilots, 0u);
  return sampled.report.estimated_error / plain.report.estimated_error;
}

// Larger than a pilot reads whole: the sample spares the half that needs cells, also where most
// cells lie in a small part of the box. A slow run samples with a budget alone, of fewer cells.
TEST(SimplifyRun, SamplesALongStream) {
  if (slowRun()) return;
  TestMesh mesh = halfDetailed(49, 30);
  grade(mesh, 30);
  ASSERT_GT(mesh.cellCount(), size_t{1} << 18);
  SimplifyOptions options;
  options.ratio = 0.2;
  options.window_cells = 40000;
  EXPECT_LT(expectSampled(mesh, options), 0.85);
}

TEST(SimplifyRun, SamplesWithABudget) {
  TestMesh mesh = halfDetailed(slowRun() ? 120 : 200, 14);
  SimplifyOptions options;
  options.ratio = 0.2;
  options.memory_bytes = 4000000;
  EXPECT_LT(expectSampled(mesh, options), 0.92);
  const auto expectNotSampled = [&](const SimplifyOptions& o) {
    if (slowRun()) return;
    EXPECT_EQ(simplifiedAsSampled(mesh, o).pilots, 0u) << o.ratio << ", " << o.memory_bytes;
  };
  for (double ratio : {0.04, 0.01}) {  // too strong for so small a sample
    SimplifyOptions strong = options;
    strong.ratio = ratio;
    expectNotSampled(strong);
  }
  // A budget that has room for all of it, for a quarter, or for hardly a sample.
  for (int64_t budget : {100000000, 12000000, 2000000}) {
    options.memory_bytes = budget;
    expectNotSampled(options);
  }
}

}  // namespace
}  // namespace tetstream::test
