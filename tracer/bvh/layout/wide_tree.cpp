// SPDX-License-Identifier: MIT
#include "tracer/bvh/layout/wide_tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "tracer/base/huge_pages.h"
#include "tracer/base/parallel.h"

namespace tracer {

FloatRows::FloatRows(size_t row_count, int width) : row_count_(row_count), width_(width) {
  // Large trees in large pages: fewer to fault in and to look up.
  constexpr size_t large_page = size_t{1} << 21;
  const size_t alignment = bytes() >= 2 * large_page ? large_page : 64;
  const size_t rounded = std::max((bytes() + alignment - 1) / alignment * alignment, alignment);
  data_.reset(static_cast<float*>(std::aligned_alloc(alignment, rounded)));
  if (!data_) throw std::bad_alloc();
  prefer_huge_pages(data_.get(), rounded);
}

namespace {

// Relative times of a node's boxes and of a block's triangles, measured.
constexpr float node_cost = 1.0f;
constexpr float block_cost = 1.0f;

// Subtrees above this size are worked on in parallel.
constexpr uint32_t task_size = 16384;

constexpr size_t max_width = 16;
constexpr size_t core_cache_bytes = size_t{1} << 21;

/// Which nodes of the binary tree become nodes of the wide one: those for which the surface area
/// cost of the whole is least. [Wald 2008] A dynamic program over forests: costs[k] is the least
/// cost of a subtree as at most k + 1 children of a wide node.
class Collapse {
 public:
  Collapse(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress)
      : tree_(tree),
        mesh_(mesh),
        progress_(progress),
        width_(static_cast<uint32_t>(width)),
        counts_(tree.nodes.size()),
        costs_(std::make_unique_for_overwrite<Costs[]>(tree.nodes.size())),
        totals_(std::make_unique_for_overwrite<Totals[]>(tree.nodes.size())) {
    wide_.width = width;
  }

