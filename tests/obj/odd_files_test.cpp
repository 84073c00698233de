// SPDX-License-Identifier: MIT
// Files that are unusual, but say plainly what is meant: loaded without a word.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "tests/obj/faulty_file.h"

namespace tests {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

void expect_the_square(const std::string& what, const std::string& obj) {
  expect_as_described({what, obj, 2, 0, {}});
  const TemporaryFolder folder;
  const Loading loading = load(folder.write("model.obj", obj));
  ASSERT_TRUE(loading.scene) << what;
  const tracer::ImportedScene& scene = *loading.scene;
  EXPECT_EQ(scene.bounds.min, tracer::Vec3d(0, 0, 0)) << what;
  EXPECT_EQ(scene.bounds.max, tracer::Vec3d(1, 1, 0)) << what;
  EXPECT_EQ(summed_area(*scene.scene.mesh), tracer::Vec3d(0, 0, 1)) << what;
}

TEST(OddFiles, lines_may_end_in_crlf_or_cr_alone) {
  expect_the_square("CRLF", replaced(square, "\n", "\r\n"));
  expect_the_square("CR alone", replaced(square, "\n", "\r"));
  expect_the_square("mixed", replaced(square, "0\n", "0\r\n"));
  expect_the_square("no end of the last line", square.substr(0, square.size() - 1));
}

TEST(OddFiles, faults_are_counted_in_lines_whatever_ends_them) {
  const std::string faulty = square + "f 1 2 9\n";
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    expect_as_described(
        {line_end, replaced(faulty, "\n", line_end), 2, 1, {{7, "vertex 9 does not exist"}}});
  }
}

TEST(OddFiles, a_statement_may_be_continued_on_the_next_line) {
  expect_the_square("between numbers", replaced(square, "v 1 1 0", "v 1 \\\n1\\\n 0"));
  expect_the_square("between corners", replaced(square, "f 1 2 3", "f 1 \\\r\n2 \\\r\n3"));
  expect_the_square("after the keyword", replaced(square, "f 1 2 3", "f \\\n 1 2 3"));
  expect_as_described({"the fault's line is where the statement begins",
                       square + "f \\\n1 \\\n2\nf 1 2 9\n",
                       2,
                       2,
                       {{7, "at least 3 corners"}, {10, "vertex 9"}}});
}

TEST(OddFiles, blanks_may_be_tabs_and_stand_anywhere) {
  expect_the_square("tabs", replaced(square, " ", "\t"));
  expect_the_square("many blanks", replaced(square, " ", " \t  "));
  expect_the_square("indented", "  \t" + replaced(square, "\n", "\n\t "));
  expect_the_square("at line ends", replaced(square, "\n", " \t\n"));
}

TEST(OddFiles, a_byte_order_mark_is_passed_over) {
  expect_the_square("BOM", "\xef\xbb\xbf" + square);
}

TEST(OddFiles, comments_may_end_a_line) {
  expect_the_square("comments", replaced(square, "\n", " # f 1 2 9\n"));
  expect_the_square("close to the number", replaced(square, "\n", "#v\n"));
}

TEST(OddFiles, corners_of_all_forms_may_be_mixed) {
  const std::string attributes = "vt 0 0\nvn 0 0 1\n";
  const std::string head = square.substr(0, square.find('f')) + attributes;
  expect_the_square("mixed in a face", head + "f 1 2/1 3//1\nf 1/1/1 3 4/1\n");
  expect_the_square("mixed between faces", head + "f 1//1 2//1 3//1\nf 1 3 4\n");
  expect_the_square("slashes with nothing after", head + "f 1/ 2/1/ 3//\nf 1 3 4\n");
  expect_the_square("negative", head + "f -4/-1/-1 -3/-1/-1 -2/-1/-1\nf -4 -2 -1\n");
}

TEST(OddFiles, numbers_of_every_form_mean_the_same) {
  for (const char* one : {"1.", "+1", "1e0", "1E+0", "10e-1", "1.0000000000000000000000000000000",
                          "0.1e1", "01", "000000000000000000000000001", ".1e1"}) {
    expect_the_square(one, replaced(square, "v 1 1 0", std::string("v 1 ") + one + " 0"));
  }
}

TEST(OddFiles, vertex_colors_may_be_on_all_vertices_or_some) {
  expect_the_square("all", replaced(square, " 0\n", " 0 0.5 0.25 1\n"));
  const std::string some = replaced(square, "v 1 1 0", "v 1 1 0 0 1 0");
  expect_the_square("some", some);
  const TemporaryFolder folder;
  const Loading loading = load(folder.write("model.obj", some));
  ASSERT_TRUE(loading.scene);
  const auto& colors = loading.scene->scene.mesh->colors;
  ASSERT_EQ(colors.size(), 4u);
  EXPECT_EQ(colors[2], tracer::Vec3f(0, 1, 0));
  EXPECT_EQ(colors[0], tracer::Vec3f(1, 1, 1));
}

TEST(OddFiles, points_lines_and_curves_are_passed_over) {
  expect_the_square("points and lines", square + "p 1 2\nl 1 2 3\nvp 0.5\nvp 0.1 0.2 1\n");
}

std::string star(int corner_count) {
  std::string vertices, face = "f";
  for (int i = 0; i < corner_count; ++i) {
    const double angle = 2 * std::numbers::pi * i / corner_count;
    const double radius = i % 2 == 0 ? 1 : 0.5;
    vertices += "v " + std::to_string(radius * std::cos(angle)) + ' ' +
                std::to_string(radius * std::sin(angle)) + " 0\n";
    face += ' ' + std::to_string(i + 1);
  }
  return vertices + face + '\n';
}

TEST(OddFiles, a_concave_polygon_of_1000_corners_is_998_triangles_none_of_them_flipped) {
  const std::string obj = star(1000);
  expect_as_described({"star", obj, 998, 0, {}});
  const TemporaryFolder folder;
  const Loading loading = load(folder.write("model.obj", obj));
  ASSERT_TRUE(loading.scene);
  const tracer::Mesh& mesh = *loading.scene->scene.mesh;
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    EXPECT_GE(triangle_at(mesh, i).area_normal().z, 0) << i;
  }
  const double area = 500 * 0.5 * std::sin(2 * std::numbers::pi / 1000);
  EXPECT_NEAR(total_area(mesh), area, 1e-5);
}

}  // namespace
}  // namespace tests
