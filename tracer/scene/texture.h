// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// Linear RGB texels, row 0 on top.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<Vec3f> texels;
};

/// PNG, JPEG, HDR and what else stb reads; 8-bit files are taken as sRGB. Throws LoadError.
Texture load_texture(const std::filesystem::path& path);

/// Bilinear, repeating; v = 0 is the bottom edge, as OBJ has it.
Vec3f eval_texture(const Texture& texture, const Vec2f& uv);

}  // namespace tracer
