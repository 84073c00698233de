// SPDX-License-Identifier: MIT
#include <cmath>

#include "tracer/base/directions.h"
#include "tracer/scene/srgb_codes.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

void append_texel(Texture& texture, const Vec4f& value) {
  for (int i = 0; i < texture.channel_count; ++i) {
    if (texture.values.empty()) {
      const auto encoding = i == 3 ? TexelEncoding::linear : texture.encoding;
      texture.codes.push_back(encode(encoding, value[i]));
    } else {
      texture.values.push_back(value[i]);
    }
  }
}

/// The mean of the texels of the finer level under a texel: two by two, or three where a size is
/// odd, so that none is left out.
Vec4f mean_below(const Texture& texture, const Texture::Level& fine, const Texture::Level& coarse,
                 int x, int y) {
  const auto end_of = [](int i, int fine_size, int coarse_size) {
    return i + 1 == coarse_size ? fine_size : 2 * (i + 1);
  };
  glm::dvec4 sum(0);
  int count = 0;
  for (int j = 2 * y; j < end_of(y, fine.height, coarse.height); ++j) {
    for (int i = 2 * x; i < end_of(x, fine.width, coarse.width); ++i, ++count) {
      sum += glm::dvec4(texel_at(texture, fine, i, j));
    }
  }
  return Vec4f(sum / static_cast<double>(count));
}

size_t texel_count(const Texture::Level& level) {
  return static_cast<size_t>(level.width) * static_cast<size_t>(level.height);
}

float height_at(const Texture& heights, int x, int y) {
  const int column = (x + heights.width) % heights.width;
  const int row = (y + heights.height) % heights.height;
  return texel_at(heights, heights.levels[0], column, row).x;
}

}  // namespace

void add_levels(Texture& texture) {
  texture.levels = {{texture.width, texture.height, 0}};
  while (texture.levels.back().width > 1 || texture.levels.back().height > 1) {
    const Texture::Level fine = texture.levels.back();
    const Texture::Level coarse{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1),
                                fine.first_texel + texel_count(fine)};
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        append_texel(texture, mean_below(texture, fine, coarse, x, y));
      }
    }
    texture.levels.push_back(coarse);
  }
}

Texture make_texture(int width, int height, const std::vector<Vec3f>& texels) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.values.reserve(4 * texels.size());
  for (const Vec3f& texel : texels) {
    texture.values.insert(texture.values.end(), {texel.x, texel.y, texel.z});
  }
  add_levels(texture);
  return texture;
}

Texture make_checker() {
  Texture texture;
  texture.width = texture.height = 64;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool is_bright = (x / 8 + y / 8) % 2 == 0;
      append_texel(texture, is_bright ? Vec4f(0.8f, 0, 0.8f, 1) : Vec4f(0.02f, 0.02f, 0.02f, 1));
    }
  }
  add_levels(texture);
  return texture;
}

bool is_grey(const Texture& texture) {
  if (texture.channel_count == 1) return true;
  const Texture::Level& level = texture.levels.at(0);
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      const Vec4f texel = texel_at(texture, level, x, y);
      if (texel.x != texel.y || texel.y != texel.z) return false;
    }
  }
  return true;
}

Texture normals_of_heights(const Texture& heights) {
  Texture normals;
  normals.width = heights.width;
  normals.height = heights.height;
  normals.encoding = TexelEncoding::linear;
  for (int y = 0; y < heights.height; ++y) {
    for (int x = 0; x < heights.width; ++x) {
      const double rise_right = 0.5 * (height_at(heights, x + 1, y) - height_at(heights, x - 1, y));
      const double rise_up = 0.5 * (height_at(heights, x, y - 1) - height_at(heights, x, y + 1));
      const Vec3d normal = unit_or(Vec3d(-rise_right, -rise_up, 1), {0, 0, 1});
      for (int i = 0; i < 3; ++i) {
        normals.codes.push_back(static_cast<uint8_t>(std::floor(128.5 + 127 * normal[i])));
      }
    }
  }
  add_levels(normals);
  return normals;
}

}  // namespace tracer
