// SPDX-License-Identifier: MIT
#include "tracer/scene/map_material.h"

#include <algorithm>
#include <cmath>

namespace tracer {
namespace {

float mean(const Vec3f& color) {
  return (color.x + color.y + color.z) / 3;
}

float unit(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

bool is_physically_based(const MtlMaterial& m) {
  return m.pr || m.pm || m.ps || m.pc || m.pcr || m.aniso || m.anisor;
}

/// Of the illumination models those that reflect by tracing rays.
bool reflects(int illum) {
  return illum >= 3 && illum <= 8;
}
/// Those that also refract, or are glass.
bool refracts(int illum) {
  return illum == 4 || illum == 6 || illum == 7 || illum == 9;
}

/// Tf alone means nothing: 1 1 1 stands in many an opaque material, beside Ni 1.
bool is_glass(const MtlMaterial& m) {
  return m.tf && refracts(m.illum.value_or(2)) && m.ni.value_or(1) > 1 && !is_physically_based(m);
}

/// Blender 3 hides the metal in Ka.
float metallic_of(const MtlMaterial& m) {
  const int illum = m.illum.value_or(2);
  if (m.pm) return unit(*m.pm);
  if (!reflects(illum) || is_glass(m)) return 0;
  if (m.ka) return unit(mean(*m.ka));
  return refracts(illum) ? 0.0f : 1.0f;
}

float roughness_of(const MtlMaterial& m) {
  if (m.pr) return unit(*m.pr);
  if (!m.ns) return m.illum == 2 ? 0.0f : 1.0f;
  return 1 - std::sqrt(std::clamp(*m.ns, 0.0f, 1000.0f) / 1000);
}

float specular_of(const MtlMaterial& m) {
  return m.illum.value_or(2) < 2 ? 0.0f : unit(mean(m.ks));
}

/// Clear matter takes its tint from Tf, as Kd is what glass does not have.
void make_glass(const Vec3f& filter, Principled& p) {
  const float largest = std::max({filter.x, filter.y, filter.z});
  p.transmission = largest;
  if (largest > 0) p.base_color = glm::mix(p.base_color, filter / largest, largest);
}

}  // namespace

Material map_material(const MtlMaterial& m) {
  Material result;
  result.name = m.name;
  result.emission = glm::max(m.ke, 0.0f);
  result.opacity = is_glass(m) ? 1.0f : unit(m.d);

  Principled& p = result.scattering;
  p.base_color = glm::clamp(m.kd, 0.0f, 1.0f);
  p.metallic = metallic_of(m);
  p.roughness = roughness_of(m);
  p.specular = specular_of(m);
  p.sheen = unit(m.ps.value_or(0));
  p.coat = unit(m.pc.value_or(0));
  p.coat_roughness = unit(m.pcr.value_or(0));
  p.anisotropy = unit(m.aniso.value_or(0));
  p.anisotropy_turns = unit(m.anisor.value_or(0));
  p.ior = m.ni ? std::max(*m.ni, 1.0f) : p.ior;
  if (is_glass(m)) {
    make_glass(glm::clamp(*m.tf, 0.0f, 1.0f), p);
  } else if (is_physically_based(m) && m.tf) {
    p.transmission = unit(mean(*m.tf));
  }
  return result;
}

MaterialMap map_lookup(const MtlMap& map, MapSlot slot) {
  MaterialMap result;
  result.offset = map.offset;
  result.scale = map.scale;
  result.base = map.base;
  result.gain = map.gain;
  result.wrapping = map.is_clamped ? Wrapping::clamp : Wrapping::repeat;
  // An opacity is the image's alpha, as Blender has it.
  if (slot == MapSlot::opacity) result.channel = TexelChannel::alpha;
  if (map.channel == 'r') result.channel = TexelChannel::red;
  if (map.channel == 'g') result.channel = TexelChannel::green;
  if (map.channel == 'b') result.channel = TexelChannel::blue;
  if (map.channel == 'm') result.channel = TexelChannel::alpha;
  if (map.channel == 'l') result.channel = TexelChannel::luminance;
  return result;
}

}  // namespace tracer
