#include "lattice_source.h"

#include <algorithm>

#include "stress.h"

namespace tetstream {

namespace {

constexpr int64_t kBatchCubes = kBatchCells / kCubeCells;

// The fields are added before the batch is made from the schema.
Schema withFields(Schema schema, bool with_stress) {
  schema.fields = {{"density", 1, ScalarType::kFloat32}, {"velocity", 3, ScalarType::kFloat32}};
  if (with_stress) schema.fields.push_back({"stress", kStressValues, ScalarType::kFloat32});
  return schema;
}

}  // namespace

LatticeSource::LatticeSource(const LatticeMesh& mesh, uint64_t seed, const Schema& schema)
    : mesh_(mesh),
      seed_(seed),
      layer_(seed),
      schema_(withFields(schema, mesh.with_stress)),
      batch_(schema_) {
  for (int start = 0; start < 8; ++start) splits_[start] = splitCube(start);
  schema_.vertex_count = mesh_.lattice.vertexCount();
  schema_.cell_count = kCubeCells * mesh_.lattice.cubeCount();
  for (int value = 0; value < MixingLayer::kValues; ++value) {
    schema_.box_min.push_back(layer_.minimum(value));
    schema_.box_max.push_back(layer_.maximum(value));
  }
  for (int value = 0; mesh_.with_stress && value < kStressValues; ++value) {
    schema_.box_min.push_back(leastStress(layer_, value));
    schema_.box_max.push_back(largestStress(layer_, value));
  }
}

bool LatticeSource::next(BatchView& batch) {
  batch_.clear(vertices_given_);
  const Lattice& lattice = mesh_.lattice;
  int64_t room = kBatchCubes;
  while (room > 0 && k_ < lattice.depth) {
    const int64_t cubes = std::min(room, lattice.side - i_);
    addRun(cubes);
    room -= cubes;
    i_ += cubes;
    if (i_ == lattice.side) {
      i_ = 0;
      if (++j_ == lattice.side) {
        j_ = 0;
        ++k_;
      }
    }
  }
  vertices_given_ += batch_.vertexCount();
  batch = batch_.view();
  return !batch_.empty();
}

// `cubes` cubes of row (j, k) from cube i on, and the vertices that they introduce.
void LatticeSource::addRun(int64_t cubes) {
  addLines(i_ == 0 ? 0 : i_ + 1, i_ + cubes);
  addCubes(cubes);
}

// Vertices first_a to last_a of the lines that row (j, k) introduces, in the order of their ranks.
void LatticeSource::addLines(int64_t first_a, int64_t last_a) {
  const int64_t first_b = j_ == 0 ? 0 : j_ + 1, first_c = k_ == 0 ? 0 : k_ + 1;
  const auto lines = static_cast<size_t>((j_ + 2 - first_b) * (k_ + 2 - first_c));
  const size_t first_row = batch_.addVertices(lines * static_cast<size_t>(last_a - first_a + 1));
  size_t line = 0;
  for (int64_t c = first_c; c <= k_ + 1; ++c) {
    for (int64_t b = first_b; b <= j_ + 1; ++b, ++line) {
      for (int64_t a = first_a; a <= last_a; a += VertexRun::kVertices) {
        const auto count =
            static_cast<int>(std::min<int64_t>(VertexRun::kVertices, last_a - a + 1));
        addVertices({a, b, c, count}, first_row + static_cast<size_t>(a - first_a) * lines + line,
                    lines);
      }
    }
  }
}

// The run's vertices into rows `row`, `row` + stride, ...
void LatticeSource::addVertices(const VertexRun& run, size_t row, size_t stride) {
  Positions at;
  mesh_.place(mesh_.lattice, seed_, run, &at);
  auto* position = static_cast<float*>(batch_.position(row));
  for (int i = 0; i < run.count; ++i) {
    float* p = position + 3 * stride * static_cast<size_t>(i);
    p[0] = at.x[i];
    p[1] = at.y[i];
    p[2] = at.z[i];
    at.x[i] -= mesh_.layer_origin[0];
    at.y[i] -= mesh_.layer_origin[1];
    at.z[i] -= mesh_.layer_origin[2];
  }
  addFields(at, run.count, row, stride);
}

// Those at `count` points of the mixing layer.
void LatticeSource::addFields(const Positions& at, int count, size_t row, size_t stride) {
  constexpr int kMost = VertexRun::kVertices;
  float density[kMost], velocity_x[kMost], velocity_y[kMost], velocity_z[kMost];
  float* const velocity[3] = {velocity_x, velocity_y, velocity_z};
  layer_.evaluate(at.x, at.y, at.z, count, density, velocity);
  auto* densities = static_cast<float*>(batch_.field(0, row));
  auto* velocities = static_cast<float*>(batch_.field(1, row));
  for (int i = 0; i < count; ++i) {
    const size_t at_row = stride * static_cast<size_t>(i);
    densities[at_row] = density[i];
    for (int axis = 0; axis < 3; ++axis) velocities[3 * at_row + axis] = velocity[axis][i];
  }
  if (!mesh_.with_stress) return;
  auto* stresses = static_cast<float*>(batch_.field(2, row));
  for (int i = 0; i < count; ++i) {
    const float v[3] = {velocity_x[i], velocity_y[i], velocity_z[i]};
    stressAt(at.z[i], density[i], v, stresses + kStressValues * stride * static_cast<size_t>(i));
  }
}

void LatticeSource::addCubes(int64_t cubes) {
  const Lattice& lattice = mesh_.lattice;
  const VertexLine lines[4] = {lineAt(lattice, j_, k_), lineAt(lattice, j_ + 1, k_),
                               lineAt(lattice, j_, k_ + 1), lineAt(lattice, j_ + 1, k_ + 1)};
  const int last_yz = (j_ + 1 == lattice.side ? 2 : 0) | (k_ + 1 == lattice.depth ? 4 : 0);
  size_t row = batch_.addCells(static_cast<size_t>(kCubeCells * cubes));
  int64_t* corners = batch_.cell(row);
  uint8_t* last_uses = &batch_.lastUses(row);
  for (int64_t i = i_; i < i_ + cubes; ++i) {
    int64_t ranks[8];
    for (int corner = 0; corner < 8; ++corner) {
      const VertexLine& line = lines[corner >> 1];
      ranks[corner] = line.first_rank + line.stride * (i + (corner & 1));
    }
    const CubeSplit& split = splitAt(i);
    const uint8_t* uses = split.last_uses[last_yz | (i + 1 == lattice.side ? 1 : 0)];
    for (int c = 0; c < kCubeCells; ++c) {
      for (int corner = 0; corner < 4; ++corner) *corners++ = ranks[split.corners[c][corner]];
      *last_uses++ = uses[c];
    }
  }
}

// note: parallel diagonals run from (1, 1, 0) to (0, 0, 1): of the far layer, most cells then touch
// the vertices that are finalized first, and the front in cells grows by 3 n over 6 n^2, not by 6
// n.
const CubeSplit& LatticeSource::splitAt(int64_t i) const {
  if (!mesh_.octants) return splits_[3];
  const int64_t middle = mesh_.lattice.side / 2;
  return splits_[(i < middle ? 1 : 0) | (j_ < middle ? 2 : 0) | (k_ < middle ? 4 : 0)];
}

}  // namespace tetstream
