// SPDX-License-Identifier: MIT
// A tree never changes a picture, and neither does the number of threads.
#include <gtest/gtest.h>

#include "tests/support/run_program.h"
#include "tracer/bvh/build.h"

namespace tests {
namespace {

// The bytes of one small picture.
std::string picture_of(const std::string& model, const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  const std::string output = folder / "picture.pfm";
  std::vector<std::string> arguments{"render", model,    "-o",    output,   "--spp",
                                     "1",      "--size", "20x14", "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult result = run_boxwood(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return read_file(output);
}

void expect_one_picture(const std::string& model) {
  if (!std::filesystem::exists(model)) GTEST_SKIP() << model << " is missing";
  const std::string brute_force = picture_of(model, {"--bvh", "off"});
  ASSERT_FALSE(brute_force.empty());
  for (const char* threads : {"1", "2", "7"}) {
    EXPECT_EQ(picture_of(model, {"--bvh", "off", "--threads", threads}), brute_force) << threads;
    for (const tracer::Builder& builder : tracer::builders()) {
      for (const char* depth : {"1", "5", "30"}) {
        for (const char* leaf_size : {"1", "4", "64"}) {
          EXPECT_EQ(picture_of(model, {"--bvh", std::string(builder.name), "--max-depth", depth,
                                       "--leaf-size", leaf_size, "--threads", threads}),
                    brute_force)
              << builder.name << ' ' << depth << ' ' << leaf_size << ' ' << threads;
        }
      }
    }
  }
}

TEST(BitIdentity, no_tree_and_no_number_of_threads_changes_our_cow) {
  expect_one_picture(BOXWOOD_SOURCE_DIR "/assets/cow.obj");
}

TEST(BitIdentity, no_tree_and_no_number_of_threads_changes_the_classic_cow) {
  expect_one_picture(BOXWOOD_SHARED_DIR "/models/cow.obj");
}

}  // namespace
}  // namespace tests
