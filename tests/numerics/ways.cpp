// SPDX-License-Identifier: MIT
#include "tests/numerics/ways.h"

#include <vector>

#include <fmt/format.h>

namespace tracer::stress {
namespace {

// Calls check(i, way, is_occluded) and check_hit(i, way, hit) for each answer.
template <class CheckHit, class CheckOcclusion>
void for_each_answer(const Accel& accel, std::span<const Ray> rays, const CheckHit& check_hit,
                     const CheckOcclusion& check_occlusion) {
  const StopFlag never;
  RayCaster caster(accel, never);
  std::vector<Hit> hits(rays.size());
  std::vector<uint8_t> is_occluded(rays.size());
  caster.closest_hits(rays, hits);
  caster.occluded(rays, is_occluded);
  for (size_t i = 0; i < rays.size(); ++i) {
    check_hit(i, "closest_hits", hits[i]);
    check_hit(i, "closest_hit", caster.closest_hit(rays[i]));
    check_occlusion(i, "all occluded", is_occluded[i] != 0);
    check_occlusion(i, "occluded", caster.occluded(rays[i]));
  }
}

std::string replay(size_t i, const char* way, const Ray& ray) {
  return fmt::format("ray {}, {}: {}", i, way, literal(ray));
}

}  // namespace

BvhTree build_tree(const Builder& builder, const Mesh& mesh, const BuildSettings& settings) {
  Progress progress;
  const auto boxes = primitive_boxes(mesh);
  return builder.build(mesh_primitives(mesh, boxes), settings, progress);
}

World with_tree(const World& world, const BvhTree& tree, const Layout& layout) {
  Progress progress;
  World result = world;
  result.accel = std::make_shared<const Accel>(
      make_accel(world.scene->mesh, std::make_shared<const BvhTree>(tree), layout, progress));
  return result;
}

World in_production(const World& world) {
  return with_tree(world, build_tree(builders().front(), *world.scene->mesh), layouts().front());
}

std::string literal(const Hit& hit) {
  if (!hit.is_hit()) return "a miss";
  return fmt::format("primitive {} at t {:a}, u {:a}, v {:a}", hit.primitive, hit.t, hit.u, hit.v);
}

void check_answers(Trial& trial, const Accel& accel, std::span<const Ray> rays,
                   std::span<const Hit> expected) {
  for_each_answer(
      accel, rays,
      [&](size_t i, const char* way, const Hit& hit) {
        trial.check(are_same_bits(hit, expected[i]), [&] {
          return replay(i, way, rays[i]) + " gives " + literal(hit) + ", not " +
                 literal(expected[i]);
        });
      },
      [&](size_t i, const char* way, bool is_occluded) {
        trial.check(is_occluded == expected[i].is_hit(), [&] { return replay(i, way, rays[i]); });
      });
}

void check_all_hit(Trial& trial, const Accel& accel, std::span<const Ray> rays) {
  for_each_answer(
      accel, rays,
      [&](size_t i, const char* way, const Hit& hit) {
        trial.check(hit.is_hit(), [&] { return replay(i, way, rays[i]); });
      },
      [&](size_t i, const char* way, bool is_occluded) {
        trial.check(is_occluded, [&] { return replay(i, way, rays[i]); });
      });
}

}  // namespace tracer::stress
