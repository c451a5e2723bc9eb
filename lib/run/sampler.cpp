#include "sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "simplifier.h"

namespace tetstream {

// As large a part of the stream as its time and memory are worth, in bricks that have enough inside
// their cuts: one of 46,000 cells takes 5 % more time in all of 1.8 million, one of 80,000 13 %.
// Samples of 1.5e5 cells instead of 1e5 made errors of 1e7 and 1.4e7 cells 18 % smaller; bricks of
// 4000 cells instead of 2500, and so fewer of them, 7 to 20 % larger.
constexpr double kPart = 1.0 / 40, kLeastSample = 4e4, kLargestSample = 1.5e5;
constexpr double kBrick = 2500, kFewestBricks = 16;
constexpr int64_t kLargestSpan = 1 << 22;   // the table of rows: 32 MB at most
constexpr size_t kLargestTables = 1 << 23;  // those of all stretches together, in rows: as much
constexpr size_t kMostStretches = 8;
constexpr uint64_t kDeclaredAhead = 1 << 15;  // vertices that a batch brings before their cells
// A brick that has more than so many times the vertices that it should have is no longer filled.
constexpr uint64_t kFullest = 4;
constexpr double kCellsPerCollapse = 5.5;
// Of a memory budget the grid gets a sixth, the sample and its window most of the rest: what they
// take is foreseen for any front, from arrays that have grown by doubling and few cells a vertex.
constexpr int64_t kGridPart = 6, kAnyFront = 1 << 20;
constexpr double kFilled = 0.8, kGrowth = 2, kCellsOfVertex = 3;
constexpr size_t kNotedBytes = 16;  // of a vertex
// Cells in over cells out: by more than this a sample misleads that a budget makes smaller (fluid
// of 6e5 cells in 3 to 5 MB: at a ratio of 0.02 up to 1.5 times the error, at 0.01 2.6 times; at
// 0.05 it helps). Without any, a stream that begins with nothing gives its boundary too much: a
// plume and a shock of 2e6 cells at 0.02 in 16 and 64 MB had 5 and 3 times the error that they have
// with one.
constexpr int64_t kSampledReduction = 20;
constexpr double kLeastWorth = 8000;  // cells: of less nothing is learnt
// A sample is simplified to this share of its free vertices: between the cuts, which are locked,
// fewer are often impossible.
constexpr double kLeft = 0.25;

static double volumeOfBox(const Schema& schema) {
  double volume = 1;
  for (size_t i = 0; i < 3; ++i) volume *= schema.box_max[i] - schema.box_min[i];
  return volume;
}

static uint64_t reachOf(const Schema& schema) {
  return static_cast<uint64_t>(schema.front_span) + kDeclaredAhead;
}

// Of a memory budget.
static int64_t gridBytes(const SimplifyOptions& options) {
  if (options.memory_bytes == 0) return Bricks::kGridBytes;
  return std::min(options.memory_bytes / kGridPart, Bricks::kGridBytes);
}

// What a sample does not have: labelled faces, which say nothing of errors, and this front.
static Schema withoutFront(Schema schema) {
  schema.front_width = schema.front_span = schema.front_cells = schema.face_count = -1;
  return schema;
}

// Rows of the sample with what is noted of them, in bytes.
static double sampleBytes(const Schema& schema, double cells, double vertices) {
  size_t cell = 4 * sizeof(int64_t) + 2, vertex = 3 * sizeOf(schema.position_type) + kNotedBytes;
  for (const Column& c : schema.cell_data) cell += c.bytesPerRow();
  for (const Column& c : schema.fields) vertex += c.bytesPerRow();
  return kGrowth * (cells * static_cast<double>(cell) + vertices * static_cast<double>(vertex));
}

// As many cells as a memory budget has room for, in the sample and in the window that has it whole.
static double fittingCells(const Schema& stream, const SimplifyOptions& options) {
  if (options.memory_bytes == 0) return kLargestSample;
  Schema schema = withoutFront(stream);
  schema.cell_count = -1;
  schema.front_cells = kAnyFront;
  SimplifyOptions any = options;
  any.memory_bytes -= gridBytes(options);
  any.window_cells = 0;
  const auto bytes = static_cast<double>(any.memory_bytes);
  const double window = bytes / static_cast<double>(Simplifier::windowCells(schema, any));
  return kFilled * bytes / (window + sampleBytes(schema, 1, 1 / kCellsOfVertex));
}

// What it should be, with as much memory as it likes.
static double wantedSample(const Schema& schema) {
  const auto cells = static_cast<double>(schema.cell_count);
  return std::min(std::clamp(kPart * cells, kLeastSample, kLargestSample), cells);
}

static double sampleOf(const Schema& schema, const SimplifyOptions& options) {
  return std::min(wantedSample(schema), fittingCells(schema, options));
}

bool Sampler::serves(const Schema& schema, const SimplifyOptions& options) {
  if (schema.cell_count <= 0 || schema.vertex_count <= 0 || schema.front_span < 0 ||
      schema.front_span > kLargestSpan)
    return false;
  const auto is_float = [](const Column& c) { return isFloat(c.type); };
  if (!schema.hasBox() || std::none_of(schema.fields.begin(), schema.fields.end(), is_float))
    return false;
  const double volume = volumeOfBox(schema);
  if (!std::isfinite(volume) || volume <= 0) return false;
  if (options.memory_bytes == 0) return true;
  const uint64_t table = std::bit_ceil(reachOf(schema)) * sizeof(uint32_t);
  return table <= static_cast<uint64_t>(options.memory_bytes) / 2 &&
         sampleOf(schema, options) >= kLeastWorth;
}

// A bound on the error needs to know no cells. With a memory budget few windows come to know more,
// and those with hardly more than a front do not heed a sample.
bool Sampler::pays(const Schema& schema, const SimplifyOptions& options) {
  if (options.error > 0) return false;
  if (options.memory_bytes == 0) return true;
  const int64_t cells = schema.cell_count, window = Simplifier::windowCells(schema, options);
  const bool is_strong = cells / kSampledReduction > Simplifier::targetCells(schema, options);
  if (is_strong && sampleOf(schema, options) < wantedSample(schema)) return false;
  return cells / kFewWindows >= window &&
         static_cast<double>(window) >= kLeastFronts * static_cast<double>(schema.front_cells);
}

Sampler::Sampler(const Schema& schema, const SimplifyOptions& options)
    : schema_(withoutFront(schema)),
      options_(options),
      wanted_(sampleOf(schema, options)),
      reach_(reachOf(schema)) {
  counts_.emplace_back(schema, gridBytes(options));
}

size_t Sampler::mostStretches() const {
  return std::clamp<size_t>(kLargestTables / std::bit_ceil(reach_), 1, kMostStretches);
}

void Sampler::countInStretches(size_t stretches) {
  counts_.resize(stretches, counts_[0]);
}

void Sampler::count(const BatchView& batch, size_t stretch) {
  double place[3];
  for (size_t row = 0; row < batch.vertex_count; ++row) {
    placeAt(batch.positions, schema_.position_type, row, place);
    counts_[stretch].count(place);
  }
}

void Sampler::takeBricks(const std::vector<Stretch::Begin>& stretches) {
  Bricks& bricks = counts_[0];
  for (size_t k = 1; k < counts_.size(); ++k) bricks.addCounts(counts_[k]);
  counts_.erase(counts_.begin() + 1, counts_.end());
  const double share = wanted_ / static_cast<double>(schema_.cell_count);
  const double brick = std::min(kBrick, wanted_ / kFewestBricks);
  bricks.take(static_cast<size_t>(std::ceil(wanted_ / brick)), share);
  const uint64_t most = kFullest * std::min(bricks.usual(), static_cast<uint64_t>(kBrick));
  for (const Stretch::Begin& begin : stretches)
    stretches_.emplace_back(schema_, bricks, reach_, most, begin);
}

BatchView Sampler::mesh() {
  for (size_t k = 1; k < stretches_.size(); ++k) stretches_[0].append(stretches_[k]);
  while (stretches_.size() > 1) stretches_.pop_back();
  stretches_[0].forgetRanks();  // makes room for the window
  countBricks();
  return stretches_[0].mesh().view();
}

// And locks what is cut, and what the stream does.
void Sampler::countBricks() {
  SampleStretch& all = stretches_[0];
  Batch& mesh = all.mesh();
  brick_.assign(counts_[0].size(), {});
  for (size_t row = 0; row < mesh.vertexCount(); ++row) {
    const bool is_cut = all.isCut(row), is_held = all.isHeld(row);
    if (is_cut || is_held) mesh.lock(row);
    Brick& brick = brick_[all.brickOf(row)];
    if (all.isUsed(row)) ++(is_cut ? brick.cut : is_held ? brick.held : brick.free);
  }
  for (size_t cell = 0; cell < mesh.cellCount(); ++cell)
    ++brick_[all.brickOf(static_cast<size_t>(mesh.cell(cell)[0]))].cells[all.partOf(cell)];
}

Schema Sampler::schema() const {
  const Batch& mesh = stretches_[0].mesh();
  Schema schema = schema_;
  schema.cell_count = static_cast<int64_t>(mesh.cellCount());
  schema.vertex_count = static_cast<int64_t>(mesh.vertexCount());
  return schema;
}

int64_t Sampler::windowBytes() const {
  const Batch& mesh = stretches_[0].mesh();
  const auto cells = static_cast<double>(mesh.cellCount());
  const auto vertices = static_cast<double>(mesh.vertexCount());
  return options_.memory_bytes - gridBytes(options_) -
         static_cast<int64_t>(sampleBytes(schema_, cells, vertices));
}

// Of all cells of the sample the share that is left when `left` of its free vertices are.
double Sampler::ratioFor(double left) const {
  double free = 0;
  for (const Brick& brick : brick_) free += static_cast<double>(brick.free);
  const auto cells = static_cast<double>(stretches_[0].mesh().cellCount());
  return cells > 0 ? std::max(1 - kCellsPerCollapse * free * (1 - left) / cells, 0.05) : 1;
}

void Sampler::countSurvivors(const BatchView& simplified) {
  for (size_t row = 0; row < simplified.vertex_count; ++row) {
    double place[3];
    placeAt(simplified.positions, schema_.position_type, row, place);
    const uint32_t brick = counts_[0].at(place);
    if (brick != Bricks::kNone) ++brick_[brick].survivors;
  }
}

BrickLeft Sampler::Brick::left() const {
  BrickLeft brick;
  std::copy_n(cells, kStreamParts, brick.cells.begin());
  brick.inside = static_cast<double>(free + held);
  brick.left = static_cast<double>(std::max<int64_t>(survivors - cut, 0));
  return brick;
}

Pilot Sampler::pilot(double ratio) const {
  std::vector<BrickLeft> bricks;
  for (const Brick& brick : brick_)
    if (brick.free + brick.held > 0) bricks.push_back(brick.left());
  Pilot pilot;
  const std::vector<double> rates = sampledRates(bricks, ratio);
  if (rates.empty()) return pilot;
  pilot.share = {0};
  for (double rate : rates) pilot.share.push_back(pilot.share.back() + rate);
  for (double& share : pilot.share) share /= pilot.share.back();
  return pilot;
}

namespace {

class Survivors final : public Sink {
 public:
  explicit Survivors(Sampler& sampler) : sampler_(sampler) {}
  void begin(const Schema&) override {}
  void put(const BatchView& batch) override { sampler_.countSurvivors(batch); }
  void finish() override {}

 private:
  Sampler& sampler_;
};

}  // namespace

Pilot Sampler::simplify() {
  const BatchView all = mesh();
  if (all.cell_count == 0) return {};
  SimplifyOptions whole = options_;
  if (options_.memory_bytes > 0) {
    whole.memory_bytes = windowBytes();
    if (whole.memory_bytes <= 0) return {};
  }
  whole.window_cells = static_cast<int64_t>(all.cell_count);
  whole.cells = 0;
  whole.ratio = ratioFor(kLeft);
  whole.eases_in = false;
  whole.balance_ratio = static_cast<double>(Simplifier::targetCells(schema_, options_)) /
                        static_cast<double>(schema_.cell_count);
  Survivors survivors(*this);
  Simplifier simplifier(whole, survivors, nullptr);
  simplifier.begin(schema());
  simplifier.put(all);
  simplifier.finish();
  Pilot found = pilot(whole.balance_ratio);
  found.balance = simplifier.pilot().balance;
  return found;
}

}  // namespace tetstream
