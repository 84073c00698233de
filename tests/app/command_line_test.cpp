// SPDX-License-Identifier: MIT
// The program as a user meets it: what it says and returns when it is asked for the wrong thing.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/cube_obj.h"
#include "tests/support/run_program.h"

namespace tests {
namespace {

using Arguments = std::vector<std::string>;

class CommandLine : public testing::Test {
 protected:
  CommandLine() { write_file(model_, cube_obj); }

  // One line on stderr that holds `words`, nothing on stdout, exit code 2, no picture.
  void expect_refused(const Arguments& arguments, const std::string& words) const {
    const ProgramResult result = run_boxwood(arguments);
    std::string command;
    for (const std::string& argument : arguments) command += ' ' + argument;
    EXPECT_EQ(result.exit_code, 2) << command << '\n' << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << command << '\n'
                                                                         << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << command << '\n' << result.err;
    EXPECT_EQ(result.out, "") << command;
    EXPECT_FALSE(std::filesystem::exists(picture_)) << command;
  }

  // `boxwood render MODEL -o PICTURE` and these.
  void expect_render_refused(const Arguments& more, const std::string& words) const {
    Arguments arguments{"render", model_, "-o", picture_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, words);
  }

  TemporaryFolder folder_;
  std::string model_ = folder_ / "cube.obj";
  std::string picture_ = folder_ / "cube.png";
};

TEST_F(CommandLine, help_names_every_command_and_shows_examples) {
  for (const char* flag : {"--help", "-h"}) {
    const ProgramResult result = run_boxwood({flag});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    for (const char* words : {"boxwood [view]", "boxwood render", "boxwood info", "Examples"}) {
      EXPECT_NE(result.out.find(words), std::string::npos) << words;
    }
  }
}

TEST_F(CommandLine, help_of_render_names_every_option) {
  const ProgramResult result = run_boxwood({"render", "--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* option :
       {"--output",       "--spp",    "--time",        "--size",      "--view",
        "--eye",          "--target", "--up",          "--fov",       "--integrator",
        "--bounces",      "--sky",    "--bvh",         "--max-depth", "--leaf-size",
        "--threads",      "--seed",   "--exposure",    "--pixel",     "--sample",
        "--stats",        "--quiet",  "--environment", "--sun",       "--sky-strength",
        "--sky-rotation", "--clamp"}) {
    EXPECT_NE(result.out.find(option), std::string::npos) << option;
  }
}

TEST_F(CommandLine, version_is_one_line) {
  const ProgramResult result = run_boxwood({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "boxwood " BOXWOOD_VERSION "\n");
}

TEST_F(CommandLine, a_render_that_leads_nowhere_is_refused) {
  expect_refused({"render", model_}, "-o FILE.png");
  expect_refused({"render"}, "MODEL");
  expect_refused({"render", "-o", picture_}, "MODEL");
  expect_refused({"render", model_, "-o", folder_ / "cube.gif"}, ".png, .exr or .pfm");
  expect_refused({"render", model_, "-o"}, "-o");
  expect_refused({"info"}, "MODEL");
}

TEST_F(CommandLine, unknown_options_and_extra_arguments_are_refused) {
  expect_render_refused({"--colour", "red"}, "--colour");
  expect_render_refused({"another.obj"}, "another.obj");
  expect_refused({"info", model_, "--yaml"}, "--yaml");
  expect_refused({"--frobnicate"}, "--frobnicate");
}

TEST_F(CommandLine, bad_values_are_refused_by_the_name_of_the_option) {
  const std::vector<std::pair<std::string, std::string>> bad_values = {{"--size", "0x0"},
                                                                       {"--size", "99999999x2"},
                                                                       {"--size", "640"},
                                                                       {"--size", "-5x5"},
                                                                       {"--spp", "-1"},
                                                                       {"--spp", "0"},
                                                                       {"--spp", "many"},
                                                                       {"--time", "0"},
                                                                       {"--time", "-3"},
                                                                       {"--time", "nan"},
                                                                       {"--threads", "0"},
                                                                       {"--threads", "-2"},
                                                                       {"--threads", "100000"},
                                                                       {"--bvh", "no-such-tree"},
                                                                       {"--integrator", "no-such"},
                                                                       {"--max-depth", "0"},
                                                                       {"--max-depth", "65"},
                                                                       {"--leaf-size", "0"},
                                                                       {"--leaf-size", "65"},
                                                                       {"--bounces", "-1"},
                                                                       {"--bounces", "65"},
                                                                       {"--seed", "-1"},
                                                                       {"--seed", "4294967296"},
                                                                       {"--exposure", "21"},
                                                                       {"--exposure", "inf"},
                                                                       {"--eye", "1,2"},
                                                                       {"--target", "a,b,c"},
                                                                       {"--up", "0,0,0"},
                                                                       {"--fov", "0"},
                                                                       {"--fov", "180"},
                                                                       {"--sky", "-1,0,0"},
                                                                       {"--sky", "1"},
                                                                       {"--sky", "1e39,0,0"},
                                                                       {"--sun", "30"},
                                                                       {"--sun", "91,0"},
                                                                       {"--sun", "30,400"},
                                                                       {"--sun", "30,"},
                                                                       {"--sky-strength", "-1"},
                                                                       {"--clamp", "-1"},
                                                                       {"--eye", "1e39,0,0"},
                                                                       {"--pixel", "1280,0"},
                                                                       {"--pixel", "0,720"},
                                                                       {"--pixel", "-1,0"},
                                                                       {"--size", "65535x65535"}};
  for (const auto& [option, value] : bad_values) expect_render_refused({option, value}, option);
}

TEST_F(CommandLine, options_that_exclude_or_need_each_other_say_so) {
  expect_render_refused({"--spp", "4", "--time", "1"}, "--time");
  expect_render_refused({"--sample", "4"}, "--pixel");
  expect_render_refused({"--sun", "30,40", "--environment", "sky.hdr"}, "--environment");
  expect_render_refused({"--eye", "1,2,3", "--target", "1,2,3"}, "same point");
}

TEST_F(CommandLine, a_repeated_option_is_told_in_words) {
  expect_render_refused({"--spp", "4", "--spp", "5"}, "--spp: given more than once");
}

TEST_F(CommandLine, picture_and_stats_need_files_of_their_own) {
  expect_render_refused({"--stats", picture_}, "same file");
  expect_render_refused({"--stats", folder_ / "./cube.png"}, "same file");
}

TEST_F(CommandLine, a_picture_that_would_replace_a_device_is_refused) {
  const std::string link = folder_ / "null.png";
  std::filesystem::create_symlink("/dev/null", link);
  expect_refused({"render", model_, "-o", link, "--spp", "100000000"}, "not a regular file");
}

TEST_F(CommandLine, output_that_cannot_be_written_is_a_failure) {
  const std::string command = std::string(BOXWOOD_PROGRAM) + " --version >/dev/full";
  const ProgramResult result = ChildProgram("/bin/sh", {"-c", command}).wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "boxwood: standard output cannot be written: No space left on device\n");
}

TEST_F(CommandLine, the_choices_are_listed_where_a_name_is_unknown) {
  expect_render_refused({"--bvh", "oak"}, "median");
  expect_render_refused({"--bvh", "oak"}, "off");
  expect_render_refused({"--integrator", "oak"}, "path");
}

TEST_F(CommandLine, models_that_cannot_be_loaded_are_one_line) {
  const auto expect_unloadable = [&](const std::string& model) {
    expect_refused({"render", model, "-o", picture_}, model);
    expect_refused({"info", model}, model);
  };
  expect_unloadable(folder_ / "missing.obj");
  expect_unloadable(folder_.path().string());
  const std::string no_obj = folder_ / "picture.obj";
  write_file(no_obj, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\xff\xfe", 18));
  expect_unloadable(no_obj);
  const std::string empty = folder_ / "empty.obj";
  write_file(empty, "");
  expect_unloadable(empty);
}

TEST_F(CommandLine, pictures_that_cannot_be_written_are_known_before_rendering) {
  // So many samples would outlive the test.
  const Arguments endless{"--spp", "100000000"};
  for (const std::string& output :
       {folder_ / "no-such-folder/cube.png", std::string("/proc/x.png")}) {
    Arguments arguments{"render", model_, "-o", output, "--spp", "100000000"};
    if (output.starts_with("/proc")) arguments.back() = "1";
    expect_refused(arguments, output);
  }
  std::filesystem::create_directory(folder_ / "folder.png");
  expect_refused({"render", model_, "-o", folder_ / "folder.png"}, "folder");
  expect_render_refused({"--stats", folder_ / "no-such-folder/stats.json"}, "stats.json");
}

TEST_F(CommandLine, faulty_view_files_are_refused_with_their_name) {
  const std::string view = folder_ / "bad.json";
  expect_render_refused({"--view", view}, view);
  for (const char* text : {"", "[1,2,3]", "{\"eye\":[0,0]}", "{\"eye\":[0,0,1],\"target\":3}"}) {
    write_file(view, text);
    expect_render_refused({"--view", view}, view);
  }
}

TEST_F(CommandLine, negative_and_dotted_numbers_are_values_not_options) {
  const ProgramResult result =
      run_boxwood({"render", model_, "-o", picture_, "--size", "4x4", "--spp", "1", "--eye",
                   "-.5,-3,.25", "--exposure", "-.5", "--target", "-0.5,0,0"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace tests
