// SPDX-License-Identifier: MIT
#include "assets/simplify.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include "assets/quadric.h"

namespace assets {
namespace {

constexpr double outline_weight = 4.0;
constexpr double thinnest =
    0.15;  // of shapely(): collapses make no thinner triangle, but out of a worse

Vec3d area_vector(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return 0.5 * glm::cross(b - a, c - a);
}

/// 1 for the equilateral triangle, 0 for a segment.
double shapely(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double edges = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
  return edges > 0.0 ? 4.0 * std::sqrt(3.0) * glm::length(area_vector(a, b, c)) / edges : 0.0;
}

struct Collapse {
  double cost;
  uint32_t kept, removed;
  uint32_t version;  // of both vertices together, when the cost was computed
  bool operator>(const Collapse& other) const {
    return std::tie(cost, kept, removed) > std::tie(other.cost, other.kept, other.removed);
  }
};

class Simplifier {
 public:
  Simplifier(const PaintedSurface& surface, const Field& importance)
      : surface_(surface),
        live_count_(surface.triangles.size()),
        is_live_(surface.triangles.size(), true),
        around_(surface.points.size()),
        quadrics_(surface.points.size()),
        versions_(surface.points.size(), 0) {
    for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
      for (const uint32_t corner : surface.triangles[i]) around_[corner].push_back(i);
    }
    for (const Vec3d& point : surface.points) {
      const double factor = importance(point);
      weights_.push_back(factor * factor);
    }
    for (uint32_t i = 0; i < surface.triangles.size(); ++i) add_quadrics(i);
    for (uint32_t vertex = 0; vertex < surface.points.size(); ++vertex) {
      for (const uint32_t other : neighbors(vertex)) {
        if (vertex < other) propose(vertex, other);
      }
    }
  }

  PaintedSurface reduce(size_t triangle_count) {
    while (live_count_ > triangle_count && !queue_.empty()) {
      const Collapse next = queue_.top();
      queue_.pop();
      if (next.version != versions_[next.kept] + versions_[next.removed]) continue;
      Vec3d place;
      const double cost = evaluate(next.kept, next.removed, place);
      if (cost == impossible) continue;
      if (cost > next.cost) {
        queue_.push({cost, next.kept, next.removed, next.version});
      } else {
        collapse(next.kept, next.removed, place);
      }
    }
    return compact();
  }

 private:
  static constexpr double impossible = std::numeric_limits<double>::infinity();

  const Vec3d& corner(uint32_t triangle, int i) const {
    return surface_.points[surface_.triangles[triangle][i]];
  }
  bool has(uint32_t triangle, uint32_t vertex) const {
    return std::ranges::count(surface_.triangles[triangle], vertex) != 0;
  }

