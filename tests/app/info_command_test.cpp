// SPDX-License-Identifier: MIT
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/cube_obj.h"
#include "tests/support/run_program.h"
#include "tracer/bvh/build.h"

namespace tests {
namespace {

using Json = nlohmann::json;

class InfoCommand : public testing::Test {
 protected:
  Json info_of(const std::string& obj) const {
    write_file(model_, obj);
    const ProgramResult result = run_boxwood({"info", model_, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return Json::parse(result.out);
  }

  TemporaryFolder folder_;
  std::string model_ = folder_ / "model.obj";
};

TEST_F(InfoCommand, counts_what_is_in_the_file) {
  const Json info = info_of(cube_obj);
  EXPECT_EQ(info["file"], "model.obj");
  EXPECT_EQ(info["triangles"], 12);
  EXPECT_EQ(info["vertices"], 8);
  EXPECT_EQ(info["faces"], 6);
  EXPECT_EQ(info["objects"], 1);
  EXPECT_EQ(info["groups"], 0);
  EXPECT_EQ(info["normals"], false);
  EXPECT_EQ(info["texture_coordinates"], false);
  EXPECT_EQ(info["colors"], false);
  EXPECT_EQ(info["dropped_faces"], 0);
  EXPECT_EQ(info["warnings"]["count"], 0);
}

TEST_F(InfoCommand, bounds_are_in_world_coordinates_far_from_the_origin_too) {
  const Json info =
      info_of("v 4500000.25 600000 10\nv 4500001.25 600000 10\nv 4500000.25 600002 10\nf 1 2 3\n");
  EXPECT_EQ(info["bounds"]["min"], Json::array({4500000.25, 600000.0, 10.0}));
  EXPECT_EQ(info["bounds"]["max"], Json::array({4500001.25, 600002.0, 10.0}));
}

TEST_F(InfoCommand, tells_used_materials_from_unused_ones) {
  write_file(folder_ / "model.mtl",
             "newmtl red\nKd 1 0 0\nnewmtl lamp\nKe 5 5 5\nnewmtl spare\nKd 0 0 1\n");
  const Json info = info_of(
      "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
      "usemtl red\nf 1 2 3\nusemtl lamp\nf 1 3 2\nf 3 2 1\n");
  EXPECT_EQ(info["lights"], 2);
  std::map<std::string, Json> materials;
  for (const Json& material : info["materials"]) materials[material["name"]] = material;
  EXPECT_EQ(materials["red"]["triangles"], 1);
  EXPECT_EQ(materials["lamp"]["triangles"], 2);
  EXPECT_EQ(materials["lamp"]["used"], true);
  EXPECT_TRUE(!materials.contains("spare") || materials["spare"]["used"] == false);
}

TEST_F(InfoCommand, faults_are_counted_and_named_by_line) {
  const Json info = info_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n");
  EXPECT_EQ(info["triangles"], 1);
  EXPECT_EQ(info["dropped_faces"], 1);
  EXPECT_EQ(info["warnings"]["count"], 1);
  EXPECT_NE(info["warnings"]["messages"][0].get<std::string>().find("model.obj:5: "),
            std::string::npos);
}

TEST_F(InfoCommand, measures_the_tree_of_the_default_builder) {
  const Json trees = info_of(cube_obj)["trees"];
  ASSERT_EQ(trees.size(), 1u);
  const Json& tree = trees[0];
  EXPECT_EQ(tree["builder"], tracer::builders().front().name);
  EXPECT_EQ(tree["nodes"].get<int>(), 2 * tree["leaves"].get<int>() - 1);
  EXPECT_GE(tree["references"], 12);
  EXPECT_EQ(tree["leaves_at_depth"].size(), tree["depth"].get<size_t>() + 1);
  EXPECT_GT(tree["sah_cost"], 1);
  EXPECT_EQ(tree["sah_traversal_cost"], 1);
  EXPECT_EQ(tree["epo_sampled_triangles"], 0);
  EXPECT_GE(tree["epo"], 0);
  EXPECT_GT(tree["lcv"], 0);
  EXPECT_GT(tree["mrays_per_second"], 0);
}

TEST_F(InfoCommand, compares_all_builders_one_or_none) {
  write_file(model_, cube_obj);
  const auto trees_of = [&](const std::string& name) {
    const ProgramResult result = run_boxwood({"info", model_, "--json", "--bvh", name});
    return Json::parse(result.out)["trees"];
  };
  EXPECT_EQ(trees_of("off"), Json::array());
  EXPECT_EQ(trees_of("all").size(), tracer::builders().size());
  for (const tracer::Builder& builder : tracer::builders()) {
    const Json trees = trees_of(std::string(builder.name));
    ASSERT_EQ(trees.size(), 1u);
    EXPECT_EQ(trees[0]["builder"], builder.name);
  }
  const ProgramResult table = run_boxwood({"info", model_, "--bvh", "all"});
  for (const tracer::Builder& builder : tracer::builders()) {
    EXPECT_NE(table.out.find(' ' + std::string(builder.name)), std::string::npos) << table.out;
  }
  const ProgramResult refused = run_boxwood({"info", model_, "--bvh", "oak"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("'oak' is none of"), std::string::npos) << refused.err;
}

TEST_F(InfoCommand, trees_obey_the_settings) {
  write_file(model_, cube_obj);
  const ProgramResult result = run_boxwood({"info", model_, "--json", "--leaf-size", "12"});
  const Json tree = Json::parse(result.out)["trees"][0];
  EXPECT_EQ(tree["nodes"], 1);
  EXPECT_EQ(tree["largest_leaf"], 12);
  EXPECT_EQ(tree["epo"], 0);
  EXPECT_EQ(tree["lcv"], 0);
}

TEST_F(InfoCommand, a_single_triangle_overlaps_nothing) {
  const Json tree = info_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")["trees"][0];
  EXPECT_EQ(tree["sah_cost"], 1);
  EXPECT_EQ(tree["epo"], 0);
  EXPECT_EQ(tree["lcv"], 0);
}

TEST_F(InfoCommand, the_table_says_the_same_and_warnings_go_to_stderr) {
  write_file(model_, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 0 1 2\n");
  const ProgramResult result = run_boxwood({"info", model_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("triangles      1\n"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("model.obj:5: "), std::string::npos) << result.err;
}

TEST_F(InfoCommand, warnings_stop_at_ten_and_are_counted_in_all) {
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (int i = 0; i < 25; ++i) obj += "f 1 2 77\n";
  write_file(model_, obj);
  const ProgramResult result = run_boxwood({"info", model_});
  EXPECT_NE(result.err.find("model.obj:14: "), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("model.obj:15: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("25 warnings"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace tests
