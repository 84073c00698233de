// SPDX-License-Identifier: MIT
// Every way in which rays are answered in production: layouts, instruction sets, alone or together.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "tests/numerics/stress.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/same_bits.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/accel.h"
#include "tracer/render/world.h"

namespace tracer::stress {

BvhTree build_tree(const Builder& builder, const Mesh& mesh, const BuildSettings& settings = {});

/// Calls f(name, accel) with the tree as the recursive reference takes it, and as the SIMD kernels
/// do, with each instruction set forced in turn while f runs.
template <class F>
void for_each_accel(const std::shared_ptr<const Mesh>& mesh, const BvhTree& tree, F&& f) {
  Progress progress;
  const auto shared = std::make_shared<const BvhTree>(tree);
  f(std::string("recursive"), make_accel(mesh, shared, *find_layout("binary"), progress));
  for_each_instruction_set([&](const std::string& name) {
    f(name, make_accel(mesh, shared, *find_layout("wide"), progress));
  });
}

/// The same world, with another tree in another layout.
World with_tree(const World& world, const BvhTree& tree, const Layout& layout);
/// As production has it: the first builder and layout of the tables.
World in_production(const World& world);
std::string literal(const Hit& hit);

/// Asks for closest hits and occlusions, one by one and all together, and checks that all have the
/// bits of expected[i] for rays[i].
void check_answers(Trial& trial, const Accel& accel, std::span<const Ray> rays,
                   std::span<const Hit> expected);

/// The same four questions, of rays of which each must hit something.
void check_all_hit(Trial& trial, const Accel& accel, std::span<const Ray> rays);

}  // namespace tracer::stress
