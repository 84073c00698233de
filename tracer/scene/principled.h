// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/base/vectors.h"

namespace tracer {

/// What a surface does with light, in the terms of [Burley 2012] and [Burley 2015]: a metal, or a
/// dielectric over a diffuse base or over clear matter, under sheen and a clear coat. All in
/// [0, 1] unless said.
struct Principled {
  Vec3f base_color{0.8f};  // linear RGB
  float metallic = 0;
  float roughness = 1;  // of metal and dielectric; GGX alpha is its square
  float specular = 0;   // a dielectric reflects 0.08 times this head-on; 0: it does not reflect
  float anisotropy = 0;
  float anisotropy_turns = 0;  // of the tangent, counter-clockwise about the normal
  float sheen = 0;
  float coat = 0;
  float coat_roughness = 0;
  float transmission = 0;  // share of the base that is clear matter, tinted by base_color
  float ior = 1.5f;        // of the clear matter, at least 1
};

}  // namespace tracer
