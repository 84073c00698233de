// SPDX-License-Identifier: MIT
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/assets/obj_faces.h"

namespace tracer {
namespace {

class Cornell : public testing::Test {
 protected:
  const ObjFaces box = read_obj_faces(BOXWOOD_SOURCE_DIR "/assets/cornell.obj");

  Vector centre(const std::vector<size_t>& corners) const {
    Vector sum{};
    for (const size_t corner : corners) sum = sum + box.positions[corner];
    return (1.0 / static_cast<double>(corners.size())) * sum;
  }
};

bool is_block(const ObjFace& face) {
  return face.group.ends_with("block");
}

TEST_F(Cornell, has_the_room_the_light_and_two_blocks) {
  std::map<std::string, size_t> triangle_counts;
  for (const ObjFace& face : box.faces) triangle_counts[face.group] += face.corners.size() - 2;
  EXPECT_EQ(triangle_counts, (std::map<std::string, size_t>{{"floor", 2},
                                                            {"ceiling", 8},
                                                            {"back_wall", 2},
                                                            {"right_wall", 2},
                                                            {"left_wall", 2},
                                                            {"light", 2},
                                                            {"short_block", 10},
                                                            {"tall_block", 10}}));
  EXPECT_EQ(box.positions.size(), 28u);
}

TEST_F(Cornell, is_open_at_the_front_and_under_the_blocks_only) {
  const std::map<Edge, int> edges = directed_edges(box);
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 1);
  const std::map<size_t, size_t> open = boundary(edges);
  EXPECT_EQ(loop_lengths(open), (std::vector<size_t>{4, 4, 4}));
  for (const auto& [from, to] : open) {
    const Vector &a = box.positions[from], &b = box.positions[to];
    EXPECT_TRUE((a[2] == 0 && b[2] == 0) || (a[1] == 0 && b[1] == 0)) << from << ' ' << to;
  }
}

TEST_F(Cornell, shows_the_front_of_the_walls_inside_and_of_the_blocks_outside) {
  std::map<std::string, std::vector<size_t>> block_corners;
  for (const ObjFace& face : box.faces) {
    auto& corners = block_corners[face.group];
    corners.insert(corners.end(), face.corners.begin(), face.corners.end());
  }
  const Vector room_centre{278, 274, 280};
  for (const ObjFace& face : box.faces) {
    const Vector inside = is_block(face) ? centre(block_corners[face.group]) : room_centre;
    const double side = dot(area_vector(box, face), inside - centre(face.corners));
    EXPECT_GT(is_block(face) ? -side : side, 0) << face.group;
  }
}

TEST_F(Cornell, has_flat_faces) {
  for (const ObjFace& face : box.faces) {
    const Vector normal = area_vector(box, face);
    for (const size_t corner : face.corners) {
      const double distance =
          dot(normal, box.positions[corner] - box.positions[face.corners[0]]) / length(normal);
      EXPECT_LT(std::abs(distance), 1e-9) << face.group;
    }
  }
}

TEST_F(Cornell, defines_each_material_it_uses) {
  std::ifstream file(BOXWOOD_SOURCE_DIR "/assets/cornell.mtl");
  std::set<std::string> defined, used;
  for (std::string keyword, name; file >> keyword;) {
    if (keyword == "newmtl" && file >> name) defined.insert(name);
  }
  for (const ObjFace& face : box.faces) used.insert(face.material);
  EXPECT_EQ(defined, used);
}

// A 35 mm lens before a film of 25 mm.
TEST_F(Cornell, view_is_that_of_the_measured_camera) {
  const auto view =
      nlohmann::json::parse(std::ifstream(BOXWOOD_SOURCE_DIR "/assets/cornell.view.json"));
  EXPECT_EQ(view.at("eye"), (nlohmann::json{278, 273, -800}));
  EXPECT_EQ(view.at("up"), (nlohmann::json{0, 1, 0}));
  EXPECT_EQ(view.at("sky"), (nlohmann::json{0, 0, 0}));
  const Vector along = view.at("target").get<Vector>() - view.at("eye").get<Vector>();
  EXPECT_EQ((1 / length(along)) * along, (Vector{0, 0, 1}));
  const double fov = 2 * std::atan(0.0125 / 0.035) * 180 / std::numbers::pi;
  EXPECT_NEAR(view.at("fov").get<double>(), fov, 1e-4);
}

}  // namespace
}  // namespace tracer
