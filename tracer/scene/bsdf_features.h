// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "tracer/scene/principled.h"

namespace tracer {

/// What scattering has beyond a diffuse base: a set.
enum class BsdfFeatures : uint8_t {
  diffuse = 0,
  reflection = 1,    // of metals and dielectrics
  layers = 2,        // clear coat and sheen
  transmission = 4,  // into clear matter
  all = reflection | layers | transmission,
};

constexpr BsdfFeatures operator|(BsdfFeatures a, BsdfFeatures b) {
  return static_cast<BsdfFeatures>(static_cast<uint8_t>(a) | static_cast<uint8_t>(b));
}
/// Whether `set` has all of `part`.
constexpr bool has(BsdfFeatures set, BsdfFeatures part) {
  return (static_cast<uint8_t>(set) & static_cast<uint8_t>(part)) == static_cast<uint8_t>(part);
}

constexpr BsdfFeatures without(BsdfFeatures set) {
  return static_cast<BsdfFeatures>(static_cast<uint8_t>(BsdfFeatures::all) &
                                   ~static_cast<uint8_t>(set));
}

/// Those whose share is not 0.
constexpr BsdfFeatures features_of(const Principled& p) {
  BsdfFeatures features = BsdfFeatures::diffuse;
  if (p.metallic > 0 || p.specular > 0) features = features | BsdfFeatures::reflection;
  if (p.coat > 0 || p.sheen > 0) features = features | BsdfFeatures::layers;
  if (p.transmission > 0) features = features | BsdfFeatures::transmission;
  return features;
}

/// Whether the surface is exactly Lambert's.
constexpr bool is_lambert(const Principled& p) {
  return features_of(p) == BsdfFeatures::diffuse;
}

}  // namespace tracer
