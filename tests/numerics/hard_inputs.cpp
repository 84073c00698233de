// SPDX-License-Identifier: MIT
#include "tests/numerics/hard_inputs.h"

#include <cmath>

#include "tests/support/test_meshes.h"

namespace tracer::stress {
namespace {

TestTriangle identical(uint32_t, uint32_t, RandomSource&) {
  return {{0, 0, 0}, {1, 0.1f, 0}, {0, 1, 0.2f}};
}

TestTriangle concentric(uint32_t index, uint32_t count, RandomSource&) {
  const float size = static_cast<float>(index + 1) / static_cast<float>(count);
  return {{-size, -size, 0}, {size, -size, 0}, {0, size, 0}};
}

// Each holds all before it: the tree that parts one after the other is as deep as there are many.
TestTriangle chain(uint32_t index, uint32_t count, RandomSource&) {
  const float size = std::exp2(200 * static_cast<float>(index) / static_cast<float>(count) - 100);
  return {{0, 0, 0}, {size, 0.5f * size, 0.1f * size}, {0.2f * size, size, size}};
}

TestTriangle in_a_line(uint32_t index, uint32_t, RandomSource&) {
  const auto x = static_cast<float>(index);
  return {{x, 0, 0}, {x + 1, 0, 0}, {x, 0, 1}};
}

TestTriangle in_a_plane(uint32_t, uint32_t, RandomSource& random) {
  const Vec3f corner(random.between(-1, 1), 0, random.between(-1, 1));
  return {corner, corner + Vec3f(0.01f, 0, 0), corner + Vec3f(0, 0, 0.01f)};
}

TestTriangle a_point(uint32_t, uint32_t, RandomSource&) {
  return {Vec3f(3, 2, 1), Vec3f(3, 2, 1), Vec3f(3, 2, 1)};
}

TestTriangle soup_of(float least_exponent, float most_exponent, RandomSource& random) {
  const auto vertex = [&] {
    return std::exp2(random.between(least_exponent, most_exponent)) * random.vector(-1, 1);
  };
  const Vec3f v0 = vertex();
  const Vec3f v1 = vertex();
  return {v0, v1, vertex()};
}

TestTriangle huge(uint32_t, uint32_t, RandomSource& random) {
  return soup_of(60, 127.9f, random);  // 1e18 to 3e38
}

TestTriangle tiny(uint32_t, uint32_t, RandomSource& random) {
  return soup_of(-149, -110, random);
}

constexpr Input table[] = {
    {"identical triangles", identical},
    {"triangles around one centre", concentric},
    {"a chain, each around all before", chain},
    {"triangles in a line", in_a_line},
    {"triangles in a plane", in_a_plane},
    {"triangles that are one point", a_point},
    {"triangles of 1e18 to 3e38", huge},
    {"triangles of denormals", tiny},
    {"triangles of any finite bits", of_any_bits},
    {"an ordinary soup", ordinary},
};

}  // namespace

std::span<const Input> inputs() {
  return table;
}

TestTriangle of_any_bits(uint32_t, uint32_t, RandomSource& random) {
  const auto vertex = [&] {
    const float x = random.finite_bits();
    const float y = random.finite_bits();
    return Vec3f(x, y, random.finite_bits());
  };
  const Vec3f v0 = vertex();
  const Vec3f v1 = vertex();
  return {v0, v1, vertex()};
}

TestTriangle ordinary(uint32_t, uint32_t, RandomSource& random) {
  const Vec3f center = random.vector(-1, 1);
  return {center, center + random.vector(-0.01f, 0.01f), center + random.vector(-0.01f, 0.01f)};
}

std::shared_ptr<const Mesh> make_input(const Input& input, uint32_t count) {
  RandomSource random(1);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t i = 0; i < count; ++i) {
    const TestTriangle triangle = input.make(i, count, random);
    positions.insert(positions.end(), {triangle.v0, triangle.v1, triangle.v2});
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return std::make_shared<const Mesh>(make_test_mesh(std::move(positions), std::move(triangles)));
}

}  // namespace tracer::stress
