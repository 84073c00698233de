// SPDX-License-Identifier: MIT
// Triangles that break builders, and an ordinary soup to compare with.
#pragma once

#include <memory>
#include <span>

#include "tests/numerics/rays.h"

namespace tracer::stress {

struct Input {
  const char* name;
  TestTriangle (*make)(uint32_t index, uint32_t count, RandomSource& random);
};

/// The last is ordinary().
std::span<const Input> inputs();
TestTriangle ordinary(uint32_t index, uint32_t count, RandomSource& random);
TestTriangle of_any_bits(uint32_t index, uint32_t count, RandomSource& random);

std::shared_ptr<const Mesh> make_input(const Input& input, uint32_t count);

}  // namespace tracer::stress
