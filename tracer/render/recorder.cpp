// SPDX-License-Identifier: MIT
#include "tracer/render/recorder.h"

#include <iterator>

#include <fmt/format.h>

namespace tracer {
namespace {

std::string words(const Vec3d& v) {
  return fmt::format("({:.6g} {:.6g} {:.6g})", v.x, v.y, v.z);
}

template <class... Arguments>
void append(std::string& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

}  // namespace

std::string TextRecorder::place(const Vec3d& position) const {
  const Vec3d v = mesh_origin_ + position;
  return fmt::format("({:.10g} {:.10g} {:.10g})", v.x, v.y, v.z);
}

void TextRecorder::camera(const Ray& ray) {
  append(text_, "{}  camera  origin {}  direction {}\n", vertex_count_++, place(ray.origin),
         words(ray.direction));
}

void TextRecorder::hit(const Ray& ray, const Hit& hit, const Surface& surface,
                       const Vec3d& throughput, const Vec3d& radiance) {
  append(text_, "{}  triangle {}  t {:.9g}  position {}  normal {}  albedo {}", vertex_count_++,
         hit.primitive, hit.t * glm::length(Vec3d(ray.direction)), place(surface.position),
         words(surface.shading_normal), words(Vec3d(surface.scattering.base_color)));
  if (surface.emission != Vec3d(0)) append(text_, "  emission {}", words(surface.emission));
  append(text_, "  throughput {}  radiance {}\n", words(throughput), words(radiance));
}

void TextRecorder::sky(const Ray& ray, const Vec3d& throughput, const Vec3d& radiance) {
  append(text_, "{}  sky  direction {}  throughput {}  radiance {}\n", vertex_count_++,
         words(ray.direction), words(throughput), words(radiance));
}

void TextRecorder::light(const LightSample& sample, const char* verdict, const Vec3d& scattered) {
  const std::string what = sample.triangle == no_primitive
                               ? std::string("sky")
                               : fmt::format("triangle {}", sample.triangle);
  append(text_, "   light  {}  direction {}  pdf {:.6g}  {}  scattered {}\n", what,
         words(sample.direction), sample.pdf, verdict, words(scattered));
}

void TextRecorder::occlusion(const Ray& ray, double open) {
  append(text_, "   occlusion  direction {}  {} open\n", words(ray.direction), open);
}

void TextRecorder::end(const char* reason) {
  append(text_, "   end  {}\n", reason);
}

}  // namespace tracer
