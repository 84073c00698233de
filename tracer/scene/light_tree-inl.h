// SPDX-License-Identifier: MIT
#if defined(TRACER_LIGHT_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_LIGHT_TREE_INL_H
#undef TRACER_LIGHT_TREE_INL_H
#else
#define TRACER_LIGHT_TREE_INL_H
#endif

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <hwy/highway.h>

#include "tracer/scene/light_tree.h"

#ifndef TRACER_LIGHT_TREE_KERNELS
#define TRACER_LIGHT_TREE_KERNELS
namespace tracer {

/// What the kernels see of a tree.
class LightTreeKernels {
 public:
  using Node = LightTree::Node;
  using Place = LightTree::Place;
  using Eight = LightTree::Eight;
  static constexpr size_t width = LightTree::width;
  static constexpr uint32_t leaf_bit = LightTree::leaf_bit;

  static const Node& node(const LightTree& tree, uint32_t index) { return tree.nodes_[index]; }
  static Place place(const LightTree& tree, uint32_t light) { return tree.places_[light]; }
  static LightReceiver placed(const LightTree& tree, const LightReceiver& receiver) {
    return tree.placed(receiver);
  }
};

}  // namespace tracer
#endif

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The weights of a node's children for one receiver, and their sums from the first on.
class LightWeights {
 public:
  static constexpr size_t width = LightTreeKernels::width;

  LightWeights(const LightTreeKernels::Node& node, const LightReceiver& placed) {
    for (size_t i = 0; i < width; i += hn::Lanes(tag)) weigh(node, placed, i);
    add_up();
    if (sum() > 0 && sum() <= double{std::numeric_limits<float>::max()}) return;
    // Nothing reaches the receiver, or it is too far away to tell: by power alone.
    weights_ = node.power;
    add_up();
  }

  double sum() const { return sums_[width - 1]; }
  double weight(size_t child) const { return static_cast<double>(weights_[child]); }
  double before(size_t child) const { return child > 0 ? sums_[child - 1] : 0; }

  /// The child in whose part of the sum `place`, at most all of it, lies. No branch: it could not
  /// be foreseen.
  size_t child_at(double place) const {
    size_t child = 0;
    for (size_t i = 0; i < width; i += hn::Lanes(half)) {
      child += hn::CountTrue(half, hn::Le(hn::Load(half, &sums_[i]), hn::Set(half, place)));
    }
    if (child < width) return child;
    // Rounding led beyond the last child; it then is the last that has weight.
    for (child = width - 1; !(weights_[child] > 0);) --child;
    return child;
  }

 private:
  static constexpr hn::CappedTag<float, width> tag{};
  using Floats = hn::Vec<hn::CappedTag<float, width>>;

  /// An angle in [0, pi] by cosine and sine.
  struct Angle {
    Floats cos, sin;
  };

  static Angle angle_with_cos(Floats cos) {
    const Floats one = hn::Set(tag, 1.0f);
    const Floats limited = hn::Max(hn::Min(cos, one), hn::Neg(one));
    const Floats square = hn::Mul(limited, limited);
    return {limited, hn::Sqrt(hn::Sub(one, square))};
  }

  /// a - b, and 0 where b is larger.
  static Angle difference(const Angle& a, const Angle& b) {
    const auto is_larger = hn::Le(b.cos, a.cos);
    const Floats cos = hn::Add(hn::Mul(a.cos, b.cos), hn::Mul(a.sin, b.sin));
    const Floats sin = hn::Sub(hn::Mul(a.sin, b.cos), hn::Mul(a.cos, b.sin));
    return {hn::IfThenElse(is_larger, hn::Set(tag, 1.0f), cos), hn::IfThenZeroElse(is_larger, sin)};
  }

  static Floats dot(Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz) {
    return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
  }

  void weigh(const LightTreeKernels::Node& node, const LightReceiver& placed, size_t first) {
    const auto load = [first](const LightTreeKernels::Eight& values) {
      return hn::Load(tag, &values[first]);
    };
    const auto set = [](float value) { return hn::Set(tag, value); };
    const Vec3f& p = placed.position;
    const Vec3f& n = placed.normal;
    const Floats x = hn::Sub(load(node.x), set(p.x));
    const Floats y = hn::Sub(load(node.y), set(p.y));
    const Floats z = hn::Sub(load(node.z), set(p.z));
    // Whose square is no denormal.
    const Floats radius = hn::Max(load(node.radius), set(0x1p-63f));
    const Floats square = hn::Max(dot(x, y, z, x, y, z), hn::Mul(radius, radius));
    const Floats inverse_square = hn::Div(set(1), square);
    const Floats inverse = hn::Sqrt(inverse_square);
    // The sphere's radius as seen from the receiver: a right angle from within.
    const Floats sin = hn::Min(hn::Mul(radius, inverse), set(1));
    const Angle seen{hn::Sqrt(hn::Sub(set(1), hn::Mul(sin, sin))), sin};
    const Floats along =
        hn::Mul(dot(load(node.axis_x), load(node.axis_y), load(node.axis_z), x, y, z), inverse);
    const Angle leaving = angle_with_cos(hn::Abs(along));
    const Angle arriving =
        angle_with_cos(hn::Mul(dot(set(n.x), set(n.y), set(n.z), x, y, z), inverse));
    const Angle spread{load(node.cos_spread), load(node.sin_spread)};
    const Floats most_leaving = difference(difference(leaving, spread), seen).cos;
    const Floats most_arriving = difference(arriving, seen).cos;
    const Floats least_arriving = set(n == Vec3f(0) ? 1.0f : 0.0f);
    const Floats reach =
        hn::Mul(hn::Max(most_leaving, hn::Zero(tag)), hn::Max(most_arriving, least_arriving));
    hn::Store(hn::Mul(hn::Mul(load(node.power), reach), inverse_square), tag, &weights_[first]);
  }

