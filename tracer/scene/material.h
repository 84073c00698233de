// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tracer/scene/principled.h"

namespace tracer {

inline constexpr uint32_t no_texture = 0xffffffffu;

/// What a texture decides. Colours and emission multiply the material's own, the others replace it.
enum class MapSlot : uint8_t {
  base_color,
  emission,
  opacity,
  specular,
  roughness,
  metallic,
  normal,
};
inline constexpr size_t map_slot_count = 7;

enum class Wrapping : uint8_t { repeat, clamp };

/// The number that a texel stands for; `alpha` is the luminance in images without alpha.
enum class TexelChannel : uint8_t { luminance, red, green, blue, alpha };

/// A texture as a material looks it up: at scale * uv + offset, of values base + gain * texel.
struct MaterialMap {
  uint32_t texture = no_texture;
  Vec2f offset{0.0f};
  Vec2f scale{1.0f};
  float base = 0;
  float gain = 1;
  Wrapping wrapping = Wrapping::repeat;
  TexelChannel channel = TexelChannel::luminance;
  bool empty() const { return texture == no_texture; }
};

struct Material {
  std::string name;
  Principled scattering;
  Vec3f emission{0.0f};  // radiance, linear RGB, from both sides
  float opacity = 1;     // share of rays that meet the surface
  float normal_strength = 1;
  std::array<MaterialMap, map_slot_count> maps;
  bool has_maps = false;  // whether any of `maps` is not empty

  MaterialMap& map(MapSlot slot) { return maps[static_cast<size_t>(slot)]; }
  const MaterialMap& map(MapSlot slot) const { return maps[static_cast<size_t>(slot)]; }
  void set_map(MapSlot slot, const MaterialMap& to) {
    map(slot) = to;
    has_maps = has_maps || !to.empty();
  }
};

/// Whether every ray that hits it, meets it.
inline bool is_opaque(const Material& material) {
  return material.opacity == 1 && material.map(MapSlot::opacity).empty();
}

}  // namespace tracer
