// SPDX-License-Identifier: MIT
#include "tracer/obj/chunk_content.h"

#include <algorithm>
#include <limits>

namespace tracer {
namespace {

constexpr size_t room_to_scan = 4;  // indices are stored four at a time
constexpr float no_color = std::numeric_limits<float>::quiet_NaN();

WorldBounds bounds_of_usable(std::span<const Vec3d> positions) {
  WorldBounds bounds;
  for (const Vec3d& position : positions) {
    if (fits_float(position)) bounds.extend(position);
  }
  return bounds;
}

/// Of one form's corners, to what may be their own place or before it; the end of what is written.
int32_t* copy_without_texcoords(const int32_t* from, uint64_t corner_count, CornerForm form,
                                int32_t* to) {
  if (!has_texcoord(form)) {
    const uint64_t index_count = corner_count * indices_a_corner(form);
    return std::copy_n(from, index_count, to);
  }
  for (uint64_t i = 0; i < corner_count; ++i, from += indices_a_corner(form)) {
    *to++ = from[0];
    if (has_normal(form)) *to++ = from[2];
  }
  return to;
}

}  // namespace

void ChunkContent::reset(size_t text_bytes) {
  // The shortest: "v", "vt" and "vn" without numbers, a corner "1 " among others that have three
  // indices, "f 1 1 1"; each has an end of line, which the last may lack.
  const size_t most = text_bytes + 8;
  positions.reset(most / 2);
  colors_.reset(most / 2);
  texcoords.reset(most / 3);
  normals.reset(most / 3);
  indices.reset(most / 2 * 3 + room_to_scan);
  runs_.reset(most / 8);
}

void ChunkContent::push_color(const Vec3f& color) {
  while (colors_.size() + 1 < positions.size()) colors_.push(Vec3f(no_color));
  colors_.push(color);
}

void ChunkContent::push_nan_color() {
  colors_.push(Vec3f(no_color));
}

void ChunkContent::add_run(uint32_t corner_count, CornerForm form, uint32_t material,
                           uint32_t line) {
  runs_.push({indices.size() - uint64_t{corner_count} * indices_a_corner(form), 1, corner_count,
              material, line, static_cast<uint32_t>(positions.size()),
              static_cast<uint32_t>(texcoords.size()), static_cast<uint32_t>(normals.size()),
              form});
}

void ChunkContent::drop_texcoords() {
  int32_t* const first = indices.elements().data();
  int32_t* to = first;
  for (FaceRun& run : runs_.elements()) {
    const int32_t* const from = first + run.first_index;
    const uint64_t corner_count = uint64_t{run.face_count} * run.corner_count;
    run.first_index = static_cast<uint64_t>(to - first);
    to = copy_without_texcoords(from, corner_count, run.form, to);
    run.form = without_texcoord(run.form);
  }
  indices.drop_back_to(static_cast<size_t>(to - first));
  texcoords.drop_back_to(0);
}

void ChunkContent::copy_to(ObjChunk& chunk, ChunkMemory& memory) const {
  chunk.positions = memory.positions.copy(positions.elements());
  chunk.colors = memory.attributes.copy(colors_.elements());
  chunk.texcoords = memory.attributes.copy(texcoords.elements());
  chunk.normals = memory.attributes.copy(normals.elements());
  chunk.indices = memory.faces.copy(indices.elements());
  chunk.runs = memory.faces.copy(runs_.elements());
  chunk.bounds = bounds_of_usable(positions.elements());
  for (const Vec3d& position : positions.elements()) {
    chunk.has_unusable_position = chunk.has_unusable_position || !fits_float(position);
  }
  for (const FaceRun& run : runs_.elements()) {
    chunk.face_count += run.face_count;
    chunk.corner_count += uint64_t{run.face_count} * run.corner_count;
    chunk.triangle_count += uint64_t{run.face_count} * (run.corner_count - 2);
  }
}

}  // namespace tracer