  /// Each half by itself, in two steps, and the first half's sum to all of the second: in vectors
  /// where four doubles fit, else one by one in the same order.
  void add_up() {
    if constexpr (hn::MaxLanes(half) == 4) {
      const auto first = sums_of_four(0);
      const auto second = sums_of_four(4);
      const auto all_of_first = hn::TableLookupLanes(first, hn::SetTableIndices(half, last_place));
      hn::Store(first, half, &sums_[0]);
      hn::Store(hn::Add(second, all_of_first), half, &sums_[4]);
    } else {
      for (size_t i = 0; i < width; i += 4) {
        const auto weight = [&](size_t k) { return static_cast<double>(weights_[i + k]); };
        const double two = weight(1) + weight(0);
        sums_[i] = weight(0);
        sums_[i + 1] = two;
        sums_[i + 2] = (weight(2) + weight(1)) + weight(0);
        sums_[i + 3] = (weight(3) + weight(2)) + two;
      }
      for (size_t i = 4; i < width; ++i) sums_[i] += sums_[3];
    }
  }

  using Half = hn::CappedTag<double, width / 2>;
  static constexpr Half half{};
  static constexpr int64_t places_before[] = {0, 0, 1, 2};
  static constexpr int64_t places_two_before[] = {0, 0, 0, 1};
  static constexpr int64_t last_place[] = {3, 3, 3, 3};

  hn::Vec<Half> sums_of_four(size_t first) const {
    const auto before = [&](hn::Vec<Half> v, size_t steps, const int64_t* places) {
      return hn::IfThenZeroElse(hn::FirstN(half, steps),
                                hn::TableLookupLanes(v, hn::SetTableIndices(half, places)));
    };
    const hn::Rebind<float, Half> floats;
    auto v = hn::PromoteTo(half, hn::Load(floats, &weights_[first]));
    v = hn::Add(v, before(v, 1, places_before));
    return hn::Add(v, before(v, 2, places_two_before));
  }

  alignas(64) LightTreeKernels::Eight weights_;
  alignas(64) std::array<double, width> sums_;
};

/// On the way from the root to a light.
struct LightWalk {
  LightReceiver placed;
  double u;
  double probability = 1;
  uint32_t at = 0;  // a node, or a light and leaf_bit

  bool is_over() const { return (at & LightTreeKernels::leaf_bit) != 0; }
  LightTree::Pick pick() const { return {at & ~LightTreeKernels::leaf_bit, probability, u}; }

  void step(const LightTree& tree) {
    const LightTreeKernels::Node& node = LightTreeKernels::node(tree, at);
    const LightWeights weights(node, placed);
    const double place = u * weights.sum();
    const size_t child = weights.child_at(place);
    probability *= weights.weight(child) / weights.sum();
    u = std::clamp((place - weights.before(child)) / weights.weight(child), 0.0, 1 - 0x1p-53);
    at = node.children[child];
  }
};

/// All walks take a step before any takes the next: a step waits for roots and quotients, and the
/// next one of the same walk for it.
// NOLINTNEXTLINE(misc-definitions-in-headers): each instruction set has a namespace of its own.
void PickLights(const LightTree& tree, std::span<const LightReceiver> receivers,
                std::span<const double> u, std::span<LightTree::Pick> picks) {
  constexpr size_t most_walks = 64;
  std::array<LightWalk, most_walks> walks;
  std::array<uint32_t, most_walks> owners;
  for (size_t first = 0; first < receivers.size(); first += most_walks) {
    size_t count = std::min(most_walks, receivers.size() - first);
    for (size_t i = 0; i < count; ++i) {
      walks[i] = {LightTreeKernels::placed(tree, receivers[first + i]), u[first + i]};
      owners[i] = static_cast<uint32_t>(first + i);
    }
    while (count > 0) {
      size_t kept = 0;
      for (size_t i = 0; i < count; ++i) {
        LightWalk& walk = walks[i];
        walk.step(tree);
        if (walk.is_over()) {
          picks[owners[i]] = walk.pick();
          continue;
        }
        if (kept != i) {
          walks[kept] = walk;
          owners[kept] = owners[i];
        }
        ++kept;
      }
      count = kept;
    }
  }
}

// NOLINTNEXTLINE(misc-definitions-in-headers): as above.
double LightProbability(const LightTree& tree, const LightReceiver& receiver, uint32_t light) {
  const LightReceiver placed = LightTreeKernels::placed(tree, receiver);
  double probability = 1;
  for (auto at = LightTreeKernels::place(tree, light);;) {
    const LightTreeKernels::Node& node = LightTreeKernels::node(tree, at.node);
    const LightWeights weights(node, placed);
    probability *= weights.weight(at.child) / weights.sum();
    if (at.node == 0) return probability;
    at = node.parent;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
