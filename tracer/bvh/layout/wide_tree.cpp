// SPDX-License-Identifier: MIT
#include "tracer/bvh/layout/wide_tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "tracer/base/huge_pages.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/layout/collapse.h"
#include "tracer/bvh/layout/lanes.h"
#include "tracer/bvh/layout/leaf_blocks.h"

namespace tracer {

FloatRows::FloatRows(size_t row_count, int width) : row_count_(row_count), width_(width) {
  data_.reset(static_cast<float*>(allocate_in_huge_pages(bytes())));
}

namespace {

constexpr size_t core_cache_bytes = size_t{1} << 21;
constexpr size_t shared_cache_bytes = 16 << 20;

class WideTreeWriter {
 public:
  WideTreeWriter(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress)
      : tree_(tree),
        progress_(progress),
        collapse_(tree, static_cast<uint32_t>(width), progress),
        leaves_(tree.primitives, mesh, static_cast<uint32_t>(width), wide_) {
    wide_.width = width;
  }

  WideTree run() {
    const Part& root = collapse_.part(0);
    // The root is always a node, so that every leaf is met through the slabs of its box.
    const size_t node_count = std::max(root.node_count, 1u);
    wide_.nodes = FloatRows(node_count * WideTree::rows_a_node, wide_.width);
    wide_.blocks = FloatRows(root.block_count * WideTree::rows_a_block, wide_.width);
    wide_.block_infos.resize(root.block_count);
    wide_.expected_steps = collapse_.expected_steps();
    wide_.is_larger_than_cache = wide_.bytes() > core_cache_bytes;
    wide_.is_larger_than_shared_cache = wide_.bytes() > shared_cache_bytes;
    const Box& bounds = tree_.nodes[0].bounds;
    wide_.max_coordinate =
        static_cast<float>(std::max(max_abs(Vec3d(bounds.min)), max_abs(Vec3d(bounds.max))));
    write_node(0, {0, 0});
    wide_.typical_extent = typical_extent();
    return std::move(wide_);
  }

 private:
  using Part = Collapse::Part;
  using Children = Collapse::Children;

  /// Where a subtree begins.
  struct Place {
    uint32_t node;
    uint32_t block;
  };
  using Places = std::array<Place, Collapse::max_width>;

  // Writes the node at place.node; what is below it follows, and its blocks are at place.block.
  void write_node(uint32_t node, Place place) {
    const Children children = collapse_.children_of(node);
    const Places places = places_of(children, {place.node + 1, place.block});
    write_lanes(children, places, wide_.nodes.row(place.node * WideTree::rows_a_node));
    const auto write_child = [&](size_t i) {
      const Part& part = collapse_.part(children.nodes[i]);
      if (part.is_leaf()) {
        leaves_.write(part.range, tree_.nodes[children.nodes[i]].bounds, places[i].block);
      } else {
        write_node(children.nodes[i], places[i]);
      }
    };
    const uint32_t primitive_count = collapse_.part(node).range.count();
    if (primitive_count > task_size) {
      parallel_for_each_index(0, children.count, write_child);
      progress_.throw_if_stopped();
    } else {
      for (size_t i = 0; i < children.count; ++i) write_child(i);
    }
    report(children, primitive_count);
  }

  Places places_of(const Children& children, Place next) const {
    Places places;
    for (size_t i = 0; i < children.count; ++i) {
      places[i] = next;
      const Part& part = collapse_.part(children.nodes[i]);
      next.node += part.node_count;
      next.block += part.block_count;
    }
    return places;
  }

  void write_lanes(const Children& children, const Places& places, float* rows) const {
    const auto width = static_cast<size_t>(wide_.width);
    const BvhNode empty;
    for (size_t lane = 0; lane < width; lane += 4) {
      std::array<Float4, 4> first_rows, last_rows;
      for (size_t i = 0; i < 4; ++i) {
        const bool is_used = lane + i < children.count;
        const BvhNode& node = is_used ? tree_.nodes[children.nodes[lane + i]] : empty;
        const Box& box = node.bounds;
        first_rows[i] = Float4{box.min.x, box.max.x, box.min.y, box.max.y};
        const float link = is_used ? link_to(children.nodes[lane + i], places[lane + i]) : 0.0f;
        last_rows[i] = Float4{box.min.z, box.max.z, link, 0};
      }
      transpose(first_rows);
      transpose(last_rows);
      for (size_t row = 0; row < 4; ++row) store(rows + row * width + lane, first_rows[row]);
      for (size_t row = 4; row < 7; ++row) store(rows + row * width + lane, last_rows[row - 4]);
    }
  }

  float link_to(uint32_t child, Place place) const {
    return std::bit_cast<float>(collapse_.part(child).is_leaf() ? WideChild::leaf(place.block)
                                                                : WideChild::node(place.node));
  }

  void report(const Children& children, uint32_t primitive_count) {
    uint32_t written = 0;
    for (const uint32_t child : children) {
      const Part& part = collapse_.part(child);
      written += part.is_leaf() ? part.range.count() : 0;
    }
    const uint32_t all = written_.fetch_add(written, std::memory_order_relaxed) + written;
    if (primitive_count > 1024) {
      progress_.set_fraction(static_cast<double>(all) / collapse_.part(0).range.count());
    }
  }

  float typical_extent() const {
    const std::vector<WideTree::BlockInfo>& infos = wide_.block_infos;
    const size_t count = std::min(infos.size(), size_t{1024});
    std::vector<float> extents(count);
    for (size_t i = 0; i < count; ++i) extents[i] = infos[i * infos.size() / count].extent;
    const auto middle = extents.begin() + static_cast<ptrdiff_t>(extents.size() / 2);
    std::ranges::nth_element(extents, middle);
    return *middle;
  }

  const BvhTree& tree_;
  Progress& progress_;
  const Collapse collapse_;
  std::atomic<uint32_t> written_{0};
  WideTree wide_;
  const LeafWriter leaves_;
};

}  // namespace

WideTree build_wide_tree(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress) {
  progress.throw_if_stopped();
  progress.start_stage("laying out the tree");
  return WideTreeWriter(tree, mesh, width, progress).run();
}

}  // namespace tracer
