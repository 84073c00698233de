// SPDX-License-Identifier: MIT
#include "tracer/bvh/layout/wide_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

namespace tracer {

FloatRows::FloatRows(size_t row_count, int width) : row_count_(row_count), width_(width) {
  constexpr size_t alignment = 64;
  const size_t rounded = (bytes() + alignment - 1) / alignment * alignment;
  data_.reset(static_cast<float*>(std::aligned_alloc(alignment, std::max(rounded, alignment))));
  if (!data_) throw std::bad_alloc();
}

namespace {

/// Follows the binary tree twice: first to count nodes and blocks, then to fill them.
class Collapse {
 public:
  Collapse(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress)
      : tree_(tree), mesh_(mesh), progress_(progress) {
    wide_.width = width;
  }

  WideTree run() {
    count_primitives();
    ++node_count_;
    for (const uint32_t child : children_of(0)) count(child);
    wide_.nodes = FloatRows(node_count_ * WideTree::rows_a_node, wide_.width);
    wide_.blocks = FloatRows(block_count_ * WideTree::rows_a_block, wide_.width);
    wide_.block_infos.resize(block_count_);
    progress_.start_stage("laying out the tree");
    node_count_ = block_count_ = 0;
    const Box& bounds = tree_.nodes[0].bounds;
    for (int axis = 0; axis < 3; ++axis) {
      wide_.max_coordinate =
          std::max({wide_.max_coordinate, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
    }
    fill_node(0);
    return std::move(wide_);
  }

 private:
  struct Range {
    uint32_t first = 0;
    uint32_t count = 0;
  };

  struct Children {
    std::array<uint32_t, 16> nodes;
    size_t count;

    const uint32_t* begin() const { return nodes.data(); }
    const uint32_t* end() const { return nodes.data() + count; }
  };

  // Primitives below each node; they are contiguous in tree.primitives.
  void count_primitives() {
    ranges_.resize(tree_.nodes.size());
    for (size_t i = tree_.nodes.size(); i-- > 0;) {
      const BvhNode& node = tree_.nodes[i];
      if (node.is_leaf()) {
        ranges_[i] = {node.first, node.count};
      } else {
        const Range& left = ranges_[node.first];
        const Range& right = ranges_[node.first + 1];
        ranges_[i] = {std::min(left.first, right.first), left.count + right.count};
      }
    }
  }

  bool becomes_leaf(uint32_t node) const {
    return tree_.nodes[node].is_leaf() || ranges_[node].count <= static_cast<uint32_t>(wide_.width);
  }

  size_t block_count_of(uint32_t node) const {
    return (ranges_[node].count + static_cast<size_t>(wide_.width) - 1) / wide_.width;
  }

  Children children_of(uint32_t node) const {
    // A root that is a leaf becomes the one child of a node.
    if (becomes_leaf(node)) return {{node}, 1};
    Children children{{tree_.nodes[node].first, tree_.nodes[node].first + 1}, 2};
    while (children.count < static_cast<size_t>(wide_.width)) {
      double largest_area = -1;
      size_t largest = 0;
      for (size_t i = 0; i < children.count; ++i) {
        if (becomes_leaf(children.nodes[i])) continue;
        const double area = tree_.nodes[children.nodes[i]].bounds.half_area();
        if (area > largest_area) largest_area = area, largest = i;
      }
      if (largest_area < 0) break;
      const uint32_t opened = children.nodes[largest];
      children.nodes[largest] = tree_.nodes[opened].first;
      children.nodes[children.count++] = tree_.nodes[opened].first + 1;
    }
    return children;
  }

  void count(uint32_t node) {
    if (becomes_leaf(node)) {
      block_count_ += block_count_of(node);
      return;
    }
    ++node_count_;
    for (const uint32_t child : children_of(node)) count(child);
  }

  WideChild fill(uint32_t node) { return becomes_leaf(node) ? fill_leaf(node) : fill_node(node); }

  /// The root is always a node, so that every leaf is met through the slabs of its box.
  WideChild fill_node(uint32_t node) {
    const size_t index = node_count_++;
    const Children children = children_of(node);
    for (size_t lane = 0; lane < static_cast<size_t>(wide_.width); ++lane) {
      const bool is_used = lane < children.count;
      const Box box = is_used ? tree_.nodes[children.nodes[lane]].bounds : Box{};
      for (int axis = 0; axis < 3; ++axis) {
        const size_t row = index * WideTree::rows_a_node + 2 * static_cast<size_t>(axis);
        wide_.nodes.row(row)[lane] = box.min[axis];
        wide_.nodes.row(row + 1)[lane] = box.max[axis];
      }
      const WideChild child = is_used ? fill(children.nodes[lane]) : WideChild::node(0);
      wide_.nodes.row(index * WideTree::rows_a_node + 6)[lane] = std::bit_cast<float>(child.bits);
    }
    return WideChild::node(static_cast<uint32_t>(index));
  }

  WideChild fill_leaf(uint32_t node) {
    const size_t first_block = block_count_;
    const size_t blocks = block_count_of(node);
    block_count_ += blocks;
    Box reach = tree_.nodes[node].bounds;
    for (uint32_t i = 0; i < ranges_[node].count; ++i) {
      reach.extend(mesh_.triangle_bounds(tree_.primitives[ranges_[node].first + i]));
    }
    const Vec3d size = reach.extent();
    const float extent = std::nextafter(static_cast<float>(std::max({size.x, size.y, size.z})),
                                        std::numeric_limits<float>::infinity());
    const auto width = static_cast<size_t>(wide_.width);
    for (size_t block = 0; block < blocks; ++block) {
      if ((first_block + block) % 1024 == 0) report(first_block + block);
      const size_t count = std::min(width, ranges_[node].count - block * width);
      wide_.block_infos[first_block + block] = {extent, static_cast<uint16_t>(count),
                                                static_cast<uint16_t>(block + 1 == blocks)};
      for (size_t lane = 0; lane < width; ++lane) {
        const size_t offset = block * width + std::min(lane, count - 1);
        fill_lane(first_block + block, lane, tree_.primitives[ranges_[node].first + offset]);
      }
    }
    return WideChild::leaf(static_cast<uint32_t>(first_block));
  }

  void report(size_t block) const {
    progress_.throw_if_stopped();
    progress_.set_fraction(static_cast<double>(block) / wide_.block_infos.size());
  }

  void fill_lane(size_t block, size_t lane, uint32_t primitive) {
    const size_t row = block * WideTree::rows_a_block;
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f& position = mesh_.positions[mesh_.triangles[primitive][corner]];
      for (int axis = 0; axis < 3; ++axis) {
        wide_.blocks.row(row + static_cast<size_t>(3 * corner + axis))[lane] = position[axis];
      }
    }
    wide_.blocks.row(row + 9)[lane] = std::bit_cast<float>(primitive);
  }

  const BvhTree& tree_;
  const Mesh& mesh_;
  Progress& progress_;
  WideTree wide_;
  std::vector<Range> ranges_;
  size_t node_count_ = 0;
  size_t block_count_ = 0;
};

}  // namespace

WideTree build_wide_tree(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress) {
  return Collapse(tree, mesh, width, progress).run();
}

}  // namespace tracer
