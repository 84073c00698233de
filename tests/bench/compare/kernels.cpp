// SPDX-License-Identifier: MIT
#include "tests/bench/compare/kernels.h"

#include <memory>

#include "tracer/bvh/trace/wide_kernels.h"

namespace bench {
namespace {

using tracer::Hit;
using tracer::Ray;
using tracer::StopFlag;
using tracer::WideTree;

TestRays call_nearest(const KernelBlock& block, std::span<const Ray> rays) {
  return [&block, rays](std::span<Found> found) {
    const StopFlag stop;
    for (size_t i = 0; i < rays.size(); ++i) {
      Hit hit;
      found[i].hits = 0;
      if (!closest_hit_wide(block.tree, rays[i], stop, hit) || !hit.is_hit()) continue;
      found[i].hits = 1u << hit.primitive;
      found[i].t[hit.primitive] = hit.t;
    }
  };
}

// A tree for each triangle, as a call tells of the nearest hit only.
TestRays call_for_each_triangle(const KernelBlock& block, std::span<const Ray> rays) {
  auto trees = std::make_shared<std::vector<WideTree>>();
  tracer::Mesh one = *block.mesh;
  for (uint32_t i = 0; i < block.triangle_count(); ++i) {
    one.triangles = {block.mesh->triangles[i]};
    one.bounds = one.triangle_bounds(0);
    trees->push_back(make_one_block_tree(one));
  }
  return [trees, rays](std::span<Found> found) {
    const StopFlag stop;
    for (size_t i = 0; i < rays.size(); ++i) {
      found[i].hits = 0;
      for (size_t k = 0; k < trees->size(); ++k) {
        Hit hit;
        if (!closest_hit_wide((*trees)[k], rays[i], stop, hit) || !hit.is_hit()) continue;
        found[i].hits |= 1u << k;
        found[i].t[k] = hit.t;
      }
    }
  };
}

constexpr Kernel our_calls[] = {
    {"Boxwood", Form::call, call_nearest, call_for_each_triangle},
};

}  // namespace

std::string_view name_of(Form form) {
  constexpr std::string_view names[] = {"scalar", "SIMD", "whole call"};
  return names[static_cast<size_t>(form)];
}

std::span<const Kernel> boxwood_calls() {
  return our_calls;
}

std::vector<Kernel> kernels() {
  std::vector<Kernel> all;
  const auto add = [&](std::span<const Kernel> some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  add(scalar_kernels());
  if (tracer::wide_kernel_width() > 0) {
    add(block_kernels());
    add(boxwood_calls());
  }
  add(embree_calls());
  return all;
}

}  // namespace bench
