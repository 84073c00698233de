// SPDX-License-Identifier: MIT
#include "tracer/render/aov.h"

#include <algorithm>
#include <limits>

#include "tracer/render/film_error.h"
#include "tracer/render/preview.h"
#include "tracer/render/render.h"

namespace tracer {
namespace {

/// Answers a block by value(ray, surface) where camera rays end, by 0 where they meet nothing.
template <class Value>
void find_on_first_surfaces(const World& world, const SampleBlock& block, const Value& value) {
  NoRecorder recorder;
  colour_first_surfaces(
      world, block, [](const Ray&) { return Vec3d(0); }, recorder, value);
}

void find_albedo(const World& world, RayCaster&, const RenderSettings&, const SampleBlock& block) {
  find_on_first_surfaces(world, block, [](const Ray&, const Surface& surface) {
    return Vec3d(surface.scattering.base_color);
  });
}

void find_normal(const World& world, RayCaster&, const RenderSettings&, const SampleBlock& block) {
  find_on_first_surfaces(world, block,
                         [](const Ray&, const Surface& surface) { return surface.shading_normal; });
}

/// Negative for nothing: what is not finite would be dropped.
void find_depth(const World& world, RayCaster&, const RenderSettings&, const SampleBlock& block) {
  for (size_t i = 0; i < block.size(); ++i) {
    const Ray& ray = block.camera_rays[i];
    const Hit& hit = block.camera_hits[i];
    const double along_axis = glm::dot(Vec3d(ray.direction), world.camera.forward);
    block.radiance[i] = Vec3d(hit.is_hit() ? along_axis * hit.t : -1);
  }
}

/// In two halves, each of which a float holds.
void find_primitive(const World&, RayCaster&, const RenderSettings&, const SampleBlock& block) {
  for (size_t i = 0; i < block.size(); ++i) {
    const uint32_t primitive = block.camera_hits[i].primitive;
    block.radiance[i] = {static_cast<double>(primitive & 0xffff),
                         static_cast<double>(primitive >> 16), 0};
  }
}

template <class F>
void for_each_pixel(const Film& film, const F& f) {
  for (int y = 0; y < film.size_px().y; ++y) {
    for (int x = 0; x < film.size_px().x; ++x) f(x, y);
  }
}

void fill_with_means(const Film&, const Film& found, ImageLayer& layer) {
  auto& values = layer.values.emplace<std::vector<float>>();
  for_each_pixel(found, [&](int x, int y) {
    const Vec3f mean = found.mean(x, y);
    values.insert(values.end(), {mean.x, mean.y, mean.z});
  });
}

void fill_with_depths(const Film&, const Film& found, ImageLayer& layer) {
  auto& values = layer.values.emplace<std::vector<float>>();
  for_each_pixel(found, [&](int x, int y) {
    const float depth = found.mean(x, y).x;
    values.push_back(depth < 0 ? std::numeric_limits<float>::infinity() : depth);
  });
}

void fill_with_primitives(const Film&, const Film& found, ImageLayer& layer) {
  auto& values = layer.values.emplace<std::vector<uint32_t>>();
  for_each_pixel(found, [&](int x, int y) {
    const Vec3f halves = found.mean(x, y);
    values.push_back(static_cast<uint32_t>(halves.x) | static_cast<uint32_t>(halves.y) << 16);
  });
}

void fill_with_counts(const Film& picture, const Film&, ImageLayer& layer) {
  auto& values = layer.values.emplace<std::vector<uint32_t>>();
  for_each_pixel(picture, [&](int x, int y) { values.push_back(picture.sample_count(x, y)); });
}

void fill_with_errors(const Film& picture, const Film&, ImageLayer& layer) {
  auto& values = layer.values.emplace<std::vector<float>>();
  for_each_pixel(picture, [&](int x, int y) {
    values.push_back(static_cast<float>(pixel_error(picture, x, y)));
  });
}

constexpr Aov table[] = {
    {"albedo", "base colour of what is seen first; black where that is nothing", "RGB",
     averaged_aov_samples, find_albedo, fill_with_means},
    {"normal", "its shading normal in world space, towards the viewer; 0 for nothing", "XYZ",
     averaged_aov_samples, find_normal, fill_with_means},
    {"depth", "of the first sample along the view axis, in the model's unit; infinite for nothing",
     "Z", 1, find_depth, fill_with_depths},
    {"primitive", "triangle that the first sample meets, from 0; 4294967295 for nothing", "X", 1,
     find_primitive, fill_with_primitives},
    {"samples", "of the pixel", "X", 0, nullptr, fill_with_counts},
    {"error", "of the pixel, estimated: (x - r)^2 / (r^2 + 0.01)", "X", 0, nullptr,
     fill_with_errors},
};

Film find(const Aov& aov, const World& world, const RenderSettings& settings, Vec2i size_px,
          uint32_t most_samples) {
  Film film(aov.find != nullptr ? size_px : Vec2i(0));
  const Integrator integrator{aov.name, aov.name, aov.what, aov.find, nullptr};
  const StopFlag never;
  for (uint32_t sample = 0; sample < std::min(aov.samples, most_samples); ++sample) {
    render_pass(world, integrator, settings, {sample, 1}, film, never);
  }
  return film;
}

}  // namespace

std::span<const Aov> aovs() {
  return table;
}

const Aov* find_aov(std::string_view name) {
  const auto* found = std::ranges::find(table, name, &Aov::name);
  return found == std::end(table) ? nullptr : found;
}

std::vector<ImageLayer> render_aovs(std::span<const Aov* const> wanted, const World& world,
                                    const RenderSettings& settings, const Film& picture,
                                    uint32_t most_samples) {
  std::vector<ImageLayer> layers;
  for (const Aov* aov : wanted) {
    ImageLayer& layer = layers.emplace_back();
    layer.name = aov->name;
    layer.channels = aov->channels;
    aov->fill(picture, find(*aov, world, settings, picture.size_px(), most_samples), layer);
  }
  return layers;
}

}  // namespace tracer
