// SPDX-License-Identifier: MIT
#include <utility>

#include <benchmark/benchmark.h>

#include "tests/support/test_meshes.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/metrics.h"
#include "tracer/bvh/trace/accel.h"

namespace tracer {
namespace {

// A pinhole camera in front of the model: neighbouring rays are alike, as in a picture.
std::vector<Ray> camera_rays(const Mesh& mesh) {
  constexpr int side = 256;
  const Vec3f center = mesh.bounds.center();
  const auto radius = static_cast<float>(0.5 * glm::length(mesh.bounds.extent()));
  const Vec3f eye = center + radius * Vec3f(0.8f, 0.6f, 1.6f);
  std::vector<Ray> rays;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vec3f offset = Vec3f(x, y, 0) / static_cast<float>(side) - Vec3f(0.5f, 0.5f, 0);
      rays.push_back({.origin = eye, .direction = center + 1.5f * radius * offset - eye});
    }
  }
  return rays;
}

// From the bounding sphere to somewhere inside: no two alike, as after a diffuse bounce.
std::vector<Ray> random_rays(const Mesh& mesh) {
  RandomSource random(1);
  const Vec3f center = mesh.bounds.center();
  const auto radius = static_cast<float>(0.5 * glm::length(mesh.bounds.extent()));
  std::vector<Ray> rays;
  for (int i = 0; i < 65536; ++i) {
    const Vec3f from = center + radius * glm::normalize(random.vector(-1, 1));
    const Vec3f to = center + 0.5f * radius * random.vector(-1, 1);
    rays.push_back({.origin = from, .direction = to - from});
  }
  return rays;
}

void bench_build(benchmark::State& state, const Builder& builder, const Mesh& mesh) {
  const auto boxes = primitive_boxes(mesh);
  for (auto _ : state) {
    Progress progress;
    benchmark::DoNotOptimize(builder.build(mesh_primitives(mesh, boxes), {}, progress));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(boxes.size()));
}

void bench_closest_hit(benchmark::State& state, const Accel& accel, const std::vector<Ray>& rays,
                       double sah_cost) {
  const StopFlag stop;
  RayCaster caster(accel, stop);
  double sum = 0;
  size_t next = 0;
  for (auto _ : state) {
    const Hit hit = caster.closest_hit(rays[next]);
    if (hit.is_hit()) sum += hit.t;
    next = next + 1 < rays.size() ? next + 1 : 0;
  }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(state.iterations());
  state.counters["sah"] = sah_cost;
}

void register_model(const std::string& name, const std::string& path) {
  const auto mesh = std::make_shared<const Mesh>(read_plain_obj(path));
  if (mesh->triangles.empty()) return;
  for (const Builder& builder : builders()) {
    const std::string suffix = '/' + name + '/' + std::string(builder.name);
    benchmark::RegisterBenchmark(
        ("build" + suffix).c_str(),
        [&builder, mesh](benchmark::State& state) { bench_build(state, builder, *mesh); })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    Progress progress;
    const auto boxes = primitive_boxes(*mesh);
    BvhTree tree = builder.build(mesh_primitives(*mesh, boxes), {}, progress);
    const double sah_cost = measure(tree).sah_cost;
    const Accel accel = make_accel(mesh, std::move(tree), layouts().front(), progress);
    for (const auto& [kind, rays] :
         {std::pair{"camera", camera_rays(*mesh)}, std::pair{"random", random_rays(*mesh)}}) {
      benchmark::RegisterBenchmark(("closest_hit/" + std::string(kind) + suffix).c_str(),
                                   [accel, sah_cost, rays = rays](benchmark::State& state) {
                                     bench_closest_hit(state, accel, rays, sah_cost);
                                   });
    }
  }
}

}  // namespace
}  // namespace tracer

int main(int argc, char** argv) {
  tracer::register_model("cow", BOXWOOD_SHARED_DIR "/models/cow.obj");
  tracer::register_model("bunny", BOXWOOD_SHARED_DIR "/models/stanford-bunny.obj");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
