// SPDX-License-Identifier: MIT
#if defined(TRACER_DIFFUSE_PATHS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_DIFFUSE_PATHS_INL_H
#undef TRACER_DIFFUSE_PATHS_INL_H
#else
#define TRACER_DIFFUSE_PATHS_INL_H
#endif

#include <array>

#include "tracer/render/directions-inl.h"
#include "tracer/render/integrator.h"
#include "tracer/render/light_sampling.h"
#include "tracer/render/sampler_lanes-inl.h"
#include "tracer/render/sampling.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

/// A number a path, and a vector a path.
template <class T>
struct alignas(64) Column {
  std::array<T, SampleBlock::max_size> values{};

  T& operator[](size_t i) { return values[i]; }
  Lanes at(size_t first) const { return Lanes::load(&values[first]); }
  void put(size_t first, Lanes lanes) { lanes.store(&values[first]); }
};
template <class T>
struct Columns {
  Column<T> x, y, z;

  Vector3<Lanes> at(size_t first) const { return {x.at(first), y.at(first), z.at(first)}; }
  void put(size_t first, const Vector3<Lanes>& lanes) {
    x.put(first, lanes.x), y.put(first, lanes.y), z.put(first, lanes.z);
  }
  template <class Vector>
  void set(size_t i, const Vector& vector) {
    x[i] = vector.x, y[i] = vector.y, z[i] = vector.z;
  }
  template <class Vector>
  Vector get(size_t i) {
    return Vector(x[i], y[i], z[i]);
  }
};

struct TriangleColumns {
  Columns<float> v0, v1, v2;

  Corners<Lanes> at(size_t first) const { return {v0.at(first), v1.at(first), v2.at(first)}; }
  void set(size_t i, const Mesh& mesh, uint32_t triangle) {
    const Vec3u& corners = mesh.triangles[triangle];
    v0.set(i, mesh.positions[corners.x]);
    v1.set(i, mesh.positions[corners.y]);
    v2.set(i, mesh.positions[corners.z]);
  }
};

/// The paths of a block, as in PathWavefront.
class DiffusePaths {
 public:
  DiffusePaths(const World& world, RayCaster& caster, const RenderSettings& settings,
               const SampleBlock& block)
      : scene_(*world.scene),
        mesh_(*scene_.mesh),
        caster_(caster),
        settings_(settings),
        block_(block),
        samplers_(block.samplers),
        lights_(world, settings),
        sky_(lights_.sky().radiance(Vec3d(0, 0, 1))) {}

  void run() {
    start();
    for (int scatterings = 0;; ++scatterings) {
      shade(scatterings);
      if (count_ > 0 && !lights_.empty()) add_light();
      scatter(scatterings);
      if (count_ == 0) return;
      if (scatterings + 1 == settings_.bounces && lights_.empty()) return find_sky();
      caster_.closest_hits({rays_.data(), count_}, {hits_.data(), count_});
    }
  }

 private:
  static constexpr size_t max_size = SampleBlock::max_size;
  static size_t step() { return hn::Lanes(LaneTag()); }

  void start() {
    count_ = block_.size();
    for (size_t i = 0; i < count_; ++i) {
      samples_[i] = static_cast<uint32_t>(i);
      throughput_.set(i, Vec3d(1));
      rays_[i] = block_.camera_rays[i];
      hits_[i] = block_.camera_hits[i];
      block_.radiance[i] = Vec3d(0);
    }
  }

  /// For last segments, where only the sky shines: what else they would meet is not asked.
  void find_sky() {
    caster_.occluded({rays_.data(), count_}, {is_occluded_.data(), count_});
    for (size_t i = 0; i < count_; ++i) {
      if (is_occluded_[i]) continue;
      block_.radiance[samples_[i]] += throughput_.get<Vec3d>(i) * sky_;
    }
  }

