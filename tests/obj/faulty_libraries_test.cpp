// SPDX-License-Identifier: MIT
// Material libraries and textures that are missing, or that lie where a model may not reach.
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/obj/faulty_file.h"

namespace tests {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";

class FaultyLibraries : public testing::Test {
 protected:
  /// A model in a folder of its own, beside which secrets lie.
  void expect_warning(const std::string& statements, const std::string& mtl,
                      const std::string& place, const std::string& reason) {
    if (!mtl.empty()) folder_.write("models/model.mtl", mtl);
    const std::string path =
        folder_.write("models/model.obj", statements + triangle + "f 1/1 2/2 3/3\n");
    const Loading loading = load(path);
    ASSERT_TRUE(loading.scene) << loading.error;
    EXPECT_EQ(loading.scene->scene.mesh->triangle_count(), 1u);
    ASSERT_GE(loading.scene->warnings.count(), 1) << statements;
    const std::string text = loading.scene->warnings.messages().front().text();
    EXPECT_NE(text.find(place), text.npos) << text;
    EXPECT_NE(text.find(reason), text.npos) << text;
    for (const auto& file : loading.scene->files) {
      const auto relative = file.lexically_normal().lexically_relative(folder_.path() / "models");
      EXPECT_NE(relative.begin()->string(), "..") << file << " is out of the folder";
    }
    const ProgramResult result = run_boxwood({"info", path, "--bvh", "off"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.err.find(place), result.err.npos) << result.err;
  }

  TemporaryFolder folder_;
};

TEST_F(FaultyLibraries, a_missing_library_is_said_and_the_model_is_shown) {
  expect_warning("mtllib nowhere.mtl\n", "", "model.obj:1: ", "nowhere.mtl");
}

TEST_F(FaultyLibraries, a_material_in_no_library_is_said) {
  expect_warning("mtllib model.mtl\nusemtl red\n", "newmtl blue\n", "model.obj:2: ", "red");
}

TEST_F(FaultyLibraries, a_library_out_of_the_folder_is_not_read) {
  folder_.write("secret.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string absolute = (folder_.path() / "secret.mtl").string();
  for (const std::string& written :
       {std::string("../secret.mtl"), std::string("x/../../secret.mtl"), absolute,
        std::string("..\\secret.mtl"), std::string("C:\\secret.mtl"), std::string("/dev/zero")}) {
    expect_warning("mtllib " + written + '\n', "", "model.obj:1: ", "refused");
  }
}

TEST_F(FaultyLibraries, a_texture_out_of_the_folder_is_not_read) {
  folder_.write("secret.png", "not to be read");
  const std::string absolute = (folder_.path() / "secret.png").string();
  for (const std::string& written :
       {std::string("../secret.png"), std::string("x/../../secret.png"), absolute,
        std::string("..\\secret.png"), std::string("/dev/zero")}) {
    expect_warning("mtllib model.mtl\nusemtl red\n", "newmtl red\nmap_Kd " + written + '\n',
                   "model.mtl:2: ", "refused");
  }
}

TEST_F(FaultyLibraries, a_missing_or_broken_texture_is_said) {
  folder_.write("models/broken.png", "\x89PNG\r\n\x1a\nand no more");
  folder_.write("models/empty.png", "");
  std::filesystem::create_directories(folder_.path() / "models/folder.png");
  for (const char* written : {"missing.png", "broken.png", "empty.png", "folder.png"}) {
    expect_warning("mtllib model.mtl\nusemtl red\n",
                   std::string("newmtl red\nmap_Kd ") + written + '\n', "model.mtl:2: ", written);
  }
}

TEST_F(FaultyLibraries, a_library_that_is_a_folder_or_a_pipe_is_said) {
  std::filesystem::create_directories(folder_.path() / "models/folder.mtl");
  ASSERT_EQ(mkfifo((folder_.path() / "models/pipe.mtl").c_str(), 0600), 0);
  expect_warning("mtllib folder.mtl\n", "", "model.obj:1: ", "directory");
  expect_warning("mtllib pipe.mtl\n", "", "model.obj:1: ", "not a regular file");
}

TEST_F(FaultyLibraries, a_library_of_random_or_zero_bytes_does_no_harm) {
  std::string bytes = "newmtl red\n";
  for (int i = 0; i < 100000; ++i) bytes += static_cast<char>(i * 7919 >> 3);
  folder_.write("models/noise.mtl", bytes);
  folder_.write("models/zeros.mtl", std::string(1 << 20, '\0'));
  const std::string path = folder_.write(
      "models/model.obj", "mtllib noise.mtl\nmtllib zeros.mtl\n" + triangle + "f 1 2 3\n");
  const Loading loading = load(path);
  ASSERT_TRUE(loading.scene) << loading.error;
  EXPECT_EQ(loading.scene->scene.mesh->triangle_count(), 1u);
}

}  // namespace
}  // namespace tests
