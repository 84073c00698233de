// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace tests {

/// Writes an OBJ of a ball with bumps: 4 * rings * (rings - 1) triangles.
inline void write_ball(const std::filesystem::path& path, int rings, double bump = 0.1) {
  std::ofstream file(path);
  const int segments = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      const double theta = std::numbers::pi * ring / rings;
      const double phi = 2 * std::numbers::pi * segment / segments;
      const double radius = 1 + bump * std::sin(7 * theta) * std::cos(5 * phi);
      file << "v " << radius * std::sin(theta) * std::cos(phi) << ' ' << radius * std::cos(theta)
           << ' ' << radius * std::sin(theta) * std::sin(phi) << '\n';
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      const int next = (segment + 1) % segments;
      const int a = ring * segments + segment + 1;
      const int b = ring * segments + next + 1;
      if (ring > 0) file << "f " << a << ' ' << b << ' ' << b + segments << '\n';
      if (ring == rings - 1) continue;
      file << "f " << a << ' ' << b + segments << ' ' << a + segments << '\n';
    }
  }
}

}  // namespace tests
