// SPDX-License-Identifier: MIT
#include "tracer/obj/triangulate.h"

#include <cmath>

namespace tracer {
namespace {

constexpr int64_t steps_of_any = int64_t{1} << 26;
constexpr int64_t steps_a_corner = 1024;
constexpr int max_rescans = 16;
// Below this many reflex corners a scan is as fast as a smaller grid.
constexpr size_t smallest_grid = 16;

/// Twice the signed area of a b c.
double signed_area(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Vec3d newell_normal(std::span<const Vec3d> corners) {
  Vec3d normal(0.0);
  Vec3d from = corners.back() - corners[0];
  for (const Vec3d& corner : corners) {
    const Vec3d to = corner - corners[0];
    normal += glm::cross(from, to);
    from = to;
  }
  return normal;
}

/// Along 0-2 as a fan does, unless that folds the quad over and 1-3 does not.
void split_quad(std::span<const Vec3d> corners, std::vector<Vec3u>& triangles) {
  const Vec3d normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
  const auto side = [&](int a, int b, int c) {
    return glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), normal);
  };
  const bool is_fan_valid = side(0, 1, 2) > 0 && side(0, 2, 3) > 0;
  if (!is_fan_valid && side(1, 2, 3) > 0 && side(1, 3, 0) > 0) {
    triangles.insert(triangles.end(), {{1, 2, 3}, {1, 3, 0}});
  } else {
    triangles.insert(triangles.end(), {{0, 1, 2}, {0, 2, 3}});
  }
}

}  // namespace

void Triangulator::triangulate(std::span<const Vec3d> corners, std::vector<Vec3u>& triangles) {
  if (corners.size() == 3) {
    triangles.emplace_back(0, 1, 2);
  } else if (corners.size() == 4) {
    split_quad(corners, triangles);
  } else {
    project(corners);
    make_ring();
    clip_ears(triangles);
  }
}

/// Drops the normal's longest axis, so that the polygon runs counterclockwise.
void Triangulator::project(std::span<const Vec3d> corners) {
  const Vec3d normal = newell_normal(corners);
  const Vec3d size = glm::abs(normal);
  const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int right = (dropped + 1) % 3;
  int up = (dropped + 2) % 3;
  if (normal[dropped] < 0) std::swap(right, up);
  points_.clear();
  for (const Vec3d& corner : corners) {
    const Vec3d offset = corner - corners[0];
    points_.emplace_back(offset[right], offset[up]);
  }
}

void Triangulator::make_ring() {
  const auto corner_count = static_cast<uint32_t>(points_.size());
  ring_.resize(corner_count);
  for (uint32_t i = 0; i < corner_count; ++i) {
    ring_[i] = {i == 0 ? corner_count - 1 : i - 1, i + 1 == corner_count ? 0 : i + 1};
  }
  first_ = 0;
  left_ = corner_count;
  steps_left_ = steps_of_any + steps_a_corner * corner_count;
  for (uint32_t i = 0; i < corner_count; ++i) ring_[i].is_reflex = corner_area(i) <= 0;
  rebuild_grid();
}

void Triangulator::rebuild_grid() {
  reflex_.clear();
  uint32_t corner = first_;
  for (uint32_t i = 0; i < left_; ++i, corner = ring_[corner].next) {
    if (ring_[corner].is_reflex) reflex_.push_back(corner);
  }
  reflex_count_ = reflex_.size();
  grid_.build(points_, reflex_);
}

double Triangulator::corner_area(uint32_t corner) const {
  const Ring& link = ring_[corner];
  return signed_area(points_[link.previous], points_[corner], points_[link.next]);
}

/// Rescans all corners when none of the candidates is an ear, first strictly; a ring that has no
/// ear at all crosses itself or has no area.
void Triangulator::clip_ears(std::vector<Vec3u>& triangles) {
  next_candidates_.clear();
  for (int rescan = 0; rescan < max_rescans && left_ > 3; ++rescan) {
    const Tolerance tolerance = rescan % 2 == 0 ? Tolerance::none : Tolerance::coincident;
    add_all_candidates();
    while (left_ > 3 && clip_candidates(tolerance, triangles)) {
    }
    if (steps_left_ < 0) break;
  }
  fan_rest(triangles);
}

