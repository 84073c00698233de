// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tracer/geometry/mesh.h"
#include "tracer/scene/bsdf_features.h"
#include "tracer/scene/light_tree.h"
#include "tracer/scene/material.h"
#include "tracer/scene/texture.h"

namespace tracer {

/// What some of a scene's materials have, their maps included; all of it when in doubt.
struct MaterialSummary {
  BsdfFeatures features = BsdfFeatures::all;
  bool has_alpha = true;             // a share of rays passes them
  bool has_shining_textures = true;  // which are not among the lights
};
MaterialSummary summarize(const std::vector<Material>& materials);

enum class Shading { flat, smooth };

/// Triangles that emit, to be picked by power; where they are many, by power and place.
struct EmissiveTriangles {
  std::vector<uint32_t> triangles;
  std::vector<double> cumulative;     // of power / total power; the last is 1
  std::vector<double> probabilities;  // of picking each by power
  LightTree tree;                     // over `triangles`; empty where they are few
  bool empty() const { return triangles.empty(); }
};

/// Triangles of materials that emit, ascending. A triangle's power is its area times the luminance
/// of its emission; both sides emit.
EmissiveTriangles make_emissive_triangles(const Mesh& mesh, const std::vector<Material>& materials);

/// What there is to see. The heavy parts are shared between versions of a scene.
struct Scene {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const std::vector<Material>> materials;  // at least one
  std::shared_ptr<const std::vector<Texture>> textures;
  std::shared_ptr<const EmissiveTriangles> lights;
  MaterialSummary surfaces;
  Shading shading = Shading::flat;
  // Smooth shading only: one unit normal a corner by index, as in Mesh; zero where the triangles
  // around a position cancel out, and the geometric normal stands in.
  std::shared_ptr<const LargeVector<Vec3f>> shading_normals;
  std::shared_ptr<const LargeVector<Vec3u>> shading_normal_indices;
};

/// The same scene shaded flat or smooth. Smooth takes the file's normals, and where it has none
/// the angle-weighted mean over the triangles at a position [Thurmer 1998].
Scene with_shading(const Scene& scene, Shading shading);

/// A mesh's triangle in double.
struct Triangle {
  Vec3d v0, v1, v2;
  Vec3d at(double u, double v) const { return (1 - u - v) * v0 + u * v1 + v * v2; }
  /// Of twice the area's length, right-handed about v0 v1 v2.
  Vec3d area_normal() const { return glm::cross(v1 - v0, v2 - v0); }
  double area() const { return 0.5 * glm::length(area_normal()); }
};
Triangle triangle_at(const Mesh& mesh, uint32_t triangle);

/// How far along its unit normal a ray must leave a triangle to start strictly outside, even when
/// its origin is then rounded to float.
double clearance_of(const Triangle& triangle, const Vec3d& normal);

/// What shading needs to know of a Hit. Positions are relative to mesh.origin.
struct Surface {
  Vec3d position;          // in double, from barycentric weights, a hair off the edges
  Vec3d geometric_normal;  // unit length, towards the side that the ray came from
  Vec3d shading_normal;    // unit length, same side
  Principled scattering;
  Vec3d emission;        // radiance towards the ray
  double clearance = 0;  // of the triangle along geometric_normal
  uint32_t triangle = 0;
  bool is_front = true;  // geometric_normal is the triangle's right-handed one
};
/// `footprint` is the width of the ray where it hits, as that of a cone: textures are taken as
/// finely as that; 0 is finest.
Surface surface_at(const Scene& scene, const Hit& hit, const Vec3d& ray_direction,
                   double footprint = 0);

/// The share of rays that meet the surface here, in [0, 1]; others pass as if it were not there.
double opacity_at(const Scene& scene, const Hit& hit);

/// The float origin of a ray that leaves the surface towards the side of geometric_normal.
Vec3f offset_origin(const Surface& surface);
/// Of one that goes on through it.
Vec3f offset_origin_behind(const Surface& surface);

}  // namespace tracer
