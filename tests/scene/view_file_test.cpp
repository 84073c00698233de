// SPDX-License-Identifier: MIT
#include "tracer/scene/view_file.h"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tracer/base/error.h"

namespace tracer {
namespace {

class ViewFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::path(testing::TempDir()) /
            ("view_" + std::to_string(getpid()) + ".view.json");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  View load(const std::string& text) {
    std::ofstream(path_) << text;
    return load_view(path_);
  }
  /// The message without the path before it.
  std::string error_of(const std::string& text) {
    try {
      load(text);
    } catch (const LoadError& error) {
      return std::string(error.what()).substr(path_.string().size());
    }
    return "no error";
  }

  std::filesystem::path path_;
};

TEST_F(ViewFile, numbers_survive_saving_and_loading_bit_for_bit) {
  View view;
  view.camera = {.eye = {1.0 / 3, -1e300, 5e-324},
                 .target = {4194304.123456789, 0.1, -0.0},
                 .up = {0, 0.3, 1},
                 .fov_degrees = 1.0 / 7};
  view.size_px = Vec2i(65535, 1);
  view.sky = Vec3d(0.1, 0, 1e10);
  save_view(path_, view);
  const View loaded = load_view(path_);
  EXPECT_EQ(loaded.camera, view.camera);
  EXPECT_EQ(loaded.size_px, view.size_px);
  EXPECT_EQ(loaded.sky, view.sky);
}

TEST_F(ViewFile, only_eye_and_target_are_required) {
  const View view = load(R"({"eye":[1,2,3],"target":[0,0,0]})");
  EXPECT_EQ(view.camera.eye, Vec3d(1, 2, 3));
  EXPECT_EQ(view.camera.up, Camera{}.up);
  EXPECT_EQ(view.camera.fov_degrees, Camera{}.fov_degrees);
  EXPECT_FALSE(view.size_px);
  EXPECT_FALSE(view.sky);
}

TEST_F(ViewFile, faults_name_the_key_and_what_it_should_be) {
  const std::string start = R"({"eye":[1,2,3],"target":[0,0,0],)";
  EXPECT_EQ(error_of(R"({"target":[0,0,0]})"),
            R"(: "eye" should be three finite numbers, [x,y,z])");
  EXPECT_EQ(error_of(R"({"eye":[0,0],"target":[0,0,0]})"),
            R"(: "eye" should be three finite numbers, [x,y,z])");
  EXPECT_EQ(error_of(R"({"eye":[0,0,0],"target":[0,0,0]})"),
            R"(: "target" should be another point than "eye")");
  EXPECT_EQ(error_of(start + R"("up":[0,0,0]})"), R"(: "up" should be a direction, not zero)");
  for (const char* fov : {"0", "180", "-3", "\"40\"", "null"}) {
    EXPECT_EQ(error_of(start + R"("fov":)" + fov + "}"),
              R"(: "fov" should be degrees above 0 and below 180)");
  }
  for (const char* size : {"[0,5]", "[5,65536]", "[1.5,2]", "[4]", "7", "[-1,4]", "[1e99,1]"}) {
    EXPECT_EQ(error_of(start + R"("size":)" + size + "}"),
              R"(: "size" should be two whole numbers from 1 to 65535, [width,height])");
  }
  EXPECT_EQ(error_of(start + R"("sky":[0,-1,0]})"),
            R"(: "sky" should be three numbers from 0 to 1e30, [r,g,b])");
  EXPECT_NE(error_of(start + R"("sky":[1e39,0,0]})"), "no error");
  EXPECT_EQ(error_of(start + R"("fow":40})"),
            R"(: "fow" is unknown; keys are eye, target, up, fov, size, sky)");
  EXPECT_EQ(error_of("[1,2]"), R"(: a view is an object, {"eye":[x,y,z],"target":[x,y,z],...})");
}

TEST_F(ViewFile, text_that_is_not_json_is_told_with_its_line) {
  EXPECT_EQ(error_of("{\n\"eye\":[1,2,3],\n\"target\" [0]\n}"), ":3: this is not JSON");
  EXPECT_EQ(error_of("{\"eye\":[1e999,0,0],\"target\":[0,0,0]}"), ": a number is too large");
  EXPECT_NE(error_of(""), "no error");
  EXPECT_NE(error_of("\xff\xfe"), "no error");
  EXPECT_THROW(load_view("/nowhere/at/all.json"), LoadError);
}

TEST_F(ViewFile, lies_beside_its_model) {
  EXPECT_EQ(view_path_of("models/cow.obj"), "models/cow.view.json");
  EXPECT_EQ(view_path_of("a.b.obj"), "a.b.view.json");
}

}  // namespace
}  // namespace tracer