  void shade(int scatterings) {
    size_t kept = 0;
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t sample = samples_[i];
      const Hit& hit = hits_[i];
      const Vec3d throughput = throughput_.get<Vec3d>(i);
      Vec3d& radiance = block_.radiance[sample];
      if (!hit.is_hit()) {
        radiance += throughput * sky_;
        continue;
      }
      const Material& material = (*scene_.materials)[mesh_.material_of(hit.primitive)];
      if (material.emission != Vec3f(0)) {
        double weight = 1;
        if (scatterings > 0) {
          const LightReceiver from{rays_[i].origin, left_normal_.get<Vec3f>(i)};
          weight =
              power_heuristic(scatter_pdf_[i], lights_.pdf(from, hit.primitive, rays_[i], hit.t));
        }
        radiance += throughput * Vec3d(material.emission) * weight;
      }
      if (scatterings == settings_.bounces || material.scattering.base_color == Vec3f(0)) continue;
      samples_[kept] = sample;
      throughput_.set(kept, throughput);
      triangle_.set(kept, mesh_, hit.primitive);
      u_[kept] = hit.u;
      v_[kept] = hit.v;
      direction_.set(kept, rays_[i].direction);
      albedo_.set(kept, material.scattering.base_color);
      ++kept;
    }
    count_ = kept;
    for (size_t i = 0; i < count_; i += step()) {
      const FlatSurface<Lanes> surface =
          flat_surface(triangle_.at(i), u_.at(i), v_.at(i), direction_.at(i));
      position_.put(i, surface.position);
      normal_.put(i, surface.normal);
      origin_.put(i, surface.position + surface.clearance * surface.normal);
    }
  }

  void add_light() {
    samplers_.next_2d(samples_.data(), count_, &u_[0], &v_[0]);
    for (size_t i = 0; i < count_; ++i) {
      receivers_[i] = {origin_.get<Vec3f>(i), Vec3f(normal_.get<Vec3d>(i))};
    }
    lights_.pick({receivers_.data(), count_}, {&u_[0], count_}, {picks_.data(), count_});
    for (size_t i = 0; i < count_; ++i) {
      light_probability_[i] = picks_[i].probability;
      triangle_.set(i, mesh_, picks_[i].triangle);
      u_[i] = picks_[i].rest;
    }
    for (size_t i = 0; i < count_; i += step()) {
      const Vector3<Lanes> normal = normal_.at(i);
      const FlatSurface<Lanes> surface{position_.at(i), normal, Lanes(0)};
      const Vector3<Lanes> origin = origin_.at(i);
      const LightPoint<Lanes> point =
          light_point(triangle_.at(i), u_.at(i), v_.at(i), surface, origin);
      const Lanes cosine = dot(point.direction, normal);
      const Lanes pdf = light_probability_.at(i) * point.pdf;
      const Lanes scatter_pdf = cosine / Lanes(std::numbers::pi);
      const Lanes weight = power_heuristic(pdf, scatter_pdf) * scatter_pdf / pdf;
      const LaneMask is_lit = (pdf > Lanes(0)) & (cosine > Lanes(0));
      weight_.put(i, select(is_lit, weight, Lanes(0)));
      direction_.put(i, point.end - origin);
    }
    size_t shadow_count = 0;
    for (size_t i = 0; i < count_; ++i) {
      shadow_rays_[shadow_count] = {
          .origin = origin_.get<Vec3f>(i), .direction = direction_.get<Vec3f>(i), .t_max = 1};
      lit_[shadow_count] = static_cast<uint32_t>(i);
      shadow_count += weight_[i] > 0;
    }
    caster_.occluded({shadow_rays_.data(), shadow_count}, {is_occluded_.data(), shadow_count});
    for (size_t k = 0; k < shadow_count; ++k) {
      if (is_occluded_[k]) continue;
      const uint32_t i = lit_[k];
      const Material& material = (*scene_.materials)[mesh_.material_of(picks_[i].triangle)];
      const Vec3d radiance = albedo_.get<Vec3d>(i) * Vec3d(material.emission) * weight_[i];
      block_.radiance[samples_[i]] += throughput_.get<Vec3d>(i) * radiance;
    }
  }

  void scatter(int scatterings) {
    samplers_.next_2d(samples_.data(), count_, &u_[0], &v_[0]);
    for (size_t i = 0; i < count_; i += step()) {
      const Vector3<Lanes> normal = normal_.at(i);
      const Vector3<Lanes> direction = cosine_hemisphere(normal, u_.at(i), v_.at(i));
      direction_.put(i, direction);
      // As the ray will have it.
      above_.put(i, dot(direction_.at(i), normal));
      const Lanes cosine = dot(direction, normal);
      scatter_pdf_.put(i, select(cosine > Lanes(0), cosine / Lanes(std::numbers::pi), Lanes(0)));
      const Vector3<Lanes> throughput = throughput_.at(i), albedo = albedo_.at(i);
      throughput_.put(i,
                      {throughput.x * albedo.x, throughput.y * albedo.y, throughput.z * albedo.z});
    }
    const bool is_roulette = scatterings + 1 >= first_roulette;
    if (is_roulette) samplers_.next(samples_.data(), count_, &u_[0]);
    size_t kept = 0;
    for (size_t i = 0; i < count_; ++i) {
      if (!(above_[i] > 0)) continue;
      const uint32_t sample = samples_[i];
      Vec3d throughput = throughput_.get<Vec3d>(i);
      if (is_roulette) {
        const double survival = survival_probability(throughput);
        if (u_[i] >= survival) continue;
        throughput /= survival;
      }
      rays_[kept] = {.origin = origin_.get<Vec3f>(i), .direction = direction_.get<Vec3f>(i)};
      samples_[kept] = sample;
      throughput_.set(kept, throughput);
      left_normal_.set(kept, normal_.get<Vec3d>(i));
      scatter_pdf_[kept] = scatter_pdf_[i];
      ++kept;
    }
    count_ = kept;
  }

  const Scene& scene_;
  const Mesh& mesh_;
  RayCaster& caster_;
  const RenderSettings& settings_;
  const SampleBlock& block_;
  SamplerLanes samplers_;
  const Lights lights_;
  const Vec3d sky_;

  // Of the paths under way, in the order of their samples: [0, count_) of each.
  size_t count_ = 0;
  std::array<uint32_t, max_size> samples_;
  Columns<double> throughput_;
  Column<double> scatter_pdf_;
  Columns<float> left_normal_;  // of the surface that the ray comes from
  std::array<Ray, max_size> rays_;
  std::array<Hit, max_size> hits_;
  // Their surfaces.
  TriangleColumns triangle_;
  Column<double> u_, v_;
  Columns<float> direction_;
  Columns<float> albedo_;
  Columns<double> position_;
  Columns<double> normal_;
  Columns<float> origin_;
  Column<double> above_;
  // Light that may reach them.
  std::array<LightReceiver, max_size> receivers_;
  std::array<Lights::Pick, max_size> picks_;
  Column<double> light_probability_;
  Column<double> weight_;
  std::array<uint32_t, max_size> lit_;
  std::array<Ray, max_size> shadow_rays_;
  std::array<uint8_t, max_size> is_occluded_;
};

// NOLINTNEXTLINE(misc-definitions-in-headers): each instruction set has a namespace of its own.
void DiffusePathsOf(const World& world, RayCaster& rays, const RenderSettings& settings,
                    const SampleBlock& block) {
  DiffusePaths(world, rays, settings, block).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
