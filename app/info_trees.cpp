// SPDX-License-Identifier: MIT
#include "app/info_trees.h"

#include <algorithm>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "app/build_accel.h"
#include "app/ray_speed.h"
#include "app/stopwatch.h"
#include "app/tree_report.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json describe_tree(const std::shared_ptr<const tracer::Mesh>& mesh, const TreeKey& key) {
  tracer::Progress progress;
  const Stopwatch start;
  const BuiltAccel built = build_accel(mesh, key, progress);
  Json tree = {{"builder", key.builder->name}, {"build_seconds", start.seconds()}};
  const tracer::TreeMetrics metrics = measure(*built.tree, sah_costs(key.settings));
  add_tree(tree, metrics, measure_quality(*built.tree, *mesh, metrics.costs, progress),
           built.accel->bytes());
  tree["mrays_per_second"] = measure_mrays_per_second(*built.accel);
  return tree;
}

std::string count(const Json& value) {
  return value.dump();
}

std::string three_digits(const Json& value) {
  return fmt::format("{:#.3g}", value.get<double>());
}

std::string milliseconds(const Json& seconds) {
  return fmt::format("{:.1f} ms", 1e3 * seconds.get<double>());
}

std::string megabytes(const Json& bytes) {
  return fmt::format("{:.2f} MB", 1e-6 * bytes.get<double>());
}

struct Row {
  const char* label;
  const char* key;
  std::string (*format)(const Json& value);
  std::string note = {};
};

// The costs that SAH and EPO charge.
std::string cost_note(const Json& tree) {
  return fmt::format("{} a node, {} a triangle", tree["sah_traversal_cost"].get<double>(),
                     tree["sah_intersection_cost"].get<double>());
}

// What the same number of another program may have been made of.
std::string epo_note(const Json& trees) {
  const auto samples = [](const Json& tree) {
    return tree["epo_sampled_triangles"].get<uint32_t>();
  };
  uint32_t least = 0;
  for (const Json& tree : trees) {
    if (samples(tree) > 0) least = least > 0 ? std::min(least, samples(tree)) : samples(tree);
  }
  return cost_note(trees.front()) +
         (least > 0 ? fmt::format(", from {} triangles and more", least) : ", of all triangles");
}

std::vector<Row> rows_for(const Json& trees) {
  const Json& first = trees.front();
  return {{"build", "build_seconds", milliseconds},
          {"nodes", "nodes", count},
          {"leaves", "leaves", count},
          {"references", "references", count, "triangles of all leaves"},
          {"depth", "depth", count},
          {"largest leaf", "largest_leaf", count, "triangles"},
          {"tree", "tree_bytes", megabytes, "that rays are traced through"},
          {"SAH cost", "sah_cost", three_digits, cost_note(first)},
          {"EPO", "epo", three_digits, epo_note(trees)},
          {"LCV", "lcv", three_digits, fmt::format("from {} rays", count(first["lcv_rays"]))},
          {"Mray/s", "mrays_per_second", three_digits, "measured here"}};
}

}  // namespace

Json describe_trees(const std::shared_ptr<const tracer::Mesh>& mesh,
                    const std::vector<const tracer::Builder*>& builders,
                    const tracer::BuildSettings& settings) {
  Json trees = Json::array();
  for (const tracer::Builder* builder : builders) {
    trees.push_back(describe_tree(mesh, {.builder = builder, .settings = settings}));
  }
  return trees;
}

void print_trees(const Json& trees) {
  if (trees.empty()) return;
  constexpr size_t least_width = 12;
  const auto print_cell = [&](const Json& tree, const std::string& text) {
    const size_t width =
        std::max(least_width, tree["builder"].get_ref<const std::string&>().size());
    fmt::print("  {:>{}}", text, width);
  };
  fmt::print("  {:<14}", "BVH");
  for (const Json& tree : trees) print_cell(tree, tree["builder"].get<std::string>());
  fmt::print("\n");
  for (const Row& row : rows_for(trees)) {
    fmt::print("    {:<12}", row.label);
    for (const Json& tree : trees) print_cell(tree, row.format(tree[row.key]));
    fmt::print("{}{}\n", row.note.empty() ? "" : "  ", row.note);
  }
}

}  // namespace app
