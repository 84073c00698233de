// SPDX-License-Identifier: MIT
// Path tracing: error against time, beside Cycles.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/cycles_runs.h"
#include "tests/bench/compare/error_records.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/report_files.h"
#include "tracer/render/write_image.h"

namespace bench {
namespace {

constexpr double first_rung_seconds = 0.25;

std::vector<double> rungs_until(double longest_seconds) {
  std::vector<double> rungs;
  for (double seconds = first_rung_seconds; seconds < 0.999 * longest_seconds; seconds *= 2) {
    rungs.push_back(seconds);
  }
  rungs.push_back(longest_seconds);
  return rungs;
}

/// All seeds of one tracer on one scene.
class Runs {
 public:
  explicit Runs(std::string tracer) : tracer_(std::move(tracer)) {}

  void add(std::vector<Snapshot> ladder, const Reference& reference) {
    std::vector<MeasuredSnapshot>& seed = seeds_.emplace_back();
    for (const Snapshot& snapshot : ladder) {
      seed.push_back({snapshot.rung, snapshot.seconds, snapshot.samples,
                      measure_errors(snapshot.image, reference)});
    }
    if (seeds_.size() <= 2) last_.push_back(std::move(ladder.back().image));
  }

  ErrorCurve curve(const std::string& scene) const { return make_curve(scene, tracer_, seeds_); }
  /// Without what the tracer takes for the picture and the reference does not.
  ErrorCurve peer_curve(const std::string& scene, const Reference& reference) const {
    const double systematic =
        last_.size() < 2 ? 0 : std::max(0.0, systematic_relmse(last_[0], last_[1], reference));
    return make_curve(scene, tracer_, seeds_, systematic);
  }

 private:
  std::string tracer_;
  std::vector<std::vector<MeasuredSnapshot>> seeds_;
  std::vector<tracer::Image> last_;  // of the first two seeds
};

void keep(const Reference& reference, const std::filesystem::path& folder, std::string_view scene) {
  std::filesystem::create_directories(folder);
  for (const auto& [half, image] : {std::pair("a", &reference.first), {"b", &reference.second}}) {
    write_image(folder / fmt::format("reference-{}-{}.pfm", scene, half), *image, 0);
  }
}

/// Seed by seed, so that what else the machine does meets all tracers.
std::vector<ErrorCurve> measure(const ErrorSceneEntry& entry, const ErrorScene& scene,
                                const Options& options, const std::optional<Blender>& blender) {
  const std::vector<double> rungs = rungs_until(options.longest_seconds);
  const Reference reference = render_reference(scene, options.reference_seconds);
  keep(reference, options.folder, entry.name);
  fmt::print("\n{}: {}; {}x{}; reference of 2 x {:.0f} samples, relMSE {:.1e}\n", entry.name,
             entry.what, scene.size_px.x, scene.size_px.y, reference.samples,
             reference_relmse(reference));
  std::vector<Variant> measured = variants();
  if (options.variants == VariantChoice::standard) measured.resize(1);
  std::vector<Runs> ours;
  for (const Variant& variant : measured) ours.emplace_back(std::string(variant.name));
  Runs theirs("Cycles");
  const bool has_peer = blender && entry.peers == Peers::comparable;
  for (int seed = 1; seed <= options.seed_count; ++seed) {
    for (size_t i = 0; i < measured.size(); ++i) {
      ours[i].add(render_ladder(scene, measured[i], seed, rungs), reference);
    }
    if (has_peer) {
      theirs.add(render_with_cycles(*blender, scene, seed, options.longest_seconds), reference);
    }
  }
  std::vector<ErrorCurve> curves;
  for (const Runs& runs : ours) curves.push_back(runs.curve(std::string(entry.name)));
  if (has_peer) curves.push_back(theirs.peer_curve(std::string(entry.name), reference));
  for (const ErrorCurve& curve : curves) fmt::print("{}", rung_table(curve));
  if (has_peer) {
    fmt::print("Cycles' materials and lights differ by relMSE {:.1e}, which is taken away\n",
               curves.back().systematic_relmse);
  }
  std::fflush(stdout);
  return curves;
}

}  // namespace

int compare_errors(const Options& options) {
  const std::optional<Blender> blender = find_blender();
  const std::string machine =
      machine_line() + (blender ? "; " + blender->version : "; no Blender to compare with");
  fmt::print("{}\n", machine);
  const int size_divisor = options.effort == Effort::quick ? 8 : 1;
  std::vector<ErrorCurve> curves;
  for (const ErrorSceneEntry* entry : chosen_from(error_scene_entries(), options)) {
    const std::optional<ErrorScene> scene = load_error_scene(*entry, size_divisor);
    if (!scene) {
      fmt::print("{}: SKIPPED, its model is missing\n", entry->name);
      continue;
    }
    for (ErrorCurve& curve : measure(*entry, *scene, options, blender)) {
      curves.push_back(std::move(curve));
    }
  }
  if (curves.empty()) return 1;
  fmt::print("\n{}", time_table(curves));
  write_report(options.folder / "error", curves, error_chart(curves, machine));
  return 0;
}

}  // namespace bench
