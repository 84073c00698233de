// SPDX-License-Identifier: MIT
#include "tests/support/test_meshes.h"

#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

namespace tracer {
namespace {

// One index a position, however often it is asked for: closed surfaces share their vertices.
class SharedPositions {
 public:
  uint32_t index_of(const Vec3f& position) {
    const auto [found, is_new] = indices_.try_emplace({position.x, position.y, position.z},
                                                      static_cast<uint32_t>(positions_.size()));
    if (is_new) positions_.push_back(position);
    return found->second;
  }
  std::vector<Vec3f> take() { return std::move(positions_); }

 private:
  std::map<std::tuple<float, float, float>, uint32_t> indices_;
  std::vector<Vec3f> positions_;
};

}  // namespace

Mesh make_test_mesh(const std::vector<Vec3f>& positions, const std::vector<Vec3u>& triangles) {
  return make_test_mesh(std::span(positions), std::span(triangles));
}

Mesh make_test_mesh(std::span<const Vec3f> positions, std::span<const Vec3u> triangles) {
  Mesh mesh;
  mesh.positions.assign(positions.begin(), positions.end());
  mesh.triangles.assign(triangles.begin(), triangles.end());
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) mesh.bounds.extend(mesh.triangle_bounds(i));
  return mesh;
}

Mesh random_soup(uint32_t triangle_count, float size, uint32_t seed) {
  RandomSource random(seed);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t i = 0; i < triangle_count; ++i) {
    const Vec3f center = random.vector(-1, 1);
    for (int corner = 0; corner < 3; ++corner) {
      positions.push_back(center + random.vector(-size, size));
    }
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return make_test_mesh(std::move(positions), std::move(triangles));
}

Mesh rough_ball(int cells_a_side, float roughness, uint32_t seed) {
  SharedPositions shared;
  std::vector<Vec3u> triangles;
  const auto corner = [&](int axis, int side, int i, int j) {
    Vec3f position;
    position[axis] = static_cast<float>(side * cells_a_side);
    position[(axis + 1) % 3] = static_cast<float>(2 * i - cells_a_side);
    position[(axis + 2) % 3] = static_cast<float>(2 * j - cells_a_side);
    return shared.index_of(position);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      for (int i = 0; i < cells_a_side; ++i) {
        for (int j = 0; j < cells_a_side; ++j) {
          const uint32_t quad[] = {corner(axis, side, i, j), corner(axis, side, i + 1, j),
                                   corner(axis, side, i + 1, j + 1), corner(axis, side, i, j + 1)};
          triangles.emplace_back(quad[0], quad[1], quad[2]);
          triangles.emplace_back(quad[0], quad[2], quad[3]);
        }
      }
    }
  }
  std::vector<Vec3f> positions = shared.take();
  RandomSource random(seed);
  for (Vec3f& position : positions) {
    position = glm::normalize(position) * (1 + random.between(-roughness, roughness));
  }
  return make_test_mesh(std::move(positions), std::move(triangles));
}

Mesh lattice_quads(uint32_t quad_count, uint32_t seed) {
  RandomSource random(seed);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t i = 0; i < quad_count; ++i) {
    const int axis = random.integer(0, 2);
    Vec3f along(0), across(0);
    along[(axis + 1) % 3] = across[(axis + 2) % 3] = 1;
    const Vec3f corner = random.lattice(-2, 2);
    for (const Vec3f& offset : {Vec3f(0), along, along + across, across}) {
      positions.push_back(corner + offset);
    }
    triangles.emplace_back(4 * i, 4 * i + 1, 4 * i + 2);
    triangles.emplace_back(4 * i, 4 * i + 2, 4 * i + 3);
  }
  return make_test_mesh(std::move(positions), std::move(triangles));
}

Mesh moved(Mesh mesh, const Vec3f& offset) {
  for (Vec3f& position : mesh.positions) position += offset;
  return make_test_mesh(mesh.positions, mesh.triangles);
}

Mesh repeated(Mesh mesh, int copies) {
  const LargeVector<Vec3u> triangles = mesh.triangles;
  for (int copy = 1; copy < copies; ++copy) {
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  }
  return mesh;
}

Mesh read_plain_obj(const std::string& path) {
  std::ifstream file(path);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword, corner;
    words >> keyword;
    if (keyword == "v") {
      Vec3f position;
      words >> position.x >> position.y >> position.z;
      positions.push_back(position);
    } else if (keyword == "f") {
      Vec3u triangle;
      for (int i = 0; i < 3; ++i) {
        words >> corner;
        triangle[i] = static_cast<uint32_t>(std::stoul(corner)) - 1;
      }
      triangles.push_back(triangle);
    }
  }
  return make_test_mesh(std::move(positions), std::move(triangles));
}

}  // namespace tracer