  WideTree run() {
    progress_.start_stage("laying out the tree");
    count_primitives();
    if (!is_block(0)) find_costs(0);
    wide_.expected_steps = area(0) > 0 ? cost(0, 1) / area(0) : 0;
    const Totals totals = plan_node(0);
    wide_.nodes = FloatRows(totals.nodes * WideTree::rows_a_node, wide_.width);
    wide_.blocks = FloatRows(totals.blocks * WideTree::rows_a_block, wide_.width);
    wide_.block_infos.resize(totals.blocks);
    wide_.is_larger_than_cache = wide_.bytes() > core_cache_bytes;
    const Box& bounds = tree_.nodes[0].bounds;
    for (int axis = 0; axis < 3; ++axis) {
      wide_.max_coordinate =
          std::max({wide_.max_coordinate, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
    }
    fill_node(0, {0, 0});
    wide_.typical_extent = median_extent();
    return std::move(wide_);
  }

 private:
  using Costs = std::array<float, max_width>;

  /// Of a wide subtree; or where it begins.
  struct Totals {
    size_t nodes = 0;
    size_t blocks = 0;
  };

  struct Children {
    std::array<uint32_t, max_width> nodes;
    size_t count = 0;

    const uint32_t* begin() const { return nodes.data(); }
    const uint32_t* end() const { return nodes.data() + count; }
  };

  float median_extent() const {
    std::vector<float> extents(wide_.block_infos.size());
    std::ranges::transform(wide_.block_infos, extents.begin(), &WideTree::BlockInfo::extent);
    const auto middle = extents.begin() + static_cast<ptrdiff_t>(extents.size() / 2);
    std::ranges::nth_element(extents, middle);
    return *middle;
  }

  void count_primitives() {
    for (size_t i = tree_.nodes.size(); i-- > 0;) {
      const BvhNode& node = tree_.nodes[i];
      counts_[i] = node.is_leaf() ? node.count : counts_[node.first] + counts_[node.first + 1];
    }
  }

  // What fits into one block becomes one: a split of it gains nothing and costs memory.
  bool is_block(uint32_t node) const {
    return tree_.nodes[node].is_leaf() || counts_[node] <= width_;
  }

  float area(uint32_t node) const {
    return static_cast<float>(tree_.nodes[node].bounds.half_area());
  }
  size_t block_count(uint32_t node) const { return (counts_[node] + width_ - 1) / width_; }
  float block_costs(uint32_t node) const {
    return area(node) * block_cost * static_cast<float>(block_count(node));
  }

  float cost(uint32_t node, size_t child_count) const {
    return is_block(node) ? block_costs(node) : costs_[node][child_count - 1];
  }

  // f() and g(), in parallel for large subtrees.
  template <class F, class G>
  void both(uint32_t node, F&& f, G&& g) const {
    if (counts_[node] <= task_size) {
      f();
      g();
    } else {
      progress_.throw_if_stopped();
      parallel_invoke(f, g);
      progress_.throw_if_stopped();
    }
  }

  void find_costs(uint32_t node) {
    const uint32_t left = tree_.nodes[node].first;
    const uint32_t right = left + 1;
    both(
        node,
        [&] {
          if (!is_block(left)) find_costs(left);
        },
        [&] {
          if (!is_block(right)) find_costs(right);
        });
    Costs left_costs, right_costs;
    for (size_t k = 0; k < max_width; ++k) {
      left_costs[k] = cost(left, k + 1);
      right_costs[k] = cost(right, k + 1);
    }
    // Loops of one length, for the compiler's SIMD; sums of more children than there may be are
    // lost.
    std::array<float, 2 * max_width> sums;
    sums.fill(std::numeric_limits<float>::infinity());
    for (size_t k = 0; k + 1 < max_width; ++k) {
      for (size_t other = 0; other < max_width; ++other) {
        sums[k + other + 1] = std::min(sums[k + other + 1], left_costs[k] + right_costs[other]);
      }
    }
    Costs& costs = costs_[node];
    std::copy_n(sums.begin(), max_width, costs.begin());
    costs[0] = area(node) * node_cost + costs[width_ - 1];
    for (size_t k = 1; k < width_; ++k) costs[k] = std::min(costs[k], costs[k - 1]);
  }

  // The subtree as at most `child_count` children.
  void add_children(uint32_t node, size_t child_count, Children& children) const {
    if (child_count == 1 || is_block(node) || costs_[node][child_count - 1] == costs_[node][0]) {
      children.nodes[children.count++] = node;
    } else {
      split_children(node, child_count, children);
    }
  }

  void split_children(uint32_t node, size_t child_count, Children& children) const {
    const uint32_t left = tree_.nodes[node].first;
    size_t best = 1;
    float least = std::numeric_limits<float>::infinity();
    for (size_t k = 1; k < child_count; ++k) {
      const float sum = cost(left, k) + cost(left + 1, child_count - k);
      if (sum < least) least = sum, best = k;
    }
    add_children(left, best, children);
    add_children(left + 1, child_count - best, children);
  }

  Children children_of(uint32_t node) const {
    // A root that is a leaf becomes the one child of a node.
    if (is_block(node)) return {{node}, 1};
    Children children;
    split_children(node, width_, children);
    return children;
  }

  // The root is always a node, so that every leaf is met through the slabs of its box.
  Totals plan_node(uint32_t node) {
    progress_.throw_if_stopped();
    const Children children = children_of(node);
    const auto plan_child = [&](size_t i) {
      const uint32_t child = children.nodes[i];
      totals_[child] = is_block(child) ? Totals{0, block_count(child)} : plan_node(child);
    };
    for_each_child(node, children, plan_child);
    Totals totals{1, 0};
    for (const uint32_t child : children) {
      totals.nodes += totals_[child].nodes;
      totals.blocks += totals_[child].blocks;
    }
    return totals;
  }

  template <class F>
  void for_each_child(uint32_t node, const Children& children, F&& f) const {
    if (counts_[node] > task_size) {
      parallel_for_each_index(0, children.count, f);
    } else {
      for (size_t i = 0; i < children.count; ++i) f(i);
    }
    progress_.throw_if_stopped();
  }

  // Writes the node at place.nodes; what is below it follows, and its blocks are at place.blocks.
  void fill_node(uint32_t node, Totals place) {
    const Children children = children_of(node);
    std::array<Totals, max_width> places;
    Totals next{place.nodes + 1, place.blocks};
    float* const rows = wide_.nodes.row(place.nodes * WideTree::rows_a_node);
    for (size_t lane = 0; lane < width_; ++lane) {
      const bool is_used = lane < children.count;
      const uint32_t child = is_used ? children.nodes[lane] : 0;
      const Box box = is_used ? tree_.nodes[child].bounds : Box{};
      for (size_t axis = 0; axis < 3; ++axis) {
        rows[2 * axis * width_ + lane] = box.min[static_cast<int>(axis)];
        rows[(2 * axis + 1) * width_ + lane] = box.max[static_cast<int>(axis)];
      }
      WideChild link = WideChild::node(0);
      if (is_used) {
        link = is_block(child) ? WideChild::leaf(static_cast<uint32_t>(next.blocks))
                               : WideChild::node(static_cast<uint32_t>(next.nodes));
        places[lane] = next;
        next.nodes += totals_[child].nodes;
        next.blocks += totals_[child].blocks;
      }
      rows[6 * width_ + lane] = std::bit_cast<float>(link.bits);
    }
    for_each_child(node, children, [&](size_t i) {
      const uint32_t child = children.nodes[i];
      if (is_block(child)) {
        fill_leaf(child, places[i].blocks);
      } else {
        fill_node(child, places[i]);
      }
    });
    report(children, node);
  }

  void fill_leaf(uint32_t node, size_t block) {
    LeafWriter writer{*this, block, 0};
    Box box = tree_.nodes[node].bounds;
    writer.add_subtree(node, box);
    const size_t end = writer.finish();
    // Of all vertices and the leaf's box: spatial splits leave vertices outside it.
    const Vec3d size = box.extent();
    const float extent = std::nextafter(static_cast<float>(std::max({size.x, size.y, size.z})),
                                        std::numeric_limits<float>::infinity());
    for (size_t i = block; i < end; ++i) wide_.block_infos[i].extent = extent;
  }

  /// Puts a leaf's triangles into its blocks, one after the other.
  struct LeafWriter {
    Collapse& collapse;
    size_t block;
    size_t lane;

    void add_subtree(uint32_t index, Box& box) {
      const BvhNode& node = collapse.tree_.nodes[index];
      if (!node.is_leaf()) {
        add_subtree(node.first, box);
        add_subtree(node.first + 1, box);
        return;
      }
      for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        add(collapse.tree_.primitives[i], box);
      }
    }

    void add(uint32_t primitive, Box& box) {
      const size_t width = collapse.width_;
      if (lane == width) {
        collapse.wide_.block_infos[block] = {0, static_cast<uint16_t>(width), 0};
        ++block;
        lane = 0;
      }
      float* const rows = collapse.wide_.blocks.row(block * WideTree::rows_a_block) + lane++;
      const Vec3u& triangle = collapse.mesh_.triangles[primitive];
      for (size_t corner = 0; corner < 3; ++corner) {
        const Vec3f& position = collapse.mesh_.positions[triangle[static_cast<int>(corner)]];
        box.extend(position);
        for (size_t axis = 0; axis < 3; ++axis) {
          rows[(3 * corner + axis) * width] = position[static_cast<int>(axis)];
        }
      }
      rows[9 * width] = std::bit_cast<float>(primitive);
    }

    // Unused lanes repeat the last triangle. Returns the block behind the last.
    size_t finish() {
      const size_t width = collapse.width_;
      collapse.wide_.block_infos[block] = {0, static_cast<uint16_t>(lane), 1};
      float* const rows = collapse.wide_.blocks.row(block * WideTree::rows_a_block);
      for (size_t row = 0; row < WideTree::rows_a_block; ++row) {
        std::fill(rows + row * width + lane, rows + (row + 1) * width,
                  rows[row * width + lane - 1]);
      }
      return block + 1;
    }
  };

  void report(const Children& children, uint32_t node) {
    uint32_t placed = 0;
    for (const uint32_t child : children) placed += is_block(child) ? counts_[child] : 0;
    const uint32_t all = placed_.fetch_add(placed, std::memory_order_relaxed) + placed;
    if (node == 0 || counts_[node] > 1024) {
      progress_.set_fraction(static_cast<double>(all) / counts_[0]);
    }
  }

  const BvhTree& tree_;
  const Mesh& mesh_;
  Progress& progress_;
  const uint32_t width_;
  std::vector<uint32_t> counts_;      // primitives below each node
  std::unique_ptr<Costs[]> costs_;    // of nodes that are no blocks
  std::unique_ptr<Totals[]> totals_;  // of nodes that became wide nodes or leaves
  std::atomic<uint32_t> placed_{0};
  WideTree wide_;
};

}  // namespace

WideTree build_wide_tree(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress) {
  return Collapse(tree, mesh, width, progress).run();
}

}  // namespace tracer
