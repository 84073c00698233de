// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tracer/geometry/box.h"

namespace tracer {

/// What a light can do to points elsewhere. It emits to both sides.
struct LightBounds {
  Box box;
  Vec3d normal{};    // unit length, of either side
  double power = 0;  // above 0, in any unit
};

/// Where light is wanted: lights below the plane of the normal are of no use. Without a normal,
/// light from everywhere is.
struct LightReceiver {
  Vec3f position{};
  Vec3f normal{};  // unit length or zero
};

/// Lights to be picked by what they may bring to a receiver: power, distance and both cosines,
/// bounded for groups of lights by a sphere and a cone of normals [Conty Estevez 2018]. Nodes have
/// eight children each, so that a pick among thousands takes four steps.
class LightTree {
 public:
  struct Pick {
    uint32_t light = 0;
    double probability = 0;
    double rest = 0;  // of u, uniform in [0, 1) again
  };

  LightTree() = default;
  explicit LightTree(std::span<const LightBounds> lights);

  bool empty() const { return nodes_.empty(); }
  /// A light for each receiver. u uniform in [0, 1), one a receiver. The tree is not empty. Many
  /// receivers at once take half the time of one by one, and have the same bits.
  void pick(std::span<const LightReceiver> receivers, std::span<const double> u,
            std::span<Pick> picks) const;
  Pick pick(const LightReceiver& receiver, double u) const {
    Pick picked;
    pick({&receiver, 1}, {&u, 1}, {&picked, 1});
    return picked;
  }
  /// With which `pick` returns that light.
  double probability(const LightReceiver& receiver, uint32_t light) const;

 private:
  friend class LightTreeBuilder;
  friend class LightTreeKernels;

  static constexpr size_t width = 8;
  static constexpr uint32_t leaf_bit = 0x80000000u;

  using Eight = std::array<float, width>;
  struct Place {
    uint32_t node = 0;
    uint32_t child = 0;
  };
  /// Of each child; power 0 where there is none.
  struct alignas(64) Node {
    Eight x{}, y{}, z{}, radius{};           // sphere about all points
    Eight axis_x{}, axis_y{}, axis_z{};      // the lights' normals are
    Eight cos_spread{}, sin_spread{};        // no further from it or its opposite
    Eight power{};                           // parts of all lights'
    std::array<uint32_t, width> children{};  // a node, or a light and leaf_bit
    Place parent;                            // of the root: itself
  };

  LightReceiver placed(const LightReceiver& receiver) const;

  std::vector<Node> nodes_;    // the root first
  std::vector<Place> places_;  // of the lights
  // Brings the lights into [-1, 1], where no square overflows.
  Vec3d center_{};
  double scale_ = 1;
};

}  // namespace tracer
