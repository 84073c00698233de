// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tracer/base/vectors.h"
#include "tracer/scene/material.h"

namespace tracer {

/// What 8-bit codes of red, green and blue stand for. Alpha is always linear.
enum class TexelEncoding : uint8_t { srgb, linear };

/// An image and its halvings down to one texel, row 0 on top. 8-bit images stay 8-bit, in `codes`;
/// others are linear floats, in `values`.
struct Texture {
  struct Level {
    int width = 0;
    int height = 0;
    size_t first_texel = 0;
  };

  int width = 0;
  int height = 0;
  int channel_count = 3;  // 1: grey, 3: RGB, 4: RGB and alpha
  TexelEncoding encoding = TexelEncoding::srgb;
  std::vector<uint8_t> codes;
  std::vector<float> values;
  std::vector<Level> levels;  // the finest first

  bool is_float() const { return codes.empty(); }
};

/// PNG, JPEG, HDR, EXR and what else stb reads. Throws LoadError.
Texture load_texture(const std::filesystem::path& path,
                     TexelEncoding encoding = TexelEncoding::srgb);

/// Of linear RGB, width * height of them.
Texture make_texture(int width, int height, const std::vector<Vec3f>& texels);
/// Eight by eight squares that say that an image is missing.
Texture make_checker();
/// Whether red, green and blue are the same everywhere.
bool is_grey(const Texture& texture);
/// The tangent-space normals of a map of heights, as 8-bit codes: white lies one texel's width
/// above black.
Texture normals_of_heights(const Texture& heights);

/// Adds the halvings to a texture that has its finest texels only.
void add_levels(Texture& texture);

/// Linear RGB and alpha, 1 where the image has none. The place is in the level.
Vec4f texel_at(const Texture& texture, const Texture::Level& level, int x, int y);

/// Bilinear, between the two halvings whose texels are nearest to `footprint` texels of the finest
/// level in width [Williams 1983]; 0 is the finest. v = 0 is the bottom edge, as OBJ has it.
Vec4f eval_texture(const Texture& texture, const Vec2d& uv, double footprint, Wrapping wrapping);
/// At the finest level, repeating.
Vec3f eval_texture(const Texture& texture, const Vec2f& uv);

}  // namespace tracer
