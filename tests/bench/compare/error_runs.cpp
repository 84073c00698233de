// SPDX-License-Identifier: MIT
#include "tests/bench/compare/error_runs.h"

#include <utility>

#include "app/stopwatch.h"
#include "tracer/render/pass_schedule.h"
#include "tracer/render/render.h"

namespace bench {
namespace {

constexpr int first_reference_seed = 1'000'000;

template <class Change>
Variant changed(std::string_view name, std::string_view what, const Change& change) {
  Variant variant{name, what, {}};
  change(variant);
  return variant;
}

}  // namespace

std::vector<Variant> variants() {
  return {
      {"Boxwood", "as it comes: Sobol samples, the same number for each pixel", {}},
      changed("adaptive", "samples go where the error is",
              [](Variant& v) { v.settings.allocation = tracer::Allocation::adaptive; }),
      changed("independent", "independent random numbers",
              [](Variant& v) { v.settings.sampler = tracer::SamplerKind::independent; }),
      changed("no-skip", "the general path, which leaves nothing out",
              [](Variant& v) { v.settings.skips = false; }),
      changed("spatial median", "the tree of the simplest builder",
              [](Variant& v) { v.builder = "median"; }),
      changed("spatial splits", "the tree of the most thorough builder",
              [](Variant& v) { v.builder = "spatial-split"; }),
  };
}

std::vector<Snapshot> render_ladder(const ErrorScene& scene, const Variant& variant, int seed,
                                    std::span<const double> seconds) {
  const tracer::Builder* builder =
      variant.builder != nullptr ? tracer::find_builder(variant.builder) : nullptr;
  const tracer::World world =
      builder != nullptr ? with_builder(scene.world, *builder) : scene.world;
  const tracer::Integrator& integrator = *tracer::find_integrator("path");
  tracer::RenderSettings settings = variant.settings;
  settings.seed = seed;
  tracer::Film film(scene.size_px);
  tracer::PassSchedule schedule(settings);
  const tracer::StopFlag never;
  std::vector<Snapshot> ladder;
  uint64_t samples = 0;
  double spent = 0;
  for (size_t next = 0; next < seconds.size();) {
    const app::Stopwatch stopwatch;
    samples += render_pass(world, integrator, settings, schedule.pass(), film, never).samples;
    schedule.advance(film);
    spent += stopwatch.seconds();
    if (schedule.pass().sample == 0 || spent < seconds[next]) continue;
    const double pixels = static_cast<double>(scene.size_px.x) * scene.size_px.y;
    while (next + 1 < seconds.size() && seconds[next + 1] <= spent) ++next;
    ladder.push_back(
        {static_cast<int>(next), spent, static_cast<double>(samples) / pixels, film.image()});
    ++next;
  }
  return ladder;
}

Reference render_reference(const ErrorScene& scene, double seconds) {
  Reference reference;
  const double times[] = {seconds};
  const Variant standard = variants().front();
  Snapshot first = std::move(render_ladder(scene, standard, first_reference_seed, times).front());
  Snapshot second =
      std::move(render_ladder(scene, standard, first_reference_seed + 1, times).front());
  reference.samples = (first.samples + second.samples) / 2;
  reference.first = std::move(first.image);
  reference.second = std::move(second.image);
  return reference;
}

}  // namespace bench
