// generate: the stress in the mixing layer, a symmetric tensor. Depends on mixing_layer.h.
//
// The flux of momentum of a fluid without viscosity, with w the height over the interface at rest:
//   stress = -(p I + density velocity velocity^T),   p = 0.05 (6 - 2 w - sqrt(w^2 + 0.12^2))
// p is the weight of what lies above, density 3 over 1, and smooth across the interface. Its six
// components are xx, yy, zz, xy, yz, xz, as VTK orders them.
#pragma once

#include "mixing_layer.h"

namespace tetstream {

constexpr int kStressValues = 6;

void stressAt(float w, float density, const float velocity[3], float stress[kStressValues]);

// Bounds of a component over all points of the layer, from those of density and velocity.
double leastStress(const MixingLayer& layer, int value);
double largestStress(const MixingLayer& layer, int value);

}  // namespace tetstream
