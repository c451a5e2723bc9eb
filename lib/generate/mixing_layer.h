// generate: the fields of the generated meshes, a Rayleigh-Taylor-like mixing layer. Depends on
// arithmetic.h.
//
// Heavy fluid (density 3) above light fluid (1). With w the height over the interface at rest and
//   S(x, y) = sum of a_m cos(pi p_m x) cos(pi q_m y),   P = sum of a_m / (pi^2 (p_m^2 + q_m^2)) ...
// light fluid rises where S > 0, heavy fluid sinks where S < 0:
//   density  = 2 + 0.87 tanh(d / 0.12 + 0.8 t) - 0.05 w / 2 + 0.08 t,  d = w - 0.8 S(x', y')
//   velocity = (g' dP/dx, g' dP/dy, g S) + 0.2 u,                      g = (1 - w^2 / 4)^2
// (x', y') = (x, y) + h(w) grad S widens the plumes towards their heads into mushrooms; t and u are
// small waves that fade out away from the interface. As P's Laplacian is -S, the first part of the
// velocity has no divergence; it does not cross the walls x, y = 0, 1 and w = -2, 2. All lengths
// are those of the domain: a finer mesh sees the same fields.
#pragma once

#include <cstdint>

namespace tetstream {

class MixingLayer {
 public:
  static constexpr int kValues = 4;  // density, velocity x y z

  // The seed sets the plumes' heights and signs and the waves' phases.
  explicit MixingLayer(uint64_t seed);

  // The values at `count` points; z is the height over the interface, |z| <= 2.
  void evaluate(const float* x, const float* y, const float* z, int count, float* density,
                float* const velocity[3]) const;

  // Bounds of each value over all points that evaluate takes: for density the sum of its terms'
  // amplitudes, for velocity 0.2 |u| at most plus the largest plume, found on a grid, plus what
  // may lie between the grid's points. Density comes within 0.1 of its bounds, velocity's range is
  // 0.6 to 0.9 of what they allow.
  double minimum(int value) const { return minimum_[value]; }
  double maximum(int value) const { return maximum_[value]; }

 private:
  static constexpr int kPlumes = 5;
  static constexpr int kWaves = 6;

  template <class F>  // as in arithmetic.h
  struct Plumes {
    F sum, slope_x, slope_y, drift_x, drift_y;  // S, grad S, grad P
  };
  struct Wave {
    float turns[3], phase;  // of the sine, in turns
    float height;           // all heights together: 1
    float along[3];         // height times a unit vector across `turns`
  };

  void setPlumes(uint64_t seed);
  void setWaves(uint64_t seed);
  void setBounds();
  template <class F>
  Plumes<F> plumesAt(F x, F y) const;
  template <class F>
  F plumeSumAt(F x, F y) const;
  template <class F>
  void evaluateAt(const F at[3], F* density, F velocity[3]) const;

  float height_[kPlumes];                      // a_m
  float slope_x_[kPlumes], slope_y_[kPlumes];  // a_m pi p_m, a_m pi q_m
  float drift_x_[kPlumes], drift_y_[kPlumes];  // a_m p_m / (pi (p_m^2 + q_m^2)), same with q_m
  Wave waves_[kWaves];
  double minimum_[kValues], maximum_[kValues];
};

}  // namespace tetstream
