// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "tracer/base/directions.h"
#include "tracer/scene/light_tree.h"

namespace tracer {

/// Top down: the group of lights that its centre stands for worst, by power times squared extent,
/// is split in two until there are as many as a node has children.
class LightTreeBuilder {
 public:
  LightTreeBuilder(std::span<const LightBounds> lights, LightTree& tree)
      : lights_(lights), tree_(tree), order_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void build() {
    set_scale();
    tree_.places_.resize(lights_.size());
    build_node(group_of(0, lights_.size()), {}, 0);
  }

 private:
  struct Group {
    size_t begin = 0;  // of order_
    size_t end = 0;
    Box box;
    Box centers;
    double power = 0;

    size_t size() const { return end - begin; }
    double cost() const { return power * squared_diagonal(box); }
  };
  using Split = std::pair<Group, Group>;

  static double squared_diagonal(const Box& box) {
    return box.is_empty() ? 0 : glm::dot(box.extent(), box.extent());
  }

  void set_scale() {
    Box all;
    for (const LightBounds& light : lights_) {
      all.extend(light.box);
      total_power_ += light.power;
    }
    tree_.center_ = 0.5 * (Vec3d(all.min) + Vec3d(all.max));
    const double reach = 0.5 * max_abs(all.extent());
    tree_.scale_ = reach > 0 ? 1 / reach : 1;
  }

  const LightBounds& light(size_t place) const { return lights_[order_[place]]; }

  Group group_of(size_t begin, size_t end) const {
    Group group;
    group.begin = begin;
    group.end = end;
    for (size_t i = begin; i < end; ++i) {
      group.box.extend(light(i).box);
      group.centers.extend(light(i).box.center());
      group.power += light(i).power;
    }
    return group;
  }

  uint32_t build_node(const Group& all, LightTree::Place parent, int depth) {
    const auto index = static_cast<uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back().parent = parent;
    std::vector<Group> children{all};
    while (children.size() < LightTree::width) {
      const auto worst = std::ranges::max_element(
          children, {}, [](const Group& group) { return group.size() > 1 ? group.cost() : -1.0; });
      if (worst->size() < 2) break;
      const auto [left, right] = split(*worst, depth);
      *worst = left;
      children.push_back(right);
    }
    for (uint32_t child = 0; child < children.size(); ++child) {
      set_child(index, child, children[child], depth);
    }
    return index;
  }

  void set_child(uint32_t node, uint32_t child, const Group& group, int depth) {
    set_bounds(tree_.nodes_[node], child, group);
    if (group.size() == 1) {
      const uint32_t only = order_[group.begin];
      tree_.places_[only] = {node, child};
      tree_.nodes_[node].children[child] = only | LightTree::leaf_bit;
      return;
    }
    const uint32_t inner = build_node(group, {node, child}, depth + 1);
    tree_.nodes_[node].children[child] = inner;
  }

  void set_bounds(LightTree::Node& node, uint32_t child, const Group& group) const {
    // What is too faint for a float counts as the faintest: it is to be found, if seldom.
    constexpr float faintest = 0x1p-100f;
    const Vec3f center = group.box.center();
    const Vec3d placed = (Vec3d(center) - tree_.center_) * tree_.scale_;
    // A little larger than the half diagonal, for what the centre was rounded by.
    const double radius = 0.5 * std::sqrt(squared_diagonal(group.box)) * tree_.scale_;
    const auto grown = static_cast<float>(radius * (1 + 0x1p-20));
    const Vec3d axis = axis_of(group);
    double cos_spread = 1;
    for (size_t i = group.begin; i < group.end; ++i) {
      cos_spread = std::min(cos_spread, std::abs(glm::dot(axis, light(i).normal)));
    }
    node.x[child] = static_cast<float>(placed.x);
    node.y[child] = static_cast<float>(placed.y);
    node.z[child] = static_cast<float>(placed.z);
    node.radius[child] = grown;
    node.axis_x[child] = static_cast<float>(axis.x);
    node.axis_y[child] = static_cast<float>(axis.y);
    node.axis_z[child] = static_cast<float>(axis.z);
    node.cos_spread[child] = static_cast<float>(cos_spread);
    node.sin_spread[child] = static_cast<float>(std::sqrt(1 - cos_spread * cos_spread));
    node.power[child] = std::max(static_cast<float>(group.power / total_power_), faintest);
  }

