// SPDX-License-Identifier: MIT
#include "tracer/scene/light_tree.h"

#include <cmath>
#include <limits>

#include <xmmintrin.h>

namespace tracer {
namespace {

Float4 splat(float value) {
  return Float4{value, value, value, value};
}
Float4 sqrt_of(Float4 v) {
  return _mm_sqrt_ps(v);
}

/// An angle in [0, pi] by cosine and sine.
struct Angle4 {
  Float4 cos;
  Float4 sin;
};

Angle4 angle_with_cos(Float4 cos) {
  const Float4 limited = max_of(min_of(cos, splat(1)), splat(-1));
  return {limited, sqrt_of(max_of(splat(1) - limited * limited, splat(0)))};
}

/// a - b, and 0 where b is larger.
Angle4 difference(const Angle4& a, const Angle4& b) {
  const auto is_larger = b.cos <= a.cos;
  return {is_larger ? splat(1) : a.cos * b.cos + a.sin * b.sin,
          is_larger ? splat(0) : a.sin * b.cos - a.cos * b.sin};
}

double sum_of(const std::array<float, 8>& weights) {
  double sum = 0;
  for (const float weight : weights) sum += weight;
  return sum;
}

}  // namespace

LightReceiver LightTree::placed(const LightReceiver& receiver) const {
  return {Vec3f((Vec3d(receiver.position) - center_) * scale_), receiver.normal};
}

LightTree::Weights LightTree::weights_of(const Node& node, const LightReceiver& receiver) {
  Weights weights;
  const Vec3f& p = receiver.position;
  const Float4 least_arriving = splat(receiver.normal == Vec3f(0) ? 1.0f : 0.0f);
  for (size_t half = 0; half < node.quads.size(); ++half) {
    const Quad& quad = node.quads[half];
    const Float4 x = quad.x - p.x;
    const Float4 y = quad.y - p.y;
    const Float4 z = quad.z - p.z;
    const Float4 nearest = max_of(quad.radius_squared, splat(std::numeric_limits<float>::min()));
    const Float4 square = max_of(x * x + y * y + z * z, nearest);
    const Float4 inverse = splat(1) / sqrt_of(square);
    // The sphere's radius as seen from the receiver: a right angle from within.
    const Float4 sin_squared = nearest / square;
    const Angle4 seen{sqrt_of(splat(1) - sin_squared), sqrt_of(sin_squared)};
    const Float4 along = (quad.axis_x * x + quad.axis_y * y + quad.axis_z * z) * inverse;
    const Angle4 leaving = angle_with_cos(max_of(along, -along));
    const Angle4 arriving = angle_with_cos(
        (receiver.normal.x * x + receiver.normal.y * y + receiver.normal.z * z) * inverse);
    const Float4 most_leaving =
        difference(difference(leaving, {quad.cos_spread, quad.sin_spread}), seen).cos;
    const Float4 most_arriving = difference(arriving, seen).cos;
    const Float4 weight = quad.power * max_of(most_leaving, splat(0)) *
                          max_of(most_arriving, least_arriving) / square;
    std::memcpy(&weights[4 * half], &weight, sizeof weight);
  }
  const double sum = sum_of(weights);
  if (sum > 0 && sum <= std::numeric_limits<float>::max()) return weights;
  // Nothing reaches the receiver, or it is too far away to tell: by power alone.
  std::memcpy(&weights[0], &node.quads[0].power, sizeof(Float4));
  std::memcpy(&weights[4], &node.quads[1].power, sizeof(Float4));
  return weights;
}

LightTree::Pick LightTree::pick(const LightReceiver& receiver, double u) const {
  const LightReceiver place = placed(receiver);
  double probability = 1;
  for (uint32_t node = 0;;) {
    const Weights weights = weights_of(nodes_[node], place);
    const double sum = sum_of(weights);
    double rest = u * sum;
    // Rounding may lead beyond the last child; it then is the last that has weight.
    size_t child = 0;
    for (size_t i = 0; i < width; ++i) {
      if (!(weights[i] > 0)) continue;
      child = i;
      if (rest < weights[i]) break;
      rest -= weights[i];
    }
    probability *= weights[child] / sum;
    const uint32_t next = nodes_[node].children[child];
    if (next & leaf_bit) return {next & ~leaf_bit, probability};
    u = std::min(rest / weights[child], 1 - 0x1p-53);
    node = next;
  }
}

double LightTree::probability(const LightReceiver& receiver, uint32_t light) const {
  const LightReceiver place = placed(receiver);
  double probability = 1;
  for (Place at = places_[light];; at = nodes_[at.node].parent) {
    const Weights weights = weights_of(nodes_[at.node], place);
    probability *= weights[at.child] / sum_of(weights);
    if (at.node == 0) return probability;
  }
}

}  // namespace tracer
