// SPDX-License-Identifier: MIT
#include "tracer/obj/make_mesh.h"

#include <atomic>
#include <limits>
#include <optional>
#include <span>

#include "tracer/base/parallel.h"
#include "tracer/obj/mesh_attributes.h"
#include "tracer/obj/triangulate.h"

namespace tracer {
namespace {

constexpr double largest_float = std::numeric_limits<float>::max();
constexpr size_t faces_a_block = 4096;
constexpr size_t positions_a_block = 16384;

bool fits_float(const Vec3d& position) {
  return is_finite(position) && max_abs(position) <= largest_float;
}

std::span<const ObjCorner> corners_of(const ObjFile& file, const ObjFace& face) {
  return std::span(file.corners).subspan(face.first_corner, face.corner_count);
}

bool has_usable_corners(const ObjFile& file, const ObjFace& face) {
  for (const ObjCorner& corner : corners_of(file, face)) {
    if (!fits_float(file.positions[corner.position])) return false;
  }
  return true;
}

size_t block_count_of(const ObjFile& file) {
  return (file.faces.size() + faces_a_block - 1) / faces_a_block;
}

std::span<const ObjFace> block_of(const ObjFile& file, size_t block) {
  const std::span<const ObjFace> rest = std::span(file.faces).subspan(block * faces_a_block);
  return rest.first(std::min(rest.size(), faces_a_block));
}

/// The centre of the bounds of all usable faces; the origin where there is none.
Vec3d find_center(const ObjFile& file) {
  std::vector<WorldBounds> blocks(block_count_of(file));
  parallel_for_each_index(0, blocks.size(), [&](size_t block) {
    for (const ObjFace& face : block_of(file, block)) {
      if (!has_usable_corners(file, face)) continue;
      for (const ObjCorner& corner : corners_of(file, face)) {
        blocks[block].extend(file.positions[corner.position]);
      }
    }
  });
  WorldBounds bounds;
  for (const WorldBounds& block : blocks) bounds.extend(block);
  return bounds.min.x <= bounds.max.x ? 0.5 * bounds.min + 0.5 * bounds.max : Vec3d(0.0);
}

/// Positions that no face can use become the centre.
std::vector<Vec3f> make_positions(const ObjFile& file, const Vec3d& center) {
  std::vector<Vec3f> positions(file.positions.size());
  parallel_for_ranges(0, positions.size(), positions_a_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Vec3d offset = file.positions[i] - center;
      positions[i] = fits_float(offset) ? Vec3f(offset) : Vec3f(0.0f);
    }
  });
  return positions;
}

/// Triangulates one block of faces, as it is seen after rounding.
class BlockTriangulator {
 public:
  BlockTriangulator(const ObjFile& file, std::span<const Vec3f> positions, const std::string& path)
      : file_(file), positions_(positions), path_(path) {}

  TriangleBlock triangulate(std::span<const ObjFace> faces) {
    for (const ObjFace& face : faces) {
      if (!has_usable_corners(file_, face)) {
        drop(face, "a vertex of the face is not finite, or too large");
      } else if (!add(face)) {
        drop(face, "the face has no area");
      }
    }
    return std::move(block_);
  }

 private:
  void drop(const ObjFace& face, const char* why) {
    ++block_.dropped_faces;
    block_.warnings.add({path_, face.line, why});
  }

  /// False, with nothing added, where no triangle of the face has an area.
  bool add(const ObjFace& face) {
    points_.clear();
    for (const ObjCorner& corner : corners_of(file_, face)) {
      points_.emplace_back(positions_[corner.position]);
    }
    triangles_.clear();
    triangulator_.triangulate(points_, triangles_);
    bool has_any_area = false;
    for (const Vec3u& triangle : triangles_) has_any_area = has_any_area || has_area(triangle);
    if (!has_any_area) return false;
    for (const Vec3u& triangle : triangles_) {
      block_.corners.push_back(triangle + Vec3u(face.first_corner));
      block_.materials.push_back(face.material);
      for (int i = 0; i < 3; ++i) {
        const ObjCorner& corner = file_.corners[face.first_corner + triangle[i]];
        block_.bounds.extend(file_.positions[corner.position]);
      }
    }
    return true;
  }

  bool has_area(const Vec3u& triangle) const {
    const Vec3d& origin = points_[triangle.x];
    return glm::cross(points_[triangle.y] - origin, points_[triangle.z] - origin) != Vec3d(0.0);
  }

  const ObjFile& file_;
  std::span<const Vec3f> positions_;
  const std::string& path_;
  Triangulator triangulator_;
  std::vector<Vec3d> points_;
  std::vector<Vec3u> triangles_;
  TriangleBlock block_;
};

std::string why_nothing_to_show(const ObjFile& file) {
  const std::string nothing = "no triangles to show: ";
  const int64_t face_count = file.dropped_faces + static_cast<int64_t>(file.faces.size());
  if (face_count == 1) return nothing + "its only face is faulty";
  if (face_count > 1) return nothing + "all " + std::to_string(face_count) + " faces are faulty";
  if (!file.positions.empty()) return nothing + "the file has vertices, but no faces";
  return nothing + "this does not look like an OBJ file";
}

/// The first fault says more than that all faces have one.
[[noreturn]] void fail(const ObjFile& file, const Warnings& warnings, const std::string& path) {
  std::string what = why_nothing_to_show(file);
  for (const Warnings* source : {&file.warnings, &warnings}) {
    if (source->messages().empty() || (file.faces.empty() && file.dropped_faces == 0)) continue;
    const Message& first = source->messages().front();
    what += " (line " + std::to_string(first.line) + ": " + first.what + ')';
    break;
  }
  throw LoadError({path, 0, what});
}

}  // namespace

ObjMesh make_mesh(const ObjFile& file, const std::string& path, Progress& progress) {
  progress.start_stage("making triangles");
  ObjMesh result;
  result.mesh.origin = find_center(file);
  result.mesh.positions = make_positions(file, result.mesh.origin);

  std::vector<TriangleBlock> blocks(block_count_of(file));
  std::atomic<size_t> blocks_done{0};
  parallel_for_each_index(0, blocks.size(), [&](size_t block) {
    progress.throw_if_stopped();
    blocks[block] =
        BlockTriangulator(file, result.mesh.positions, path).triangulate(block_of(file, block));
    progress.set_fraction(static_cast<double>(++blocks_done) / static_cast<double>(blocks.size()));
  });
  for (const TriangleBlock& block : blocks) {
    result.dropped_faces += block.dropped_faces;
    result.warnings.append(block.warnings);
    result.bounds.extend(block.bounds);
  }
  fill_triangles(file, blocks, result.mesh);
  if (result.mesh.triangles.empty()) fail(file, result.warnings, path);
  // Rounding keeps order: these are the bounds of the rounded positions.
  result.mesh.bounds = {Vec3f(result.bounds.min - result.mesh.origin),
                        Vec3f(result.bounds.max - result.mesh.origin)};
  return result;
}

}  // namespace tracer
