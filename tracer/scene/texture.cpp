// SPDX-License-Identifier: MIT
#include "tracer/scene/texture.h"

#include <cmath>

#include "tracer/scene/srgb_codes.h"

namespace tracer {
namespace {

using Vec4d = glm::dvec4;

/// Two neighbouring texels along an axis and how far between their centres, 0 to 1.
struct TexelPair {
  int first = 0;
  int second = 0;
  double weight = 0;  // of the second
};

TexelPair repeated(double coordinate, int size) {
  const double place = (coordinate - std::floor(coordinate)) * size - 0.5;
  const double first = std::floor(place);
  const int index = static_cast<int>(first);
  return {(index + size) % size, (index + 1) % size, place - first};
}

TexelPair clamped(double coordinate, int size) {
  const double place = std::clamp(coordinate, 0.0, 1.0) * size - 0.5;
  const double first = std::floor(place);
  const int index = static_cast<int>(first);
  return {std::max(index, 0), std::min(index + 1, size - 1), place - first};
}

/// Around `coordinate`; what is not finite counts as 0.
TexelPair texels_around(double coordinate, int size, Wrapping wrapping) {
  const double finite = std::isfinite(coordinate) ? coordinate : 0.0;
  return wrapping == Wrapping::clamp ? clamped(finite, size) : repeated(finite, size);
}

Vec4d eval_level(const Texture& texture, const Texture::Level& level, const Vec2d& uv,
                 Wrapping wrapping) {
  const TexelPair column = texels_around(uv.x, level.width, wrapping);
  const double down = wrapping == Wrapping::clamp ? 1 - uv.y : -uv.y;
  const TexelPair row = texels_around(down, level.height, wrapping);
  const auto texel = [&](int x, int y) { return Vec4d(texel_at(texture, level, x, y)); };
  const Vec4d upper = (1 - column.weight) * texel(column.first, row.first) +
                      column.weight * texel(column.second, row.first);
  const Vec4d lower = (1 - column.weight) * texel(column.first, row.second) +
                      column.weight * texel(column.second, row.second);
  return (1 - row.weight) * upper + row.weight * lower;
}

/// log2(footprint) where that is a whole number, linear between, 0 below 1.
double level_of(double footprint) {
  if (!(footprint > 1)) return 0;
  if (!std::isfinite(footprint)) return 64;
  int exponent = 0;
  const double mantissa = std::frexp(footprint, &exponent);
  return exponent - 1 + (2 * mantissa - 1);
}

template <class T>
Vec4f components(const T* at, int channel_count) {
  const auto value = [&](int i) { return static_cast<float>(at[i]); };
  if (channel_count == 1) return Vec4f(Vec3f(value(0)), 1);
  return {value(0), value(1), value(2), channel_count == 4 ? value(3) : 1.0f};
}

}  // namespace

Vec4f texel_at(const Texture& texture, const Texture::Level& level, int x, int y) {
  const size_t index = level.first_texel + static_cast<size_t>(y) * level.width + x;
  const size_t place = index * texture.channel_count;
  if (texture.is_float()) return components(&texture.values[place], texture.channel_count);
  const uint8_t* code = &texture.codes[place];
  const std::array<float, 256>& color = decode_table(texture.encoding);
  if (texture.channel_count == 1) return Vec4f(Vec3f(color[code[0]]), 1);
  const float alpha =
      texture.channel_count == 4 ? decode_table(TexelEncoding::linear)[code[3]] : 1.0f;
  return {color[code[0]], color[code[1]], color[code[2]], alpha};
}

Vec4f eval_texture(const Texture& texture, const Vec2d& uv, double footprint, Wrapping wrapping) {
  if (texture.levels.empty()) return Vec4f(1.0f);
  const double level =
      std::min(level_of(footprint), static_cast<double>(texture.levels.size() - 1));
  const auto finer = static_cast<size_t>(level);
  const double weight = level - static_cast<double>(finer);
  const Vec4d fine = eval_level(texture, texture.levels[finer], uv, wrapping);
  if (weight == 0) return Vec4f(fine);
  const Vec4d coarse = eval_level(texture, texture.levels[finer + 1], uv, wrapping);
  return Vec4f((1 - weight) * fine + weight * coarse);
}

Vec3f eval_texture(const Texture& texture, const Vec2f& uv) {
  return Vec3f(eval_texture(texture, Vec2d(uv), 0, Wrapping::repeat));
}

}  // namespace tracer
