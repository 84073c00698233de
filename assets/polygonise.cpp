// SPDX-License-Identifier: MIT
#include "assets/polygonise.h"

#include <unordered_map>
#include <utility>

namespace assets {
namespace {

class Marcher {
 public:
  Marcher(const Field& field, const Vec3d& lower, const Vec3d& upper, double step)
      : lower_(lower), step_(step) {
    const Vec3d cells = glm::ceil((upper - lower) / step);
    for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<uint32_t>(cells[axis]) + 1;
    values_.reserve(size_t{size_[0]} * size_[1] * size_[2]);
    for (uint32_t z = 0; z < size_[2]; ++z)
      for (uint32_t y = 0; y < size_[1]; ++y)
        for (uint32_t x = 0; x < size_[0]; ++x) values_.push_back(field(place(x, y, z)));
  }

  Surface march() {
    for (uint32_t z = 0; z + 1 < size_[2]; ++z)
      for (uint32_t y = 0; y + 1 < size_[1]; ++y)
        for (uint32_t x = 0; x + 1 < size_[0]; ++x) march_cube(x, y, z);
    return std::move(surface_);
  }

 private:
  Vec3d place(uint32_t x, uint32_t y, uint32_t z) const { return lower_ + step_ * Vec3d(x, y, z); }
  uint32_t index(uint32_t x, uint32_t y, uint32_t z) const {
    return (z * size_[1] + y) * size_[0] + x;
  }
  Vec3d place(uint32_t node) const {
    const uint32_t row = node / size_[0];
    return place(node % size_[0], row % size_[1], row / size_[1]);
  }

  void march_cube(uint32_t x, uint32_t y, uint32_t z) {
    uint32_t corners[8];
    int inside_count = 0;
    for (uint32_t corner = 0; corner < 8; ++corner) {
      corners[corner] = index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
      inside_count += values_[corners[corner]] < 0.0;
    }
    if (inside_count == 0 || inside_count == 8) return;
    // The six paths from corner 0 to 7, ordered so that each tetrahedron's volume is positive.
    static constexpr int paths[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                        {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}};
    for (const auto& path : paths) march_tetrahedron(corners, path);
  }

  /// `path` names the corners of a tetrahedron of positive volume.
  void march_tetrahedron(const uint32_t* corners, const int* path) {
    uint32_t inside[4], outside[4];
    int inside_count = 0, outside_count = 0;
    bool is_even = true;  // the permutation from the path to inside, then outside
    for (int i = 0; i < 4; ++i) {
      const uint32_t node = corners[path[i]];
      if (values_[node] < 0.0) {
        is_even ^= (outside_count & 1) != 0;
        inside[inside_count++] = node;
      } else {
        outside[outside_count++] = node;
      }
    }
    if (!is_even) {
      if (outside_count >= 2)
        std::swap(outside[outside_count - 2], outside[outside_count - 1]);
      else
        std::swap(inside[1], inside[2]);
    }
    // Braces, because they fix the order in which new points are numbered.
    if (inside_count == 1) {
      emit({cut(inside[0], outside[0]), cut(inside[0], outside[1]), cut(inside[0], outside[2])});
    } else if (inside_count == 3) {
      emit({cut(inside[0], outside[0]), cut(inside[1], outside[0]), cut(inside[2], outside[0])});
    } else if (inside_count == 2) {
      const uint32_t quad[4] = {cut(inside[0], outside[0]), cut(inside[0], outside[1]),
                                cut(inside[1], outside[1]), cut(inside[1], outside[0])};
      emit({quad[0], quad[1], quad[2]});
      emit({quad[0], quad[2], quad[3]});
    }
  }

  void emit(const std::array<uint32_t, 3>& corners) { surface_.triangles.push_back(corners); }

  /// The point where the surface cuts the edge between two nodes, shared by all who ask.
  uint32_t cut(uint32_t inside, uint32_t outside) {
    const uint64_t key = uint64_t{inside} << 32 | outside;
    const auto [entry, is_new] =
        cuts_.try_emplace(key, static_cast<uint32_t>(surface_.points.size()));
    if (is_new) {
      const double part = values_[inside] / (values_[inside] - values_[outside]);
      surface_.points.push_back(
          glm::mix(place(inside), place(outside), std::clamp(part, 0.05, 0.95)));
    }
    return entry->second;
  }

  Vec3d lower_;
  double step_;
  uint32_t size_[3];
  std::vector<double> values_;
  std::unordered_map<uint64_t, uint32_t> cuts_;
  Surface surface_;
};

}  // namespace

Surface polygonise(const Field& field, const Vec3d& lower, const Vec3d& upper, double step) {
  return Marcher(field, lower, upper, step).march();
}

void relax(Surface& surface, const Field& field) {
  for (int round = 0; round < 4; ++round) {
    std::vector<Vec3d> sums(surface.points.size(), Vec3d(0.0));
    std::vector<double> counts(surface.points.size(), 0.0);
    for (const auto& corners : surface.triangles) {
      for (int i = 0; i < 3; ++i) {
        sums[corners[i]] += surface.points[corners[(i + 1) % 3]];
        counts[corners[i]] += 1.0;
      }
    }
    for (size_t i = 0; i < sums.size(); ++i) {
      surface.points[i] = glm::mix(surface.points[i], sums[i] / counts[i], 0.5);
    }
  }
  for (Vec3d& point : surface.points) point = project(field, point);
}

Vec3d gradient(const Field& field, const Vec3d& point) {
  const double reach = 1.0 / 4096.0;
  Vec3d result;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d before = point, after = point;
    before[axis] -= reach;
    after[axis] += reach;
    result[axis] = (field(after) - field(before)) / (2.0 * reach);
  }
  return result;
}

Vec3d project(const Field& field, Vec3d point) {
  for (int step = 0; step < 4; ++step) {
    const Vec3d slope = gradient(field, point);
    const double steepness = glm::dot(slope, slope);
    if (steepness == 0.0) break;
    const Vec3d move = field(point) / steepness * slope;
    point -= move;
    if (glm::length(move) < 1e-7 * glm::length(point)) break;
  }
  return point;
}

}  // namespace assets
