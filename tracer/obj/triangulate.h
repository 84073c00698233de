// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tracer/base/vectors.h"
#include "tracer/obj/point_grid.h"

namespace tracer {

/// Cuts polygons into triangles by ear clipping in the polygon's own plane: along Newell's normal
/// onto the axes that it is shortest in. Keeps its scratch memory from polygon to polygon.
class Triangulator {
 public:
  /// Appends corners.size() - 2 triangles, as indices of corners, that keep the polygon's sense of
  /// rotation. `corners` holds 3 or more finite points. Of polygons that cross themselves or have
  /// no area the triangles are some valid triples. Takes O(k) steps for k corners where few are
  /// reflex, O(k^2) at worst, and at most 2^26 + 1024 k: beyond that what is left becomes a fan.
  void triangulate(std::span<const Vec3d> corners, std::vector<Vec3u>& triangles);

 private:
  struct Ring {
    uint32_t previous = 0;
    uint32_t next = 0;
    bool is_reflex = false;   // or straight
    bool is_waiting = false;  // in next_candidates_
  };
  /// Which corners that coincide with an ear's own are passed over when they could block it.
  enum class Tolerance { none, coincident };

  void project(std::span<const Vec3d> corners);
  void make_ring();
  void clip_ears(std::vector<Vec3u>& triangles);
  bool clip_candidates(Tolerance tolerance, std::vector<Vec3u>& triangles);
  void add_all_candidates();
  void clip(uint32_t ear, std::vector<Vec3u>& triangles);
  void fan_rest(std::vector<Vec3u>& triangles);
  void update_reflex(uint32_t corner);
  void add_candidate(uint32_t corner);
  bool is_ear(uint32_t corner, Tolerance tolerance);
  bool blocks(uint32_t corner, uint32_t ear, Tolerance tolerance) const;
  double corner_area(uint32_t corner) const;
  void rebuild_grid();

  std::vector<Vec2d> points_;
  std::vector<Ring> ring_;
  std::vector<uint32_t> candidates_;
  std::vector<uint32_t> next_candidates_;
  std::vector<uint32_t> reflex_;
  PointGrid grid_;
  uint32_t first_ = 0;  // some corner still in the ring
  uint32_t left_ = 0;   // corners still in the ring
  size_t reflex_count_ = 0;
  int64_t steps_left_ = 0;
};

}  // namespace tracer
