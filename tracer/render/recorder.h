// SPDX-License-Identifier: MIT
// What integrators tell about a sample while they compute it: nothing in production, words for
// describe_sample. Rendering and explaining run the same code.
#pragma once

#include <string>

#include "tracer/render/light_sampling.h"

namespace tracer {

struct NoRecorder {
  void camera(const Ray&) {}
  void hit(const Ray&, const Hit&, const Surface&, const Vec3d&, const Vec3d&) {}
  void sky(const Ray&, const Vec3d&, const Vec3d&) {}
  void light(const LightSample&, const char*, const Vec3d&) {}
  void occlusion(const Ray&, double) {}
  void end(const char*) {}
};

/// One line an event; vertices are numbered from the camera, 0. Throughput is that of the path up
/// to the vertex; radiance is what the sample has gathered so far, in a light's line what the
/// vertex scatters from it.
class TextRecorder {
 public:
  /// Positions are written in the file's coordinates, `mesh_origin` + position.
  TextRecorder(std::string& text, const Vec3d& mesh_origin)
      : text_(text), mesh_origin_(mesh_origin) {}

  void camera(const Ray& ray);
  void hit(const Ray& ray, const Hit& hit, const Surface& surface, const Vec3d& throughput,
           const Vec3d& radiance);
  void sky(const Ray& ray, const Vec3d& throughput, const Vec3d& radiance);
  void light(const LightSample& sample, const char* verdict, const Vec3d& scattered);
  /// `open`: the share of light that would come along the ray.
  void occlusion(const Ray& ray, double open);
  void end(const char* reason);

 private:
  std::string place(const Vec3d& position) const;

  std::string& text_;
  const Vec3d mesh_origin_;
  int vertex_count_ = 0;
};

}  // namespace tracer
