// SPDX-License-Identifier: MIT
#include "assets/outline.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace assets {
namespace {

class Cutter {
 public:
  Cutter(PaintedSurface& surface, const Field& region, uint8_t material)
      : surface_(surface), material_(material) {
    for (const Vec3d& point : surface.points) values_.push_back(region(point));
    snap();
  }

  void cut() {
    auto triangles = std::exchange(surface_.triangles, {});
    auto materials = std::exchange(surface_.materials, {});
    for (size_t i = 0; i < triangles.size(); ++i) cut_triangle(triangles[i], materials[i]);
  }

 private:
  /// Draws the outline through vertices close to it, so that no sliver is cut off.
  void snap() {
    const double margin = 0.2;
    std::vector<double> snapped = values_;
    for (const auto& corners : surface_.triangles) {
      for (int i = 0; i < 3; ++i) {
        const uint32_t a = corners[i], b = corners[(i + 1) % 3];
        if (!is_crossed(a, b)) continue;
        const double part = values_[a] / (values_[a] - values_[b]);
        if (part < margin) snapped[a] = 0.0;
        if (part > 1.0 - margin) snapped[b] = 0.0;
      }
    }
    values_ = std::move(snapped);
  }

  bool is_crossed(uint32_t a, uint32_t b) const {
    return (values_[a] < 0.0 && values_[b] > 0.0) || (values_[a] > 0.0 && values_[b] < 0.0);
  }

  uint32_t crossing(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto fresh = static_cast<uint32_t>(surface_.points.size());
    const auto [entry, is_new] = crossings_.try_emplace(uint64_t{a} << 32 | b, fresh);
    if (is_new) {
      const double part = values_[a] / (values_[a] - values_[b]);
      surface_.points.push_back(glm::mix(surface_.points[a], surface_.points[b], part));
      values_.push_back(0.0);
    }
    return entry->second;
  }

  void cut_triangle(const std::array<uint32_t, 3>& corners, uint8_t old_material) {
    const bool is_flat =
        std::ranges::all_of(corners, [&](uint32_t corner) { return values_[corner] == 0.0; });
    if (is_flat) return emit({corners.begin(), corners.end()}, old_material);
    std::vector<uint32_t> below, above;
    for (int i = 0; i < 3; ++i) {
      const uint32_t corner = corners[i], next = corners[(i + 1) % 3];
      if (values_[corner] <= 0.0) below.push_back(corner);
      if (values_[corner] >= 0.0) above.push_back(corner);
      if (!is_crossed(corner, next)) continue;
      below.push_back(crossing(corner, next));
      above.push_back(below.back());
    }
    emit(below, material_);
    emit(above, old_material);
  }

  void emit(const std::vector<uint32_t>& polygon, uint8_t material) {
    for (size_t i = 2; i < polygon.size(); ++i) {
      surface_.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
      surface_.materials.push_back(material);
    }
  }

  PaintedSurface& surface_;
  uint8_t material_;
  std::vector<double> values_;  // of the region's field, one a point
  std::unordered_map<uint64_t, uint32_t> crossings_;
};

}  // namespace

PaintedSurface paint(Surface surface, std::span<const Field> regions) {
  PaintedSurface painted{std::move(surface.points), std::move(surface.triangles), {}};
  painted.materials.resize(painted.triangles.size(), 0);
  for (size_t i = 0; i < regions.size(); ++i) {
    Cutter(painted, regions[i], static_cast<uint8_t>(i + 1)).cut();
  }
  return painted;
}

}  // namespace assets
