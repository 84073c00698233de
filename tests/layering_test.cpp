// SPDX-License-Identifier: MIT
// The folders are the architecture: an include may point sideways or down, never up.
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/pattern.h"
#include "tests/support/source_files.h"

namespace tracer {
namespace {

const std::map<std::string, std::set<std::string>> visible_folders{
    {"tracer/base", {"tracer/base"}},
    {"tracer/geometry", {"tracer/base", "tracer/geometry"}},
    {"tracer/obj", {"tracer/base", "tracer/geometry", "tracer/obj"}},
    {"tracer/bvh", {"tracer/base", "tracer/geometry", "tracer/bvh"}},
    {"tracer/scene", {"tracer/base", "tracer/geometry", "tracer/obj", "tracer/scene"}},
    {"tracer/render",
     {"tracer/base", "tracer/geometry", "tracer/bvh", "tracer/scene", "tracer/render"}},
};

bool starts_with_any(const std::string& text, std::initializer_list<const char*> prefixes) {
  return std::ranges::any_of(prefixes,
                             [&](const char* prefix) { return text.starts_with(prefix); });
}

// "tracer/bvh/trace/accel.h" -> "tracer/bvh"
std::string folder_of(const std::string& path) {
  return path.substr(0, path.find('/', path.find('/') + 1));
}

// Empty where the file may include it.
std::string fault(const std::string& file, const std::string& included) {
  if (starts_with_any(included, {"GLFW/", "GL/", "epoxy/", "glad/", "imgui"}) &&
      !file.starts_with("app/viewer/")) {
    return "only app/viewer sees the window system";
  }
  if (starts_with_any(included, {"tbb/", "oneapi/"}) && file != "tracer/base/parallel.h") {
    return "only tracer/base/parallel.h sees oneTBB";
  }
  if (included.starts_with("tests/")) return "tests are nobody's dependency";
  if (!starts_with_any(file, {"tracer/"})) return "";
  if (included.starts_with("app/")) return "tracer never sees app";
  if (!included.starts_with("tracer/")) return "";
  const auto visible = visible_folders.find(folder_of(file));
  if (visible == visible_folders.end()) return "a folder without a floor";
  return visible->second.contains(folder_of(included)) ? "" : "the arrow runs upward";
}

TEST(Layering, no_include_runs_upward) {
  const Pattern include("#[[:space:]]*include[[:space:]]*[\"<]([^\">]+)[\">]");
  int include_count = 0;
  for (const char* folder : {"tracer", "app"}) {
    for (const SourceFile& file : source_files(folder)) {
      for (const std::string& included : include.first_groups(file.text)) {
        ++include_count;
        EXPECT_EQ(fault(file.path, included), "") << file.path << " includes " << included;
      }
    }
  }
  EXPECT_GT(include_count, 100);
}

TEST(Layering, forbidden_includes_are_found) {
  EXPECT_NE(fault("tracer/bvh/trace/accel.h", "tracer/scene/scene.h"), "");
  EXPECT_NE(fault("tracer/bvh/tree.h", "tracer/obj/obj_file.h"), "");
  EXPECT_NE(fault("tracer/obj/make_mesh.h", "tracer/bvh/tree.h"), "");
  EXPECT_NE(fault("tracer/geometry/mesh.h", "tracer/bvh/tree.h"), "");
  EXPECT_NE(fault("tracer/render/film.h", "app/session.h"), "");
  EXPECT_NE(fault("tracer/render/film.h", "GLFW/glfw3.h"), "");
  EXPECT_NE(fault("app/session.h", "imgui.h"), "");
  EXPECT_NE(fault("app/session.h", "oneapi/tbb/parallel_for.h"), "");
  EXPECT_NE(fault("tracer/other/new.h", "tracer/base/error.h"), "");
  EXPECT_EQ(fault("app/viewer/window.h", "GLFW/glfw3.h"), "");
  EXPECT_EQ(fault("tracer/scene/import_obj.h", "tracer/obj/obj_file.h"), "");
  EXPECT_EQ(fault("tracer/render/world.h", "tracer/bvh/trace/accel.h"), "");
  EXPECT_EQ(fault("tracer/base/parallel.h", "oneapi/tbb/parallel_for.h"), "");
}

TEST(Layering, only_parallel_names_tbb) {
  for (const char* folder : {"tracer", "app"}) {
    for (const SourceFile& file : source_files(folder)) {
      if (file.path == "tracer/base/parallel.h") continue;
      EXPECT_EQ(file.text.find("tbb::"), std::string::npos) << file.path;
    }
  }
}

// Sizes of models differ by many orders of magnitude: what is small is a matter of proportion, and
// bounds that are derived are written as powers of two.
bool has_absolute_epsilon(const std::string& line) {
  static const Pattern small_literal(
      "(^|[^[:alnum:]_.])([0-9]+[.]?[0-9]*[eE]-[0-9]+|0?[.]00[0-9]*[1-9])|_EPSILON|epsilon\\(\\)");
  return !small_literal.first_groups(line.substr(0, line.find("//"))).empty();
}

TEST(Layering, geometry_and_bvh_know_no_absolute_epsilon) {
  for (const char* folder : {"tracer/geometry", "tracer/bvh"}) {
    for (const SourceFile& file : source_files(folder)) {
      std::istringstream lines(file.text);
      for (std::string line; std::getline(lines, line);) {
        EXPECT_FALSE(has_absolute_epsilon(line)) << file.path << ": " << line;
      }
    }
  }
}

TEST(Layering, absolute_epsilons_are_found) {
  EXPECT_TRUE(has_absolute_epsilon("if (t < 1e-6) return;"));
  EXPECT_TRUE(has_absolute_epsilon("constexpr float tiny = 1.5E-4f;"));
  EXPECT_TRUE(has_absolute_epsilon("x += 0.0001;"));
  EXPECT_TRUE(has_absolute_epsilon("x += FLT_EPSILON;"));
  EXPECT_TRUE(has_absolute_epsilon("std::numeric_limits<float>::epsilon()"));
  EXPECT_FALSE(has_absolute_epsilon("constexpr double pad = 0x1p-38;"));
  EXPECT_FALSE(has_absolute_epsilon("0.5 * x;  // not 1e-6"));
}

}  // namespace
}  // namespace tracer
