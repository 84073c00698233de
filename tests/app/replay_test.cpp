// SPDX-License-Identifier: MIT
// The command that replays a sample, run as a user runs it.
#include "app/replay.h"

#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/cube_obj.h"
#include "tests/support/read_pfm.h"
#include "tests/support/run_program.h"

namespace tests {
namespace {

const app::ResolvedView view{.camera = {.eye = {1.0 / 3, 2.1, 4.7},
                                        .target = {-0.1, 0, 1e-7},
                                        .up = {0.1, 1, 0},
                                        .fov_degrees = 33.3},
                             .size_px = {16, 12},
                             .sky = {0.1, 1.0 / 7, 3},
                             .environment = {.file = {}, .sun = {{100.0 / 3, -70.1}}}};
const tracer::Integrator& path = *tracer::find_integrator("path");

TEST(Replay, of_a_sample_has_the_radiance_of_the_picture) {
  const TemporaryFolder folder;
  const std::string model = folder / "my cube.obj";
  write_file(model, cube_obj);
  const std::string picture = folder / "cube.pfm";
  // All that the command says of a picture, in place of what it says of a sample.
  std::vector<std::string> arguments =
      app::replay_arguments(model, view, path, {.seed = 7}, {{0, 0}, 0});
  std::erase_if(arguments, [](const std::string& argument) {
    return argument.starts_with("--pixel") || argument.starts_with("--sample");
  });
  arguments.insert(arguments.end(), {"--spp", "1", "-o", picture});
  ASSERT_EQ(run_boxwood(arguments).exit_code, 0);
  const Pfm pixels = read_pfm(picture);
  for (const tracer::Vec2i pixel : {tracer::Vec2i(8, 6), {0, 0}, {15, 11}, {6, 8}}) {
    const ProgramResult replayed =
        run_boxwood(app::replay_arguments(model, view, path, {.seed = 7}, {pixel, 0}));
    ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
    std::istringstream last_line(replayed.out.substr(replayed.out.rfind("radiance ") + 9));
    tracer::Vec3d radiance;
    last_line >> radiance.x >> radiance.y >> radiance.z;
    EXPECT_LE(tracer::max_abs(radiance - tracer::Vec3d(pixels.at(pixel.x, pixel.y))),
              1e-6 * tracer::max_abs(radiance))
        << pixel.x << ' ' << pixel.y;
  }
}

TEST(Replay, commands_are_quoted_for_a_shell) {
  EXPECT_EQ(app::replay_command({"render", "cow.obj", "--pixel=1,2"}),
            "boxwood render cow.obj --pixel=1,2");
  EXPECT_EQ(app::replay_command({"a b", "it's", "$x"}), "boxwood 'a b' 'it'\\''s' '$x'");
}

TEST(Replay, dropped_samples_are_counted_in_words) {
  EXPECT_EQ(app::count_of_dropped(1), "1 sample was not finite and counts as black");
  EXPECT_EQ(app::count_of_dropped(2), "2 samples were not finite and count as black");
}

}  // namespace
}  // namespace tests