  /// The mean of the normals by power, all turned to the first's side.
  Vec3d axis_of(const Group& group) const {
    const Vec3d first = light(group.begin).normal;
    Vec3d sum(0);
    for (size_t i = group.begin; i < group.end; ++i) {
      const LightBounds& one = light(i);
      sum += (glm::dot(one.normal, first) < 0 ? -one.power : one.power) * one.normal;
    }
    return unit_or(sum, first);
  }

  Split split(const Group& group, int depth) {
    constexpr int deepest = 24;  // beyond, what no bins can part is halved
    const size_t middle = depth < deepest ? split_by_cost(group) : group.begin;
    const bool is_parted = middle > group.begin && middle < group.end;
    const size_t place = is_parted ? middle : split_in_halves(group);
    return {group_of(group.begin, place), group_of(place, group.end)};
  }

  size_t split_in_halves(const Group& group) {
    const int axis = group.centers.longest_axis();
    const size_t middle = group.begin + group.size() / 2;
    std::nth_element(order_.begin() + group.begin, order_.begin() + middle,
                     order_.begin() + group.end, [&](uint32_t a, uint32_t b) {
                       return std::pair(lights_[a].box.center()[axis], a) <
                              std::pair(lights_[b].box.center()[axis], b);
                     });
    return middle;
  }

  static constexpr int bin_count = 16;
  struct Bin {
    Box box;
    double power = 0;
    void add(const Box& other, double more) {
      box.extend(other);
      power += more;
    }
    double cost() const { return power * squared_diagonal(box); }
  };

  /// Bins along the axis on which the centres are spread.
  static int bin_of(const Group& group, int axis, const LightBounds& light) {
    const double low = group.centers.min[axis];
    const double extent = group.centers.max[axis] - low;
    const double part = (light.box.center()[axis] - low) / extent;
    return std::min(static_cast<int>(part * bin_count), bin_count - 1);
  }

  /// Parts order_ where the sum of both sides' costs is least; group.begin where nothing parts
  /// them.
  size_t split_by_cost(const Group& group) {
    double least = std::numeric_limits<double>::infinity();
    int best_axis = 0;
    int best_bin = -1;  // the first on the right
    for (int axis = 0; axis < 3; ++axis) {
      if (!(group.centers.extent()[axis] > 0)) continue;
      std::array<Bin, bin_count> bins;
      for (size_t i = group.begin; i < group.end; ++i) {
        bins[bin_of(group, axis, light(i))].add(light(i).box, light(i).power);
      }
      std::array<double, bin_count> right_costs{};
      Bin right;
      for (int bin = bin_count - 1; bin > 0; --bin) {
        right.add(bins[bin].box, bins[bin].power);
        right_costs[bin] = right.cost();
      }
      Bin left;
      for (int bin = 1; bin < bin_count; ++bin) {
        left.add(bins[bin - 1].box, bins[bin - 1].power);
        const double cost = left.cost() + right_costs[bin];
        if (!(cost < least)) continue;
        least = cost;
        best_axis = axis;
        best_bin = bin;
      }
    }
    if (best_bin < 0) return group.begin;
    const auto right_begin = std::partition(
        order_.begin() + group.begin, order_.begin() + group.end,
        [&](uint32_t index) { return bin_of(group, best_axis, lights_[index]) < best_bin; });
    return static_cast<size_t>(right_begin - order_.begin());
  }

  std::span<const LightBounds> lights_;
  LightTree& tree_;
  std::vector<uint32_t> order_;
  double total_power_ = 0;
};

LightTree::LightTree(std::span<const LightBounds> lights) {
  if (!lights.empty()) LightTreeBuilder(lights, *this).build();
}

}  // namespace tracer
