// The stress of the generated meshes: what its file says it is, and nothing else changes with it.
#include "stress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "generate.h"
#include "status.h"

namespace tetstream {
namespace {

struct Fields {
  Schema schema;
  std::vector<char> bytes;  // of all but the stress
  std::vector<float> heights, density, velocity, stress;
};

template <class T>
void append(std::vector<T>& to, const void* from, size_t count) {
  const T* values = static_cast<const T*>(from);
  to.insert(to.end(), values, values + count);
}

Fields collect(const std::string& kind, int64_t seed) {
  const std::unique_ptr<Source> source = generate(kind, 5000, seed);
  Fields found;
  found.schema = source->schema();
  BatchView batch;
  while (source->next(batch)) {
    append(found.bytes, batch.positions, 12 * batch.vertex_count);
    append(found.bytes, batch.fields[0], 4 * batch.vertex_count);
    append(found.bytes, batch.fields[1], 12 * batch.vertex_count);
    append(found.bytes, batch.cells, 32 * batch.cell_count);
    append(found.bytes, batch.last_uses, batch.cell_count);
    const float* positions = static_cast<const float*>(batch.positions);
    for (size_t v = 0; v < batch.vertex_count; ++v) found.heights.push_back(positions[3 * v + 2]);
    append(found.density, batch.fields[0], batch.vertex_count);
    append(found.velocity, batch.fields[1], 3 * batch.vertex_count);
    if (found.schema.fields.size() > 2)
      append(found.stress, batch.fields[2], 6 * batch.vertex_count);
  }
  return found;
}

constexpr const char* kKinds[] = {"fluid", "ball"};

TEST(GeneratedStress, ChangesNothingElse) {
  for (const std::string kind : kKinds) {
    const Fields with = collect(kind + "+stress", 3), without = collect(kind, 3);
    EXPECT_TRUE(with.bytes == without.bytes) << kind;
    EXPECT_EQ(with.schema.front_cells, without.schema.front_cells);
    ASSERT_EQ(with.schema.fields.size(), 3u);
    EXPECT_EQ(with.schema.fields[2].name, "stress");
    EXPECT_EQ(with.schema.fields[2].components, kStressValues);
    EXPECT_NO_THROW(checkSchema(with.schema));
  }
}

// -(p I + density v v^T), written out.
TEST(GeneratedStress, IsPressureAndTheFluxOfMomentum) {
  constexpr size_t kAxes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  for (const std::string kind : kKinds) {
    const Fields found = collect(kind + "+stress", 1);
    for (size_t v = 0; v < found.density.size(); ++v) {
      const double w = static_cast<double>(found.heights[v]) - (kind == "fluid" ? 2 : 0);
      const double pressure = 0.05 * (6 - 2 * w - std::sqrt(w * w + 0.0144));
      for (size_t i = 0; i < 6; ++i) {
        const auto [a, b] = kAxes[i];
        const double flux = static_cast<double>(found.density[v]) *
                            static_cast<double>(found.velocity[3 * v + a]) *
                            static_cast<double>(found.velocity[3 * v + b]);
        ASSERT_NEAR(found.stress[6 * v + i], -(flux + (a == b ? pressure : 0)), 1e-6);
      }
    }
  }
}

TEST(GeneratedStress, LiesInTheBoxOfTheSchema) {
  for (const std::string kind : kKinds)
    for (int64_t seed = 1; seed <= 3; ++seed) {
      const Fields found = collect(kind + "+stress", seed);
      ASSERT_EQ(found.schema.box_min.size(), 13u);
      for (size_t i = 0; i < 6; ++i)
        for (size_t v = 0; v < found.density.size(); ++v) {
          ASSERT_GE(found.stress[6 * v + i], found.schema.box_min[7 + i]);
          ASSERT_LE(found.stress[6 * v + i], found.schema.box_max[7 + i]);
        }
    }
}

// The recorded sum holds on every processor.
TEST(GeneratedStress, HasTheSameBytesEverywhere) {
  const Fields found = collect("fluid+stress", 1);
  uint64_t sum = 0xcbf29ce484222325u;
  for (float value : found.stress) {
    unsigned char bytes[4];
    std::memcpy(bytes, &value, 4);
    for (unsigned char byte : bytes) sum = (sum ^ byte) * 0x100000001b3u;
  }
  EXPECT_EQ(sum, 4777035195154459287u);
}

TEST(GeneratedStress, IsNoMeshOfItsOwn) {
  for (const char* kind : {"+stress", "stress", "fluid+stress+stress", "fluid+", "cube+stress"})
    try {
      generate(kind, 100, 1);
      ADD_FAILURE() << kind;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kBadArgument);
      EXPECT_NE(error.text().find(kind), std::string::npos);
      EXPECT_NE(error.text().find("fluid, ball"), std::string::npos);
    }
}

}  // namespace
}  // namespace tetstream
