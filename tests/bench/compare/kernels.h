// SPDX-License-Identifier: MIT
// The table of ray-triangle tests under comparison.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/compare/kernel_blocks.h"

namespace bench {

/// Of one ray and one block.
struct Found {
  uint32_t hits = 0;  // bit i: triangle i is met, at t[i]
  double t[16];       // as the kernel knows it: a float, or a double
};

/// Tests the rays it was prepared for against all triangles of its block, found[i] for ray i.
using TestRays = std::function<void(std::span<Found> found)>;
/// Brings into the kernel's own form what depends on the ray alone or on the block alone: a
/// traversal does that once for many tests. Block and rays outlive what is returned.
using PrepareTest = TestRays (*)(const KernelBlock& block, std::span<const tracer::Ray> rays);

/// scalar: triangle by triangle, compiled for any x86-64. simd: as many at a time as the
/// processor's vectors hold. call: a ray tracer's function for one ray, through a tree of these
/// triangles; finds the nearest, and has all that a call costs.
enum class Form { scalar, simd, call };
std::string_view name_of(Form form);

struct Kernel {
  std::string_view name;
  Form form = Form::scalar;
  PrepareTest prepare = nullptr;  // as timed
  PrepareTest judge = nullptr;    // the same test, with an answer for each triangle

  bool is_ours() const { return name.starts_with("Boxwood"); }
};

/// Those that this processor can run.
std::vector<Kernel> kernels();

// The parts of that table.
std::span<const Kernel> scalar_kernels();
std::span<const Kernel> block_kernels();
std::span<const Kernel> boxwood_calls();
std::span<const Kernel> embree_calls();  // empty where there is no Embree

}  // namespace bench
