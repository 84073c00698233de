// SPDX-License-Identifier: MIT
// Small scenes of known radiance, and the means of what is rendered of them.
#pragma once

#include <memory>
#include <vector>

#include "tracer/bvh/build.h"
#include "tracer/render/render.h"

namespace tracer::test {

/// Triangles to be gathered into one mesh. Materials number from 0.
struct Triangles {
  Mesh mesh;

  void add(const Vec3f& a, const Vec3f& b, const Vec3f& c, uint32_t material = 0);
  /// The parallelogram at `corner` along two sides, its normal their cross product.
  void add_quad(const Vec3f& corner, const Vec3f& side, const Vec3f& other_side,
                uint32_t material = 0);
  void add_box(const Vec3f& min, const Vec3f& max, uint32_t material = 0);
  /// A convex polyhedron close to a sphere: an octahedron whose triangles are split `level` times.
  void add_sphere(const Vec3d& center, double radius, int level, uint32_t material = 0);
};

inline Material diffuse(double albedo, double emission = 0) {
  Material material;
  material.scattering.base_color = Vec3f(static_cast<float>(albedo));
  material.emission = Vec3f(static_cast<float>(emission));
  return material;
}

/// Through every triangle, or the tree and layout that a user gets.
enum class Tracing { brute_force, tree };

/// A world of 1x1 px, for a start; see set_camera.
World make_world(const Triangles& triangles, const std::vector<Material>& materials,
                 const Vec3d& sky, Tracing tracing = Tracing::tree);
void set_camera(World& world, const Camera& camera, Vec2i size_px);

/// A lit room with a ball in it, so that every branch of every integrator is taken.
World make_room(Vec2i size_px, Tracing tracing = Tracing::tree, int ball_level = 2);

/// Samples [0, sample_count) of every pixel.
Film render(const World& world, const Integrator& integrator, const RenderSettings& settings,
            Vec2i size_px, uint32_t sample_count);

struct Estimate {
  double mean = 0;
  double standard_error = 0;
};
/// Of the luminance of samples [0, sample_count) of a picture of one pixel.
Estimate estimate(const World& world, const Integrator& integrator, const RenderSettings& settings,
                  uint32_t sample_count);

}  // namespace tracer::test
