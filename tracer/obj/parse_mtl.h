// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/vectors.h"

namespace tracer {

/// What a texture stands for. The last three are read and not shown.
enum class MtlSlot : uint8_t {
  kd,
  ks,
  ke,
  d,
  ns,
  pr,
  pm,  // map_Pm, and map_refl as Blender 3 writes it
  norm,
  bump,
  ps,
  disp,
  refl,
};
inline constexpr size_t mtl_slot_count = 12;
/// The keyword of a slot, for messages.
std::string_view keyword_of(MtlSlot slot);

/// One statement that names a texture. Texture coordinates are scale * uv + offset, values are
/// base + gain * texel.
struct MtlMap {
  std::string path;   // as written, options and quotes removed; empty for none
  uint32_t line = 0;  // from 1
  Vec2f offset{0.0f};
  Vec2f scale{1.0f};
  float base = 0;
  float gain = 1;
  float bump_strength = 1;
  bool is_clamped = false;
  char channel = 0;  // of r g b m l z, in lower case; 0: as the slot has it
};

/// One newmtl block, with the format's own names. Colours are linear RGB; what is not in the block
/// is empty, or the default here.
struct MtlMaterial {
  std::string name;
  std::optional<Vec3f> ka;
  Vec3f kd{0.8f};
  Vec3f ks{0.0f};
  Vec3f ke{0.0f};
  std::optional<Vec3f> tf;
  std::optional<float> ns;
  std::optional<float> ni;
  float d = 1;               // 1 - Tr
  std::optional<int> illum;  // 0 to 10
  // The extension for physically based materials.
  std::optional<float> pr, pm, ps, pc, pcr, aniso, anisor;
  std::array<MtlMap, mtl_slot_count> maps;

  MtlMap& map(MtlSlot slot) { return maps[static_cast<size_t>(slot)]; }
  const MtlMap& map(MtlSlot slot) const { return maps[static_cast<size_t>(slot)]; }
};

struct MtlFile {
  std::vector<MtlMaterial> materials;
  Warnings warnings;
};

/// Parses a material library. `path` is only for messages. Never fails; unknown keywords are
/// passed over, malformed values are warnings.
MtlFile parse_mtl(std::string_view bytes, const std::string& path);

}  // namespace tracer
