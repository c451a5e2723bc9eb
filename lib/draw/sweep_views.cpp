#include "sweep_views.h"

#include <algorithm>
#include <cmath>

#include "scalar.h"

namespace tetstream {

// ------------------------------------------------------------------------------------- the eye

// Turned by so much to the side and up, in radians, so that three sides of a box are seen.
static constexpr double kTurn = 0.45, kLift = 0.35;
static constexpr double kFreeShare = 0.03;  // of the image, on each side

namespace {

// The axes of a box by its size: to the right, up and toward the eye, each with its sign.
struct BoxAxes {
  int axis[3] = {0, 1, 2};
  double sign[3] = {1, 1, 1};
};

// `start`: the first vertex from the middle of the box. What is written away first is to be in
// front of what is to come, so it is turned toward the eye; the mirror image is not shown.
BoxAxes axesOf(const double size[3], const double start[3]) {
  BoxAxes box;
  std::stable_sort(box.axis, box.axis + 3, [&](int a, int b) { return size[a] > size[b]; });
  if (start[box.axis[2]] < 0) box.sign[2] = -1;
  const bool odd = (box.axis[1] - box.axis[0] + 3) % 3 != 1;
  if (odd != (box.sign[2] < 0)) box.sign[0] = -1;
  return box;
}

}  // namespace

// Right, down and away from the eye, in the axes of the box.
static void turnedAxes(double turn, double out[3][3]) {
  const double ct = std::cos(turn), st = std::sin(turn);
  const double cl = std::cos(kLift), sl = std::sin(kLift);
  const double rows[3][3] = {{ct, 0, -st}, {sl * st, -cl, sl * ct}, {-cl * st, -sl, -cl * ct}};
  for (int r = 0; r < 3; ++r) std::copy(rows[r], rows[r] + 3, out[r]);
}

Eye::Eye(const Schema& schema, const double first[3], size_t width, size_t height) {
  double size[3], start[3];
  for (size_t a = 0; a < 3; ++a) {
    size[a] = schema.box_max[a] - schema.box_min[a];
    middle_[a] = (schema.box_min[a] + schema.box_max[a]) / 2;
    start[a] = first[a] - middle_[a];
  }
  const BoxAxes box = axesOf(size, start);
  double turned[3][3];
  turnedAxes(box.sign[0] * start[box.axis[0]] < 0 ? -kTurn : kTurn, turned);
  for (int r = 0; r < 3; ++r)
    for (int a = 0; a < 3; ++a) rows_[r][box.axis[a]] = box.sign[a] * turned[r][a];
  fit(size, static_cast<double>(width), static_cast<double>(height));
}

// The whole box into the image, with a margin.
void Eye::fit(const double size[3], double width, double height) {
  double extent[2] = {};
  for (int r = 0; r < 2; ++r)
    for (int a = 0; a < 3; ++a) extent[r] += std::fabs(rows_[r][a]) * size[a];
  const double room = 1 - 2 * kFreeShare;
  const double scale = std::min(extent[0] > 0 ? room * width / extent[0] : 1,
                                extent[1] > 0 ? room * height / extent[1] : 1);
  for (auto& row : rows_)
    for (double& entry : row) entry *= scale;
  centre_[0] = width / 2;
  centre_[1] = height / 2;
}

Seen Eye::look(const double position[3]) const {
  double at[3];
  for (int r = 0; r < 3; ++r) {
    at[r] = centre_[r];
    for (int a = 0; a < 3; ++a) at[r] += rows_[r][a] * (position[a] - middle_[a]);
  }
  return {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
}

// ----------------------------------------------------------------------------------- the views

bool SweepViews::serves(const Schema& schema) {
  return schema.hasBox() && schema.cell_count >= 0;
}

SweepViews::SweepViews(const Schema& schema)
    : meter_(account_),
      schema_(schema),
      declared_(account_),
      places_(account_),
      cells_(account_),
      whole_(account_, kWidth, kHeight) {
  const auto cells = static_cast<uint64_t>(schema.cell_count);
  moments_.reserve(kMoments);
  for (size_t i = 0; i < kMoments; ++i) {
    moments_.emplace_back(account_);
    moments_.back().cell = cells / (kMoments + 1) * (i + 1);
  }
}

// Grows to twice what is needed.
template <class T>
static void reserve(Array<T>& array, size_t needed) {
  if (array.size() < needed) array.resize(2 * needed);
}

void SweepViews::addVertices(const BatchView& batch) {
  constexpr size_t kStep = 256;
  double positions[3 * kStep];
  const auto* from = static_cast<const unsigned char*>(batch.positions);
  const size_t row_bytes = 3 * sizeOf(schema_.position_type);
  reserve(declared_, declared_count_ + batch.vertex_count);
  for (size_t row = 0; row < batch.vertex_count; row += kStep) {
    const size_t count = std::min(kStep, batch.vertex_count - row);
    convertScalars(from + row * row_bytes, schema_.position_type, positions, ScalarType::kFloat64,
                   3 * count);
    if (!eye_) eye_.emplace(schema_, positions, kWidth, kHeight);
    for (size_t i = 0; i < count; ++i) declared_[declared_count_++] = eye_->look(positions + 3 * i);
  }
}

// When they are half of what is kept, so that no place is moved often.
void SweepViews::dropIntroduced() {
  const auto gone = static_cast<size_t>(meter_.front().introduced() - first_declared_);
  if (2 * gone < declared_count_) return;
  std::copy(declared_.data() + gone, declared_.data() + declared_count_, declared_.data());
  declared_count_ -= gone;
  first_declared_ += gone;
}

void SweepViews::takePlaces(uint64_t first_vertex) {
  reserve(places_, meter_.vertexRows());
  for (uint64_t v = first_vertex; v < meter_.front().introduced(); ++v) {
    const uint32_t slot = meter_.front().find(v);
    if (slot != kNoSlot) places_[slot] = declared_[static_cast<size_t>(v - first_declared_)];
  }
}

void SweepViews::addCell(const int64_t corners[4], unsigned last_uses) {
  passMoments();
  const uint64_t introduced = meter_.front().introduced(), number = meter_.cellsSeen();
  const uint32_t row = meter_.addCell(corners);
  takePlaces(introduced);
  reserve(cells_, meter_.cellRows());
  Cell& cell = cells_[row];
  for (size_t j = 0; j < 4; ++j)
    cell.corners[j] = places_[meter_.front().find(static_cast<uint64_t>(corners[j]))];
  whole_.add(cell.corners, kToCome);
  for (Moment& moment : moments_)
    if (number >= moment.cell) moment.view.add(cell.corners, kToCome);
  for (size_t j = 0; j < 4; ++j)
    if (last_uses >> j & 1) meter_.finalize(corners[j]);
}

void SweepViews::pass(Moment& moment) {
  for (uint32_t row = 0; row < meter_.cellRows(); ++row) {
    if (!meter_.isLive(row)) continue;
    moment.view.add(cells_[row].corners, kInCore);
    ++moment.cells_in_core;
  }
  moment.vertices_in_core = meter_.front().active();
  moment.cell = meter_.cellsSeen();
  moment.passed = true;
}

void SweepViews::passMoments() {
  for (Moment& moment : moments_)
    if (!moment.passed && meter_.cellsSeen() >= moment.cell) pass(moment);
}

void SweepViews::put(const BatchView& batch) {
  meter_.declare(batch);
  addVertices(batch);
  for (size_t i = 0; i < batch.cell_count; ++i)
    addCell(batch.cells + 4 * i, batch.last_uses ? batch.last_uses[i] : 0);
  for (size_t i = 0; i < batch.finalized_count; ++i) {
    const uint64_t introduced = meter_.front().introduced();
    meter_.finalize(batch.finalized[i]);
    takePlaces(introduced);
  }
  dropIntroduced();
}

void SweepViews::finish() {
  for (Moment& moment : moments_)
    if (!moment.passed) pass(moment);
}

}  // namespace tetstream
