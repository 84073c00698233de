// SPDX-License-Identifier: MIT
// Materials to try the BSDF on, and integrals of what it scatters.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tracer/render/bsdf.h"

namespace tracer::test {

struct NamedMaterial {
  std::string name;
  Principled p;
};

/// White ones, a layer at a time, then together.
inline std::vector<NamedMaterial> white_materials() {
  const Vec3f white(1);
  return {
      {"metal", {.base_color = white, .metallic = 1}},
      {"dielectric over diffuse", {.base_color = white, .specular = 0.5f}},
      {"faint dielectric", {.base_color = white, .specular = 0.1f}},
      {"dielectric of 8 percent", {.base_color = white, .specular = 1}},
      {"half metal", {.base_color = white, .metallic = 0.5f, .specular = 0.5f}},
      {"coat over diffuse", {.base_color = white, .coat = 1}},
      {"half a coat", {.base_color = white, .coat = 0.5f}},
      {"sheen over diffuse", {.base_color = white, .sheen = 1}},
  };
}

/// Where layers hide each other and a little light is lost between them.
inline std::vector<NamedMaterial> layered_materials() {
  const Vec3f white(1);
  return {
      {"coat over dielectric", {.base_color = white, .specular = 0.5f, .coat = 1}},
      {"coat over sheen", {.base_color = white, .sheen = 1, .coat = 1}},
      {"coat over metal", {.base_color = white, .metallic = 1, .coat = 1}},
      {"everything opaque",
       {.base_color = white, .metallic = 0.3f, .specular = 0.5f, .sheen = 0.5f, .coat = 0.7f}},
      {"anisotropic metal", {.base_color = white, .metallic = 1, .anisotropy = 0.8f}},
  };
}

inline std::vector<NamedMaterial> clear_materials() {
  const Vec3f white(1);
  return {
      {"glass", {.base_color = white, .transmission = 1, .ior = 1.5f}},
      {"water", {.base_color = white, .transmission = 1, .ior = 1.33f}},
      {"diamond", {.base_color = white, .transmission = 1, .ior = 2.4f}},
      {"half glass", {.base_color = white, .specular = 0.5f, .transmission = 0.5f, .ior = 1.5f}},
      {"coated glass", {.base_color = white, .coat = 1, .transmission = 1, .ior = 1.5f}},
  };
}

inline std::vector<NamedMaterial> all_materials() {
  std::vector<NamedMaterial> all = white_materials();
  for (const auto& more : {layered_materials(), clear_materials()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// All layers as rough.
inline Principled with_roughness(Principled p, double roughness) {
  p.roughness = static_cast<float>(roughness);
  p.coat_roughness = static_cast<float>(roughness);
  return p;
}

/// In the upper hemisphere.
inline Vec3d direction_at(double cosine, double turns) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const CosSin around = cos_sin_of_turns(turns);
  return {sine * around.cos, sine * around.sin, cosine};
}

using OfDirection = std::function<double(const Vec3d&)>;

/// The integral of f over the upper hemisphere by solid angle, for functions with highlights about
/// wo's mirror direction, as wide as `alpha` or wider. To some 1e-6.
double integrate_above(const Vec3d& wo, double alpha, const OfDirection& f);

/// The same over the lower one, by equal cells; for what is smooth.
double integrate_below(const OfDirection& f);

}  // namespace tracer::test
