// SPDX-License-Identifier: MIT
// `boxwood render`, run as a user runs it.
#include <algorithm>
#include <csignal>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/cube_obj.h"
#include "tests/support/read_pfm.h"
#include "tests/support/run_program.h"
#include "tests/support/test_ball.h"
#include "tracer/bvh/build.h"
#include "tracer/render/integrator.h"

namespace tests {
namespace {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

constexpr const char* endless = "100000000";  // samples

class RenderCommand : public testing::Test {
 protected:
  RenderCommand() { write_file(model_, cube_obj); }

  Arguments with_defaults(const std::string& output, const Arguments& more) const {
    Arguments arguments{"render", model_, "-o", output};
    if (std::find(more.begin(), more.end(), "--size") == more.end()) {
      arguments.insert(arguments.end(), {"--size", "16x12"});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  // A picture of the cube with these options, the file's bytes.
  std::string render(const Arguments& more, const std::string& name = "cube.pfm") const {
    const ProgramResult result = run_boxwood(with_defaults(folder_ / name, more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_file(folder_ / name);
  }

  Json stats_of(const Arguments& more) const {
    Arguments arguments = more;
    arguments.insert(arguments.end(), {"--stats", folder_ / "stats.json"});
    render(arguments);
    return Json::parse(read_file(folder_ / "stats.json"));
  }

  TemporaryFolder folder_;
  std::string model_ = folder_ / "cube.obj";
};

TEST_F(RenderCommand, every_format_is_the_same_bytes_at_a_second_run) {
  for (const char* name : {"cube.png", "cube.exr", "cube.pfm"}) {
    const std::string first = render({"--spp", "2"}, name);
    EXPECT_FALSE(first.empty()) << name;
    EXPECT_EQ(render({"--spp", "2"}, name), first) << name;
    EXPECT_EQ(first.find(folder_.path().string()), std::string::npos) << name;
  }
}

TEST_F(RenderCommand, improve_rounds_lower_the_cost_and_keep_the_bits) {
  write_ball(model_, 24);
  const Arguments built{"--spp", "2", "--bvh", "median"};
  const Arguments improved{"--spp", "2", "--bvh", "median", "--improve-rounds", "3"};
  EXPECT_EQ(render(improved), render(built));
  const auto cost_of = [this](const Arguments& arguments) {
    return stats_of(arguments).at("sah_cost").get<double>();
  };
  EXPECT_LT(cost_of(improved), cost_of(built));
}

TEST_F(RenderCommand, layers_without_a_name_a_picture_or_a_format_that_holds_them_are_refused) {
  const auto error_of = [](const Arguments& arguments) {
    const ProgramResult result = run_boxwood(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    return result.err;
  };
  const auto is_said = [](const std::string& error, const char* text) {
    return error.find(text) != std::string::npos;
  };
  const std::string unknown = error_of(with_defaults(folder_ / "x.exr", {"--aov", "depth,death"}));
  EXPECT_TRUE(is_said(unknown, "death") && is_said(unknown, "albedo")) << unknown;
  const std::string flat = error_of(with_defaults(folder_ / "x.png", {"--aov", "depth"}));
  EXPECT_TRUE(is_said(flat, "cannot hold layers") && is_said(flat, "x.exr")) << flat;
  const std::string nowhere =
      error_of({"render", model_, "--aov", "all", "--stats", folder_ / "stats.json"});
  EXPECT_TRUE(is_said(nowhere, "-o FILE.exr")) << nowhere;
}

TEST_F(RenderCommand, png_and_exr_carry_how_they_were_made) {
  for (const char* name : {"cube.png", "cube.exr"}) {
    const std::string bytes = render({"--spp", "3", "--seed", "41"}, name);
    for (const char* text : {"boxwood " BOXWOOD_VERSION, "cube.obj", "path", "Seed", "41"}) {
      EXPECT_NE(bytes.find(text), std::string::npos) << name << ' ' << text;
    }
  }
}

TEST_F(RenderCommand, a_clamped_picture_says_that_it_is_biased) {
  for (const char* name : {"cube.png", "cube.exr"}) {
    EXPECT_NE(render({"--spp", "1", "--clamp", "2.5"}, name).find("indirect light to 2.5: biased"),
              std::string::npos);
    EXPECT_EQ(render({"--spp", "1"}, name).find("biased"), std::string::npos);
  }
  EXPECT_EQ(stats_of({"--spp", "1", "--clamp", "2.5"}).at("settings").at("clamp"), 2.5);
  EXPECT_EQ(stats_of({"--spp", "1"}).at("settings").at("clamp"), 0);
}

TEST_F(RenderCommand, a_sun_and_a_map_light_the_picture_and_the_report_names_them) {
  const std::string base = render({"--spp", "2"});
  const std::string sunny = render({"--spp", "2", "--sun", "30,40"});
  EXPECT_NE(sunny, base);
  EXPECT_NE(render({"--spp", "2", "--sun", "30,140"}), sunny);
  EXPECT_NE(render({"--spp", "2", "--sun", "30,40", "--sky-rotation", "50"}), sunny);
  EXPECT_EQ(render({"--spp", "2", "--sun", "30,40", "--threads", "3"}), sunny);
  EXPECT_EQ(stats_of({"--spp", "1", "--sun", "30,40"}).at("settings").at("sun"), Json({30, 40}));

  std::string map = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) map += std::string("\x80\x40\x00\x82", 4);
  write_file(folder_ / "sky.hdr", map);
  const std::string mapped = render({"--spp", "2", "--environment", folder_ / "sky.hdr"});
  EXPECT_NE(mapped, base);
  EXPECT_NE(render({"--spp", "2", "--environment", folder_ / "sky.hdr", "--sky-strength", "2"}),
            mapped);
  EXPECT_EQ(stats_of({"--spp", "1", "--environment", folder_ / "sky.hdr"})
                .at("settings")
                .at("environment"),
            "sky.hdr");
}

TEST_F(RenderCommand, an_environment_that_cannot_be_read_is_one_line_and_no_picture) {
  write_file(folder_ / "broken.hdr", "no picture at all");
  for (const std::string& file : {folder_ / "missing.hdr", folder_ / "broken.hdr"}) {
    const ProgramResult result =
        run_boxwood(with_defaults(folder_ / "none.pfm", {"--environment", file}));
    EXPECT_NE(result.exit_code, 0);
    EXPECT_NE(result.err.find(file), std::string::npos);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none.pfm"));
  }
}

TEST_F(RenderCommand, options_of_the_picture_change_it) {
  const std::string base = render({"--spp", "2"});
  EXPECT_NE(render({"--spp", "3"}), base);
  EXPECT_NE(render({"--spp", "2", "--seed", "5"}), base);
  EXPECT_NE(render({"--spp", "2", "--sampler", "independent"}), base);
  EXPECT_NE(render({"--spp", "2", "--bounces", "0"}), base);
  EXPECT_NE(render({"--spp", "2", "--sky", "0.5,0.6,0.7"}), base);
  EXPECT_NE(render({"--spp", "2", "--eye", "4,3,2"}), base);
  EXPECT_NE(render({"--spp", "2", "--target", "0.5,0,0"}), base);
  EXPECT_NE(render({"--spp", "2", "--up", "1,1,0"}), base);
  EXPECT_NE(render({"--spp", "2", "--fov", "20"}), base);
  EXPECT_EQ(render({"--spp", "2", "--exposure", "3"}), base) << "a pfm holds radiance";
}

TEST_F(RenderCommand, exposure_changes_what_a_png_shows) {
  EXPECT_NE(render({"--spp", "1", "--exposure", "-2"}, "dark.png"),
            render({"--spp", "1"}, "bright.png"));
}

TEST_F(RenderCommand, every_integrator_makes_a_picture_of_its_own) {
  std::vector<std::string> pictures;
  for (const tracer::Integrator& integrator : tracer::integrators()) {
    const std::string picture =
        render({"--spp", "1", "--integrator", std::string(integrator.name), "--sky", "2,2,2"});
    EXPECT_EQ(std::count(pictures.begin(), pictures.end(), picture), 0) << integrator.name;
    pictures.push_back(picture);
  }
}

TEST_F(RenderCommand, a_view_file_beside_the_model_is_picked_up) {
  const std::string framed = render({"--spp", "1"});
  const std::string view = R"({"eye":[5,1,0],"target":[0,0,0],"fov":30,"size":[20,10]})";
  write_file(folder_ / "front.json", view);
  const std::string named = render({"--spp", "1", "--view", folder_ / "front.json"});
  EXPECT_NE(named, framed);
  write_file(folder_ / "cube.view.json", view);
  EXPECT_EQ(render({"--spp", "1"}), named);
}

TEST_F(RenderCommand, size_and_sky_come_from_the_view_file_until_an_option_says_otherwise) {
  write_file(folder_ / "cube.view.json",
             R"({"eye":[5,1,0],"target":[0,0,0],"size":[20,10],"sky":[0,0.25,4]})");
  const std::string output = folder_ / "cube.pfm";
  ASSERT_EQ(run_boxwood({"render", model_, "-o", output, "--spp", "1"}).exit_code, 0);
  const Pfm picture = read_pfm(output);
  EXPECT_EQ(picture.size_px, tracer::Vec2i(20, 10));
  EXPECT_EQ(picture.at(0, 0), tracer::Vec3f(0, 0.25f, 4));
  render({"--spp", "1", "--sky", "1,2,3"});
  EXPECT_EQ(read_pfm(output).size_px, tracer::Vec2i(16, 12));
  EXPECT_EQ(read_pfm(output).at(0, 0), tracer::Vec3f(1, 2, 3));
}

TEST_F(RenderCommand, one_part_of_a_view_can_be_replaced) {
  write_file(folder_ / "cube.view.json", R"({"eye":[5,1,0],"target":[0,0,0],"fov":30})");
  const std::string moved = render({"--spp", "1", "--eye", "0,1,5"});
  std::filesystem::remove(folder_ / "cube.view.json");
  EXPECT_EQ(
      render({"--spp", "1", "--eye", "0,1,5", "--target", "0,0,0", "--up", "0,1,0", "--fov", "30"}),
      moved);
}

TEST_F(RenderCommand, stats_hold_counts_times_and_the_settings_used) {
  const Json stats = stats_of({"--spp", "3", "--leaf-size", "1", "--threads", "2"});
  EXPECT_EQ(stats["model"], "cube.obj");
  EXPECT_EQ(stats["triangles"], 12);
  EXPECT_EQ(stats["vertices"], 8);
  EXPECT_GT(stats["nodes"], 1);
  EXPECT_GT(stats["leaves"], 1);
  EXPECT_GT(stats["depth"], 0);
  EXPECT_EQ(stats["leaves_at_depth"].size(), stats["depth"].get<size_t>() + 1);
  EXPECT_EQ(stats["leaves_of_size"].size(), stats["largest_leaf"].get<size_t>() + 1);
  EXPECT_GT(stats["sah_cost"], 1);
  EXPECT_GT(stats["epo"], 0);
  EXPECT_GE(stats["lcv"], 0);
  EXPECT_EQ(stats["samples"], 3 * 16 * 12);
  EXPECT_EQ(stats["samples_per_pixel"], 3);
  EXPECT_GE(stats["rays"], 3 * 16 * 12);
  EXPECT_GT(stats["rays_per_second"], 0);
  EXPECT_EQ(stats["dropped_samples"], 0);
  EXPECT_EQ(stats["dropped_faces"], 0);
  EXPECT_EQ(stats["warnings"], 0);
  for (const char* stage : {"load", "build", "render", "write"}) {
    EXPECT_GE(stats["seconds"][stage], 0) << stage;
  }
  const Json& settings = stats["settings"];
  EXPECT_EQ(settings["leaf-size"], 1);
  EXPECT_EQ(settings["max-depth"], 30);
  EXPECT_EQ(settings["threads"], 2);
  EXPECT_EQ(settings["bvh"], tracer::builders().front().name);
  EXPECT_EQ(settings["integrator"], tracer::integrators().front().name);
  EXPECT_EQ(settings["sampler"], "sobol");
  EXPECT_EQ(settings["size"], Json::array({16, 12}));
  for (const char* key : {"eye", "target", "up", "sky"}) EXPECT_EQ(settings[key].size(), 3) << key;
}

TEST_F(RenderCommand, stats_without_a_tree_have_no_nodes) {
  const Json stats = stats_of({"--spp", "1", "--bvh", "off"});
  EXPECT_EQ(stats["nodes"], 0);
  EXPECT_EQ(stats["leaves"], 0);
  EXPECT_EQ(stats["settings"]["bvh"], "off");
}

TEST_F(RenderCommand, stats_count_what_loading_left_out) {
  write_file(model_, std::string(cube_obj) + "f 1 2 99\nf 0 1 2\n");
  const Json stats = stats_of({"--spp", "1"});
  EXPECT_EQ(stats["dropped_faces"], 2);
  EXPECT_EQ(stats["warnings"], 2);
}

TEST_F(RenderCommand, quiet_means_quiet) {
  write_file(model_, std::string(cube_obj) + "f 1 2 99\n");
  const Arguments arguments = with_defaults(folder_ / "cube.png", {"--spp", "1", "--quiet"});
  const ProgramResult result = run_boxwood(arguments);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
  ChildProgram on_terminal(BOXWOOD_PROGRAM, arguments, ErrorStream::terminal);
  EXPECT_EQ(on_terminal.wait().err, "");
}

TEST_F(RenderCommand, one_line_says_what_was_written_and_warnings_come_before_it) {
  write_file(model_, std::string(cube_obj) + "f 1 2 99\n");
  const std::string output = folder_ / "cube.png";
  const ProgramResult result = run_boxwood(with_defaults(output, {"--spp", "1"}));
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("cube.obj:16: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(output + ": 16x12, 1 sample a pixel"), std::string::npos) << result.err;
}

TEST_F(RenderCommand, progress_is_for_terminals_only) {
  const Arguments arguments = with_defaults(folder_ / "cube.png", {"--time", "1"});
  EXPECT_EQ(run_boxwood(arguments).err.find('\r'), std::string::npos);
  ChildProgram on_terminal(BOXWOOD_PROGRAM, arguments, ErrorStream::terminal);
  EXPECT_TRUE(on_terminal.wait_for_error_text("rendering"));
  EXPECT_TRUE(on_terminal.wait_for_error_text(" left"));
  EXPECT_EQ(on_terminal.wait().exit_code, 0);
}

TEST_F(RenderCommand, time_ends_the_render_and_the_picture_is_written) {
  const Json stats = stats_of({"--time", "0.3"});
  EXPECT_GE(stats["seconds"]["render"], 0.3);
  EXPECT_LT(stats["seconds"]["render"], 10);
  EXPECT_GT(stats["samples_per_pixel"], 0);
  EXPECT_EQ(read_pfm(folder_ / "cube.pfm").size_px, tracer::Vec2i(16, 12));
}

TEST_F(RenderCommand, ctrl_c_writes_what_there_is) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string output = folder_ / "interrupted.pfm";
    ChildProgram program(BOXWOOD_PROGRAM, with_defaults(output, {"--spp", endless}),
                         ErrorStream::terminal);
    ASSERT_TRUE(program.wait_for_error_text("rendering"));
    program.send_signal(signal);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_NE(result.err.find("interrupted after "), std::string::npos) << result.err;
    EXPECT_EQ(read_pfm(output).size_px, tracer::Vec2i(16, 12));
    std::filesystem::remove(output);
  }
}

TEST_F(RenderCommand, a_described_sample_is_the_one_that_is_rendered) {
  render({"--spp", "1", "--seed", "3", "--sky", "0.3,0.5,0.7"});
  const Pfm picture = read_pfm(folder_ / "cube.pfm");
  for (const char* pixel : {"0,0", "8,6", "7,5", "15,11"}) {
    const ProgramResult result =
        run_boxwood({"render", model_, "--size", "16x12", "--seed", "3", "--sky", "0.3,0.5,0.7",
                     "--pixel", pixel, "--sample", "0"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const size_t last = result.out.rfind("radiance ");
    ASSERT_NE(last, std::string::npos) << result.out;
    std::istringstream words(result.out.substr(last + 9));
    tracer::Vec3d described;
    words >> described.x >> described.y >> described.z;
    const int x = std::stoi(pixel),
              y = std::stoi(std::string(pixel).substr(std::string(pixel).find(',') + 1));
    const tracer::Vec3d rendered(picture.at(x, y));
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(described[channel], rendered[channel], 1e-6 * rendered[channel]) << pixel;
    }
  }
}

TEST_F(RenderCommand, stats_can_go_to_standard_output) {
  const ProgramResult result =
      run_boxwood(with_defaults(folder_ / "cube.png", {"--spp", "1", "--stats", "/dev/stdout"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["triangles"], 12);
}

TEST_F(RenderCommand, positions_of_a_sample_are_those_of_the_file) {
  write_file(model_, "v 1000 0 7\nv 1010 0 7\nv 1000 10 7\nf 1 2 3\n");
  const ProgramResult result =
      run_boxwood({"render", model_, "--size", "1x1", "--eye", "1002,3,20", "--target", "1002,3,7",
                   "--fov", "0.001", "--pixel", "0,0"});
  EXPECT_NE(result.out.find("origin (1002 3 20)"), std::string::npos) << result.out;
  const size_t position = result.out.find("position (");
  ASSERT_NE(position, std::string::npos) << result.out;
  EXPECT_NEAR(std::stod(result.out.substr(position + 10)), 1002, 2e-4);
}

TEST_F(RenderCommand, samples_of_a_pixel_differ) {
  const auto describe = [&](const char* sample) {
    return run_boxwood({"render", model_, "--size", "16x12", "--pixel", "8,6", "--sample", sample})
        .out;
  };
  EXPECT_NE(describe("0"), describe("1"));
  EXPECT_EQ(describe("1"), describe("1"));
}

}  // namespace
}  // namespace tests
