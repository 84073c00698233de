// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tracer/base/parallel.h"
#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/quality.h"
#include "tracer/bvh/uniform_lines.h"

namespace tracer {
namespace {

// The standard error of the result is about 1 %, and 3 % with the fewest rays: as many are tried as
// keep within so many nodes tested.
constexpr uint32_t greatest_ray_count = 16384;
constexpr uint32_t least_ray_count = 1024;
constexpr uint64_t test_budget = 8'000'000;
constexpr size_t rays_a_task = 64;

struct Counts {
  uint64_t leaves = 0;  // met
  uint64_t tests = 0;   // of nodes' boxes
};

Counts count_leaves(const BvhTree& tree, const Ray& ray) {
  const RaySlabs slabs(ray);
  Counts counts;
  std::array<uint32_t, max_tree_depth + 1> stack;
  size_t stack_size = 0;
  const auto push_if_met = [&](uint32_t node) {
    ++counts.tests;
    const auto [entry, exit] = tree.nodes[node].bounds.intersect(slabs);
    if (entry <= exit) stack[stack_size++] = node;
  };
  push_if_met(0);
  while (stack_size > 0) {
    const BvhNode& node = tree.nodes[stack[--stack_size]];
    if (node.is_leaf()) {
      ++counts.leaves;
    } else {
      push_if_met(node.first);
      push_if_met(node.first + 1);
    }
  }
  return counts;
}

// Adds those of more rays, up to `ray_count`.
void count_leaves(const BvhTree& tree, const Progress& progress, uint32_t ray_count,
                  std::vector<Counts>& counts) {
  const size_t first = counts.size();
  counts.resize(ray_count);
  parallel_for_ranges(first, ray_count, rays_a_task, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      progress.throw_if_stopped();
      counts[i] = count_leaves(tree, uniform_line(tree.nodes[0].bounds, static_cast<uint32_t>(i)));
    }
  });
}

double standard_deviation_of_leaves(const std::vector<Counts>& counts) {
  const auto count = static_cast<double>(counts.size());
  double mean = 0;
  for (const Counts& ray : counts) mean += static_cast<double>(ray.leaves) / count;
  double variance = 0;
  for (const Counts& ray : counts) {
    const double deviation = static_cast<double>(ray.leaves) - mean;
    variance += deviation * deviation / count;
  }
  return std::sqrt(variance);
}

}  // namespace

Lcv measure_lcv(const BvhTree& tree, const Progress& progress) {
  if (tree.nodes.empty() || !(tree.nodes[0].bounds.half_area() > 0)) return {};
  std::vector<Counts> counts;
  count_leaves(tree, progress, least_ray_count, counts);
  uint64_t tests = 0;
  for (const Counts& ray : counts) tests += ray.tests;
  const auto affordable = static_cast<uint32_t>(
      std::min<uint64_t>(test_budget * least_ray_count / tests, greatest_ray_count));
  if (affordable > least_ray_count) count_leaves(tree, progress, affordable, counts);
  return {standard_deviation_of_leaves(counts), static_cast<uint32_t>(counts.size())};
}

TreeQuality measure_quality(const BvhTree& tree, const Mesh& mesh, const SahCosts& costs,
                            const Progress& progress) {
  return {measure_epo(tree, mesh, costs, progress), measure_lcv(tree, progress)};
}

}  // namespace tracer