  std::vector<uint32_t> neighbors(uint32_t vertex) const {
    std::vector<uint32_t> result;
    for (const uint32_t triangle : around_[vertex]) {
      for (const uint32_t other : surface_.triangles[triangle]) {
        if (other != vertex) result.push_back(other);
      }
    }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  bool is_outline(uint32_t a, uint32_t b) const {
    int materials[2] = {-1, -1};
    int count = 0;
    for (const uint32_t triangle : around_[a]) {
      if (has(triangle, b) && count < 2) materials[count++] = surface_.materials[triangle];
    }
    return materials[0] != materials[1];
  }

  /// 0 inside a region, 2 on an outline; more where outlines meet.
  int outline_count(uint32_t vertex) const {
    const uint8_t first = surface_.materials[around_[vertex][0]];
    const bool is_inside = std::ranges::all_of(
        around_[vertex], [&](uint32_t triangle) { return surface_.materials[triangle] == first; });
    if (is_inside) return 0;
    const auto others = neighbors(vertex);
    return static_cast<int>(
        std::ranges::count_if(others, [&](uint32_t other) { return is_outline(vertex, other); }));
  }

  void add_quadrics(uint32_t triangle) {
    const Vec3d area = area_vector(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
    const double size = glm::length(area);
    if (size == 0.0) return;
    const Vec3d normal = area / size;
    const auto& corners = surface_.triangles[triangle];
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = corners[i], b = corners[(i + 1) % 3];
      quadrics_[a].add_plane(surface_.points[a], normal, size * weights_[a]);
      if (!is_outline(a, b)) continue;
      const Vec3d edge = surface_.points[b] - surface_.points[a];
      const Vec3d across = glm::normalize(glm::cross(edge, normal));
      const double weight = outline_weight * glm::dot(edge, edge) * weights_[a];
      quadrics_[a].add_plane(surface_.points[a], across, weight);
      quadrics_[b].add_plane(surface_.points[a], across, weight);
    }
  }

  void propose(uint32_t kept, uint32_t removed) {
    Vec3d place;
    const double cost = evaluate(kept, removed, place);
    if (cost == impossible) return;
    queue_.push({cost, kept, removed, versions_[kept] + versions_[removed]});
  }

  /// The cost of making `a` and `b` one vertex, and the best place for it.
  double evaluate(uint32_t a, uint32_t b, Vec3d& place) const {
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    if (!choose_place(a, b, sum, place) || !stays_manifold(a, b)) return impossible;
    const double quality = std::min(worst_shape(a, b, place), worst_shape(b, a, place));
    if (quality == 0.0 || quality < std::min(thinnest, worst_shape_now(a, b))) return impossible;
    const Vec3d edge = surface_.points[b] - surface_.points[a];
    const double length_squared = glm::dot(edge, edge);
    const double evenness = 1e-5 * length_squared * length_squared * (weights_[a] + weights_[b]);
    return (sum(place) + evenness) / quality;
  }

  /// False where an outline would be torn off its place.
  bool choose_place(uint32_t a, uint32_t b, const Quadric& sum, Vec3d& place) const {
    const int a_count = outline_count(a), b_count = outline_count(b);
    const Vec3d& a_point = surface_.points[a];
    const Vec3d& b_point = surface_.points[b];
    const Vec3d middle = 0.5 * (a_point + b_point);
    if (a_count != 0 && b_count != 0 && !is_outline(a, b)) return false;
    if (a_count > 2 && b_count > 2) return false;
    if (a_count == b_count)
      place = sum.least_near(middle);
    else
      place = a_count > b_count ? a_point : b_point;
    return true;
  }

  /// The link condition: exactly the two corners across the edge are neighbours of both its ends.
  bool stays_manifold(uint32_t a, uint32_t b) const {
    const auto of_a = neighbors(a), of_b = neighbors(b);
    std::vector<uint32_t> common;
    std::ranges::set_intersection(of_a, of_b, std::back_inserter(common));
    if (common.size() != 2) return false;
    return std::ranges::all_of(common, [&](uint32_t v) { return around_[v].size() > 3; });
  }

  /// The least shapely triangle at `moved` without `other` once `moved` is at `place`; 0 where one
  /// would turn over.
  double worst_shape(uint32_t moved, uint32_t other, const Vec3d& place) const {
    double worst = 1.0;
    for (const uint32_t triangle : around_[moved]) {
      if (has(triangle, other)) continue;
      Vec3d points[3];
      for (int i = 0; i < 3; ++i) {
        const bool is_moved = surface_.triangles[triangle][i] == moved;
        points[i] = is_moved ? place : corner(triangle, i);
      }
      const Vec3d before =
          area_vector(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
      const Vec3d after = area_vector(points[0], points[1], points[2]);
      if (glm::dot(before, after) <= 0.3 * glm::length(before) * glm::length(after)) return 0.0;
      worst = std::min(worst, shapely(points[0], points[1], points[2]));
    }
    return worst;
  }

  double worst_shape_now(uint32_t a, uint32_t b) const {
    return std::min(worst_shape(a, b, surface_.points[a]), worst_shape(b, a, surface_.points[b]));
  }

  void collapse(uint32_t kept, uint32_t removed, const Vec3d& place) {
    for (const uint32_t triangle : around_[removed]) {
      auto& corners = surface_.triangles[triangle];
      if (has(triangle, kept)) {
        is_live_[triangle] = false;
        --live_count_;
        for (const uint32_t vertex : corners) {
          if (vertex != removed) std::erase(around_[vertex], triangle);
        }
      } else {
        std::ranges::replace(corners, removed, kept);
        around_[kept].push_back(triangle);
      }
    }
    around_[removed].clear();
    surface_.points[kept] = place;
    quadrics_[kept] += quadrics_[removed];
    weights_[kept] = std::max(weights_[kept], weights_[removed]);
    ++versions_[removed];
    ++versions_[kept];
    for (const uint32_t other : neighbors(kept)) propose(kept, other);
  }

  PaintedSurface compact() const {
    constexpr auto unused = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> places(surface_.points.size(), unused);
    PaintedSurface result;
    for (size_t i = 0; i < surface_.triangles.size(); ++i) {
      if (!is_live_[i]) continue;
      auto corners = surface_.triangles[i];
      for (uint32_t& vertex : corners) {
        if (places[vertex] == unused) {
          places[vertex] = static_cast<uint32_t>(result.points.size());
          result.points.push_back(surface_.points[vertex]);
        }
        vertex = places[vertex];
      }
      result.triangles.push_back(corners);
      result.materials.push_back(surface_.materials[i]);
    }
    return result;
  }

  PaintedSurface surface_;
  size_t live_count_;
  std::vector<bool> is_live_;                  // one a triangle
  std::vector<std::vector<uint32_t>> around_;  // live triangles at each vertex
  std::vector<Quadric> quadrics_;
  std::vector<double> weights_;
  std::vector<uint32_t> versions_;  // how often each vertex has changed
  std::priority_queue<Collapse, std::vector<Collapse>, std::greater<>> queue_;
};

}  // namespace

PaintedSurface simplify(const PaintedSurface& surface, size_t triangle_count,
                        const Field& importance) {
  return Simplifier(surface, importance).reduce(triangle_count);
}

}  // namespace assets