void Triangulator::add_all_candidates() {
  uint32_t corner = first_;
  for (uint32_t i = 0; i < left_; ++i, corner = ring_[corner].next) add_candidate(corner);
}

void Triangulator::add_candidate(uint32_t corner) {
  if (ring_[corner].is_waiting) return;
  ring_[corner].is_waiting = true;
  next_candidates_.push_back(corner);
}

/// One lap over the candidates; neighbours of a clipped ear wait for the next lap, which keeps
/// triangles from becoming a fan of slivers. Returns whether candidates are left.
bool Triangulator::clip_candidates(Tolerance tolerance, std::vector<Vec3u>& triangles) {
  candidates_.swap(next_candidates_);
  next_candidates_.clear();
  for (const uint32_t corner : candidates_) ring_[corner].is_waiting = false;
  for (const uint32_t corner : candidates_) {
    if (left_ <= 3 || steps_left_ < 0) return false;
    if (ring_[corner].is_waiting || !is_ear(corner, tolerance)) continue;
    clip(corner, triangles);
  }
  return !next_candidates_.empty();
}

void Triangulator::clip(uint32_t ear, std::vector<Vec3u>& triangles) {
  const auto [previous, next, is_reflex, is_waiting] = ring_[ear];
  triangles.emplace_back(previous, ear, next);
  ring_[previous].next = next;
  ring_[next].previous = previous;
  if (is_reflex) --reflex_count_;
  ring_[ear].is_reflex = false;
  first_ = next;
  --left_;
  for (const uint32_t neighbour : {previous, next}) {
    update_reflex(neighbour);
    add_candidate(neighbour);
  }
  if (reflex_.size() > smallest_grid && reflex_count_ < reflex_.size() / 4) rebuild_grid();
}

/// Clipping an ear narrows its neighbours' angles: a convex corner never becomes reflex, so the
/// grid stays complete.
void Triangulator::update_reflex(uint32_t corner) {
  if (!ring_[corner].is_reflex || corner_area(corner) <= 0) return;
  ring_[corner].is_reflex = false;
  --reflex_count_;
}

/// A convex corner, or one that repeats its neighbour, whose triangle no reflex corner is in.
bool Triangulator::is_ear(uint32_t corner, Tolerance tolerance) {
  const Ring& link = ring_[corner];
  const Vec2d a = points_[link.previous];
  const Vec2d b = points_[corner];
  const Vec2d c = points_[link.next];
  if (a == b || b == c) return true;
  if (signed_area(a, b, c) <= 0) return false;
  return !grid_.any_in_triangle(a, b, c, steps_left_,
                                [&](uint32_t other) { return blocks(other, corner, tolerance); });
}

bool Triangulator::blocks(uint32_t corner, uint32_t ear, Tolerance tolerance) const {
  const Ring& link = ring_[ear];
  if (!ring_[corner].is_reflex || corner == link.previous || corner == link.next) return false;
  const Vec2d a = points_[link.previous];
  const Vec2d b = points_[ear];
  const Vec2d c = points_[link.next];
  const Vec2d p = points_[corner];
  // Where a polygon touches itself, as at the bridge to a hole, corners share a place.
  if (p == a || p == c || (tolerance == Tolerance::coincident && p == b)) return false;
  return signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0;
}

void Triangulator::fan_rest(std::vector<Vec3u>& triangles) {
  const uint32_t hub = first_;
  for (uint32_t corner = ring_[hub].next; left_ >= 3; --left_) {
    const uint32_t next = ring_[corner].next;
    triangles.emplace_back(hub, corner, next);
    corner = next;
  }
}

}  // namespace tracer
