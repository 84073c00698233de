// SPDX-License-Identifier: MIT
#include <algorithm>
#include <span>
#include <vector>

#include "tracer/base/parallel.h"
#include "tracer/base/random.h"
#include "tracer/bvh/quality.h"
#include "tracer/geometry/clip_polygon.h"

namespace tracer {
namespace {

constexpr uint32_t seed = 0x65706f00;
constexpr size_t triangles_a_task = 16;
constexpr uint32_t visits_a_look = 1024;
// As many triangles are taken as keep within so many nodes visited, and all where that takes twice
// as many; a few first tell how many.
constexpr double visit_budget = 3e6;
constexpr double exact_budget = 6e6;
constexpr uint32_t first_sample_count = 256;
constexpr uint32_t greatest_sample_count = 1 << 16;

Polygon triangle_polygon(const Mesh& mesh, uint32_t triangle) {
  const Vec3u& index = mesh.triangles[triangle];
  return make_triangle(mesh.positions[index.x], mesh.positions[index.y], mesh.positions[index.z]);
}

bool is_apart(const Polygon& polygon, const Box& box) {
  return glm::any(glm::greaterThan(polygon.min, Vec3d(box.max))) ||
         glm::any(glm::lessThan(polygon.max, Vec3d(box.min)));
}

bool is_within(const Polygon& polygon, const Box& box) {
  return glm::all(glm::greaterThanEqual(polygon.min, Vec3d(box.min))) &&
         glm::all(glm::lessThanEqual(polygon.max, Vec3d(box.max)));
}

/// The nodes that one triangle reaches into without being in any leaf of theirs.
class Overlap {
 public:
  Overlap(const BvhTree& tree, const SahCosts& costs, const Progress& progress, uint32_t triangle)
      : tree_(tree), costs_(costs), progress_(progress), triangle_(triangle) {}

  /// Whether the triangle is in a leaf below `node`. `part` is what of it lies in the parent.
  bool visit(uint32_t node, const Polygon& part, double part_area) {
    if (++visit_count_ % visits_a_look == 0) progress_.throw_if_stopped();
    const Box& box = tree_.nodes[node].bounds;
    if (is_apart(part, box)) return false;
    if (is_within(part, box)) return visit_inside(node, part, part_area);
    const Polygon clipped = clip(part, box);
    return clipped.count > 0 && visit_inside(node, clipped, area(clipped));
  }

  /// Area times cost, of all such nodes.
  double weighted_area() const { return weighted_area_; }
  uint64_t visit_count() const { return visit_count_; }

 private:
  bool visit_inside(uint32_t node_index, const Polygon& part, double part_area) {
    const BvhNode& node = tree_.nodes[node_index];
    bool is_held = false;
    if (node.is_leaf()) {
      const auto leaf = std::span(tree_.primitives).subspan(node.first, node.count);
      is_held = std::ranges::find(leaf, triangle_) != leaf.end();
    } else {
      is_held = visit(node.first, part, part_area);
      is_held |= visit(node.first + 1, part, part_area);
    }
    if (!is_held) weighted_area_ += costs_.of(node) * part_area;
    return is_held;
  }

  const BvhTree& tree_;
  const SahCosts& costs_;
  const Progress& progress_;
  const uint32_t triangle_;
  double weighted_area_ = 0;
  uint64_t visit_count_ = 0;
};

struct Pick {
  uint32_t triangle;
  double weight;  // all of them add up to 1
};

struct Sum {
  double value = 0;
  double visits = 0;
};

class EpoMeasurement {
 public:
  EpoMeasurement(const BvhTree& tree, const Mesh& mesh, const SahCosts& costs,
                 const Progress& progress)
      : tree_(tree),
        mesh_(mesh),
        costs_(costs),
        progress_(progress),
        areas_(mesh.triangle_count()) {
    parallel_for_ranges(0, areas_.size(), 4096, [&](size_t begin, size_t end) {
      progress_.throw_if_stopped();
      for (size_t i = begin; i < end; ++i) {
        areas_[i] = area(triangle_polygon(mesh_, static_cast<uint32_t>(i)));
      }
    });
    sums_.reserve(areas_.size());
    for (const double area : areas_) sums_.push_back(total_area() + area);
  }

  Epo run() const {
    if (!(total_area() > 0)) return {};
    const std::vector<Pick> first_picks = sample(first_sample_count);
    const Sum first = evaluate(first_picks);
    const double visits_a_triangle = first.visits / static_cast<double>(first_picks.size());
    if (visits_a_triangle * static_cast<double>(areas_.size()) <= exact_budget) {
      return {evaluate(all()).value, 0};
    }
    const double affordable = visit_budget / first.visits * first_sample_count;
    if (affordable <= first_sample_count) return {first.value, first_sample_count};
    const auto count = static_cast<uint32_t>(std::min<double>(affordable, greatest_sample_count));
    return {evaluate(sample(count)).value, count};
  }

 private:
  double total_area() const { return sums_.empty() ? 0 : sums_.back(); }

  std::vector<Pick> all() const {
    std::vector<Pick> picks;
    for (uint32_t i = 0; i < areas_.size(); ++i) {
      if (areas_[i] > 0) picks.push_back({i, areas_[i] / total_area()});
    }
    return picks;
  }

  // A random point in each of `count` equal parts of the surface: where its triangle lies.
  std::vector<Pick> sample(uint32_t count) const {
    std::vector<Pick> picks;
    for (uint32_t i = 0; i < count; ++i) {
      const double part = (i + to_unit_float(hash_words({i, count, seed, 0}).x)) / count;
      const auto found = std::ranges::upper_bound(sums_, part * total_area());
      const auto triangle = static_cast<uint32_t>(found - sums_.begin());
      if (picks.empty() || picks.back().triangle != triangle) picks.push_back({triangle, 0});
      picks.back().weight += 1.0 / count;
    }
    return picks;
  }

  Sum evaluate(const std::vector<Pick>& picks) const {
    std::vector<Sum> parts(picks.size());
    parallel_for_ranges(0, picks.size(), triangles_a_task, [&](size_t begin, size_t end) {
      progress_.throw_if_stopped();
      for (size_t i = begin; i < end; ++i) parts[i] = evaluate(picks[i]);
    });
    Sum sum;
    for (const Sum& part : parts) {
      sum.value += part.value;
      sum.visits += part.visits;
    }
    return sum;
  }

  Sum evaluate(const Pick& pick) const {
    Overlap overlap(tree_, costs_, progress_, pick.triangle);
    const double whole = areas_[pick.triangle];
    overlap.visit(0, triangle_polygon(mesh_, pick.triangle), whole);
    return {pick.weight * (overlap.weighted_area() / whole),
            static_cast<double>(overlap.visit_count())};
  }

  const BvhTree& tree_;
  const Mesh& mesh_;
  const SahCosts& costs_;
  const Progress& progress_;
  std::vector<double> areas_;  // of the triangles
  std::vector<double> sums_;   // of areas_, up to and including each
};

}  // namespace

Epo measure_epo(const BvhTree& tree, const Mesh& mesh, const SahCosts& costs,
                const Progress& progress) {
  if (tree.nodes.empty()) return {};
  return EpoMeasurement(tree, mesh, costs, progress).run();
}

}  // namespace tracer
