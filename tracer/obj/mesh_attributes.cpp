// SPDX-License-Identifier: MIT
#include "tracer/obj/mesh_attributes.h"

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

/// Calls take(chunk) for all chunks, in parallel.
template <class Take>
void for_each_chunk(ObjFile& file, Take&& take) {
  parallel_for_each_index(0, file.chunks.size(), [&](size_t i) { take(file.chunks[i]); });
}

Vec3f unit_or_zero(const Vec3f& vector) {
  if (!is_finite(vector)) return Vec3f(0.0f);
  const Vec3d wide(vector);
  const double length = std::sqrt(glm::dot(wide, wide));
  return length > 0 ? Vec3f(wide / length) : Vec3f(0.0f);
}

/// Files write colours from 0 to 1 or from 0 to 255.
float largest_color(const ObjFile& file) {
  float largest = 0;
  for (const PlacedChunk& placed : file.chunks) {
    for (const Vec3f& color : placed.chunk.colors) {
      if (is_finite(color)) largest = std::max({largest, color.x, color.y, color.z});
    }
  }
  return largest;
}

}  // namespace

LargeVector<Vec3f> take_positions(ObjFile& file, const Vec3d& origin) {
  LargeVector<Vec3f> positions(file.counts.positions);
  for_each_chunk(file, [&](PlacedChunk& placed) {
    Vec3f* to = positions.data() + placed.before.positions;
    for (const Vec3d& position : placed.chunk.positions) {
      const Vec3d offset = position - origin;
      *to++ = fits_float(offset) ? Vec3f(offset) : Vec3f(0.0f);
    }
    placed.chunk.positions = {};
  });
  return positions;
}

LargeVector<Vec3f> take_normals(ObjFile& file) {
  LargeVector<Vec3f> normals(file.counts.normals);
  for_each_chunk(file, [&](PlacedChunk& placed) {
    Vec3f* to = normals.data() + placed.before.normals;
    for (const Vec3f& normal : placed.chunk.normals) *to++ = unit_or_zero(normal);
    placed.chunk.normals = {};
  });
  return normals;
}

LargeVector<Vec2f> take_texcoords(ObjFile& file) {
  LargeVector<Vec2f> texcoords(file.counts.texcoords);
  for_each_chunk(file, [&](PlacedChunk& placed) {
    std::copy(placed.chunk.texcoords.begin(), placed.chunk.texcoords.end(),
              texcoords.data() + placed.before.texcoords);
    placed.chunk.texcoords = {};
  });
  return texcoords;
}

void drop_texcoords(ObjFile& file) {
  for_each_chunk(file, [](PlacedChunk& placed) { placed.chunk.texcoords = {}; });
}

LargeVector<Vec3f> take_colors(ObjFile& file) {
  if (!file.has_colors) return {};
  const float unit = largest_color(file) > 1 ? 255.0f : 1.0f;
  LargeVector<Vec3f> colors(file.counts.positions, Vec3f(1.0f));
  for_each_chunk(file, [&](PlacedChunk& placed) {
    Vec3f* to = colors.data() + placed.before.positions;
    for (const Vec3f& color : placed.chunk.colors) {
      if (is_finite(color)) *to = glm::clamp(color / unit, 0.0f, 1.0f);
      ++to;
    }
    placed.chunk.colors = {};
  });
  return colors;
}

}  // namespace tracer
