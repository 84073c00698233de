// SPDX-License-Identifier: MIT
#include "tests/support/large_meshes.h"

#include <utility>

#include "tests/support/test_meshes.h"
#include "tracer/base/trigonometry.h"

namespace tracer {
namespace {

/// A sheet of (cells_a_side + 1)^2 positions, two triangles a cell.
struct Sheets {
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;

  template <class F>
  void add(int cells_a_side, const F& position_at) {
    const auto first = static_cast<uint32_t>(positions.size());
    const auto row = static_cast<uint32_t>(cells_a_side) + 1;
    for (int j = 0; j <= cells_a_side; ++j) {
      for (int i = 0; i <= cells_a_side; ++i) positions.push_back(position_at(i, j));
    }
    for (uint32_t j = 0; j + 1 < row; ++j) {
      for (uint32_t i = 0; i + 1 < row; ++i) {
        const uint32_t corner = first + j * row + i;
        triangles.emplace_back(corner, corner + 1, corner + row + 1);
        triangles.emplace_back(corner, corner + row + 1, corner + row);
      }
    }
  }
  Mesh take() { return make_test_mesh(std::move(positions), std::move(triangles)); }
};

double wave(double turns) {
  return cos_sin_of_turns(turns).sin;
}

double bumpy_radius(const Vec3d& direction) {
  return 1 + 0.04 * wave(1.5 * direction.x + 0.7 * direction.y) +
         0.04 * wave(2.1 * direction.z - 1.2 * direction.x) + 0.02 * wave(4 * direction.y);
}

// Each face from a cube's own coordinates: positions on edges are the same from both sides.
void add_bumpy_sphere(Sheets& sheets, int cells_a_side, double radius, const Vec3d& center) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      sheets.add(cells_a_side, [&](int i, int j) {
        Vec3d cube;
        cube[axis] = side * cells_a_side;
        cube[(axis + 1) % 3] = side * (2 * i - cells_a_side);
        cube[(axis + 2) % 3] = 2 * j - cells_a_side;
        const Vec3d direction = glm::normalize(cube);
        return Vec3f(center + radius * bumpy_radius(direction) * direction);
      });
    }
  }
}

Vec3f random_direction(RandomSource& random) {
  for (;;) {
    const Vec3f vector = random.vector(-1, 1);
    const float length = glm::length(vector);
    if (length > 0.1f && length < 1) return vector / length;
  }
}

float lattice_height(int x, int z, uint32_t seed) {
  return to_unit_float(
      hash_words({static_cast<uint32_t>(x), static_cast<uint32_t>(z), seed, 1u}).x);
}

// Heights at a lattice's corners, smoothly joined.
double smooth_height(double x, double z, uint32_t seed) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(z);
  const double u = (x - column) * (x - column) * (3 - 2 * (x - column));
  const double v = (z - row) * (z - row) * (3 - 2 * (z - row));
  const double near =
      (1 - u) * lattice_height(column, row, seed) + u * lattice_height(column + 1, row, seed);
  const double far = (1 - u) * lattice_height(column, row + 1, seed) +
                     u * lattice_height(column + 1, row + 1, seed);
  return (1 - v) * near + v * far;
}

}  // namespace

Mesh bumpy_sphere(int cells_a_side) {
  Sheets sheets;
  add_bumpy_sphere(sheets, cells_a_side, 1, Vec3d(0));
  return sheets.take();
}

Mesh hair(uint32_t triangle_count, uint32_t seed) {
  constexpr float length = 0.15f;
  constexpr float width = 0.001f;
  RandomSource random(seed);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t i = 0; i < triangle_count; ++i) {
    const Vec3f root = random.vector(-1, 1);
    const Vec3f tip = root + length * random_direction(random);
    positions.insert(positions.end(), {root, tip, root + width * random_direction(random)});
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return make_test_mesh(std::move(positions), std::move(triangles));
}

Mesh stadium(int ball_cells) {
  constexpr double ball_radius = 0.45;  // with its bumps, a size of 1
  constexpr double floor_side = 10000;
  constexpr int floor_cells = 4;
  constexpr int bowl_cells = 24;
  constexpr double bowl_height = 2500;
  Sheets sheets;
  add_bumpy_sphere(sheets, ball_cells, ball_radius, Vec3d(0, 0.5, 0));
  sheets.add(floor_cells, [&](int i, int j) {
    const Vec2d part = Vec2d(i, j) / static_cast<double>(floor_cells) - 0.5;
    return Vec3f(floor_side * Vec3d(part.x, 0, part.y));
  });
  sheets.add(bowl_cells, [&](int i, int j) {
    const CosSin angle = cos_sin_of_turns(static_cast<double>(i % bowl_cells) / bowl_cells);
    const double height = static_cast<double>(j) / bowl_cells;
    const double radius = floor_side * (0.5 + 0.25 * std::sqrt(height));
    return Vec3f(radius * angle.cos, bowl_height * height, radius * angle.sin);
  });
  return sheets.take();
}

Mesh terrain(int cells_a_side, uint32_t seed) {
  Sheets sheets;
  sheets.add(cells_a_side, [&](int i, int j) {
    const Vec2d place = Vec2d(i, j) / static_cast<double>(cells_a_side);
    double height = 0;
    double scale = 4;
    for (uint32_t octave = 0; octave < 9; ++octave, scale *= 2) {
      height += smooth_height(scale * place.x, scale * place.y, seed + octave) / scale;
    }
    return Vec3f(2 * place.x - 1, height, 2 * place.y - 1);
  });
  return sheets.take();
}

}  // namespace tracer
