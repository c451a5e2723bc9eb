#include "boundary_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "last_met.h"
#include "random.h"
#include "row_number.h"
#include "triangle.h"

namespace tetstream {

// Uniform: with two random numbers a and b, coordinates 1 - sqrt a, sqrt a (1 - b), sqrt a b.
static void addSample(const double* corners, Random& random, NearestPoints& places) {
  const double root = std::sqrt(shareOf(random.next())), b = shareOf(random.next()), is_sample = 1;
  double place[3];
  for (int k = 0; k < 3; ++k)
    place[k] =
        (1 - root) * corners[k] + root * (1 - b) * corners[3 + k] + root * b * corners[6 + k];
  places.add(place, &is_sample);
}

static void addPlaces(SimplexRows& from, const SurfaceSampling& s, const DistanceBudget& budget,
                      NearestPoints& places) {
  LastMet vertices(budget.account, budget.bytes);  // which many faces share
  for (uint64_t i = 0; i < from.count(); ++i) {
    const double* corners = from.row(i);
    double centre[3];
    from.shape().centreOf(corners, centre);
    if (!isFaceWithin(s.part, centre, from.shape().boxOf(corners))) continue;
    Random random(numberOf(corners, 9, s.seed));
    const double share = s.area > 0 ? triangleArea(corners) / s.area : 0;
    const double wanted = static_cast<double>(s.samples) * share + shareOf(random.next());
    for (int64_t n = 0; n < static_cast<int64_t>(wanted); ++n) addSample(corners, random, places);
    for (int j = 0; j < 3; ++j) {
      if (vertices.meet(numberOf(corners + 3 * j, 3, 0))) continue;
      const double is_vertex = 0;
      places.add(corners + 3 * j, &is_vertex);
    }
  }
}

DistanceFigures boundaryDistance(SimplexRows& from, SimplexRows& to,
                                 const SurfaceSampling& sampling, const DistanceBudget& budget,
                                 const std::function<void(double)>& share) {
  DistanceFigures figures;
  NearestPoints places(1, 0, budget.temp_dir);
  addPlaces(from, sampling, budget, places);
  if (places.count() == 0) return figures;
  const bool is_far = to.count() == 0;
  figures.largest = figures.rms = figures.mean =
      is_far ? std::numeric_limits<double>::infinity() : 0;
  std::fill_n(figures.place, 3, 0.0);
  if (is_far) return figures;
  double samples = 0, squares = 0, sum = 0;
  places.search(
      to, {budget.account, budget.bytes, budget.tasks},
      [&](const NearestPoints::Found& found) {
        if (found.distance > figures.largest) {
          figures.largest = found.distance;
          std::copy_n(found.place, 3, figures.place);
        }
        if (found.carried[0] == 0) return;
        samples += 1;
        squares += found.distance * found.distance;
        sum += found.distance;
      },
      share);
  if (samples > 0) {
    figures.rms = std::sqrt(squares / samples);
    figures.mean = sum / samples;
  }
  return figures;
}

}  // namespace tetstream
