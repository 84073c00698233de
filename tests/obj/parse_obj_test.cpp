// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_obj.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/flat_obj.h"

namespace tracer {
namespace {

FlatObj parse(std::string_view text) {
  Progress progress;
  return FlatObj(parse_obj(text, "x.obj", progress));
}

std::string first_warning(const FlatObj& file) {
  return file.warnings.messages().empty() ? "" : file.warnings.messages()[0].text();
}

/// Corner `corner` of face `face` as position/texcoord/normal from 0, "-" for none.
std::string corner_text(const FlatObj& file, size_t face, size_t corner) {
  const FlatCorner& c = file.faces[face].corners[corner];
  const auto text = [](uint32_t i) { return i == no_obj_index ? "-" : std::to_string(i); };
  return text(c.position) + '/' + text(c.texcoord) + '/' + text(c.normal);
}

const std::string four_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ParseObj, reads_positions_as_correctly_rounded_doubles) {
  const FlatObj file = parse("v 0.1 -2e3 +3\n");
  ASSERT_EQ(file.positions.size(), 1u);
  EXPECT_EQ(file.positions[0], Vec3d(0.1, -2000, 3));
  EXPECT_EQ(file.warnings.count(), 0);
}

TEST(ParseObj, a_fourth_number_is_a_weight_and_three_more_are_a_color) {
  const FlatObj file = parse("v 1 2 3 0.5\nv 1 2 3 0.1 0.2 0.3\nv 1 2 3 0.4 0.5 0.6 1\n");
  ASSERT_EQ(file.colors.size(), 3u);
  EXPECT_TRUE(std::isnan(file.colors[0].x));
  EXPECT_EQ(file.colors[1], Vec3f(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(file.colors[2], Vec3f(0.4f, 0.5f, 0.6f));
  EXPECT_TRUE(parse("v 1 2 3 0.5\n").colors.empty());
}

TEST(ParseObj, corners_come_in_four_forms_that_may_be_mixed) {
  const FlatObj file = parse(four_vertices + "vt 0 0\nvt 1 0\nvn 0 0 1\nf 1 2/2 3//1 4/1/1\n");
  ASSERT_EQ(file.faces.size(), 1u);
  EXPECT_EQ(file.faces[0].corners.size(), 4u);
  EXPECT_EQ(corner_text(file, 0, 0), "0/-/-");
  EXPECT_EQ(corner_text(file, 0, 1), "1/1/-");
  EXPECT_EQ(corner_text(file, 0, 2), "2/-/0");
  EXPECT_EQ(corner_text(file, 0, 3), "3/0/0");
}

TEST(ParseObj, negative_indices_count_from_what_is_defined_so_far) {
  const FlatObj file = parse(four_vertices + "vt 0 0\nvt 1 1\nvn 0 0 1\nf -4/-2/-1 -3 -1\n" +
                             four_vertices + "vt 2 2\nf -1/-1 -8 -2\n");
  ASSERT_EQ(file.faces.size(), 2u);
  EXPECT_EQ(corner_text(file, 0, 0), "0/0/0");
  EXPECT_EQ(corner_text(file, 0, 1), "1/-/-");
  EXPECT_EQ(corner_text(file, 0, 2), "3/-/-");
  EXPECT_EQ(corner_text(file, 1, 0), "7/2/-");
  EXPECT_EQ(corner_text(file, 1, 1), "0/-/-");
}

TEST(ParseObj, a_face_may_stand_before_its_vertices) {
  const FlatObj file = parse("f 1 2 4\n" + four_vertices);
  ASSERT_EQ(file.faces.size(), 1u);
  EXPECT_EQ(corner_text(file, 0, 2), "3/-/-");
}

TEST(ParseObj, comments_continuations_and_odd_blanks_change_nothing) {
  const std::string plain = four_vertices + "f 1 2 3\nf 1 3 4\n";
  const std::string odd =
      "\xef\xbb\xbf# a comment \\\n"
      "\tv\t0  0\v0 # x\r\n  v 1 0 0#y\r\n\r\n\nv 1 \\\n1 \\\r\n 0\rv 0 1 0\n"
      "f 1 2 \\\r\n 3 # 4\n#f 1 2 3\nf 1 3\\\n4";
  const FlatObj a = parse(plain);
  const FlatObj b = parse(odd);
  EXPECT_EQ(b.positions, a.positions);
  ASSERT_EQ(b.faces.size(), 2u);
  EXPECT_EQ(b.faces[1].corners.size(), 3u);
  EXPECT_EQ(corner_text(b, 1, 2), "3/-/-");
  EXPECT_EQ(b.warnings.count(), 0) << first_warning(b);
}

TEST(ParseObj, lines_may_end_in_lf_crlf_or_cr_and_count_alike) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const FlatObj file = parse("v 0 0 0" + end + "v 1 0 0" + end + end + "v 0 1 0" + end +
                               "f 0 1 2" + end + "f 1 2 3");
    EXPECT_EQ(file.positions.size(), 3u);
    ASSERT_EQ(file.faces.size(), 1u);
    EXPECT_EQ(file.faces[0].line, 6);
    EXPECT_EQ(first_warning(file), "x.obj:5: face index 0: OBJ indices start at 1");
  }
}

TEST(ParseObj, a_continued_statement_counts_its_lines) {
  const FlatObj file = parse("v 0 0 0\nv 1 \\\n 0 \\\n 0\nv 0 1 0\nf 1 2 \\\n 3\nf 1 2 9\n");
  ASSERT_EQ(file.faces.size(), 1u);
  EXPECT_EQ(file.faces[0].line, 6);
  EXPECT_EQ(first_warning(file), "x.obj:8: vertex 9 does not exist (the file has 3)");
}

TEST(ParseObj, faults_are_said_with_their_line_and_the_face_is_dropped) {
  const struct {
    const char* line;
    const char* message;
  } faults[] = {
      {"f 0 1 2", "x.obj:5: face index 0: OBJ indices start at 1"},
      {"f 1 2 5", "x.obj:5: vertex 5 does not exist (the file has 4)"},
      {"f -5 2 3", "x.obj:5: vertex -5 does not exist (4 so far)"},
      {"f 1 2 99999999999999", "x.obj:5: vertex '99999999999999' does not exist"},
      {"f 1 2 -99999999999999999999", "x.obj:5: vertex '-99999999999999999999' does not exist"},
      {"f 1 2", "x.obj:5: a face needs at least 3 corners, this has 2"},
      {"f", "x.obj:5: a face needs at least 3 corners, this has 0"},
      {"f 1 2 x", "x.obj:5: face corner 'x' is malformed"},
      {"f 1 2 3/a", "x.obj:5: face corner '3/a' is malformed"},
      {"f 1 2 3.5", "x.obj:5: face corner '3.5' is malformed"},
      {"f 1 2 3/1/1/1", "x.obj:5: face corner '3/1/1/1' is malformed"},
      {"f 1 2 \x01\xff",
       "x.obj:5: face corner '?"
       "?' is malformed"},
  };
  for (const auto& fault : faults) {
    const FlatObj file = parse(four_vertices + fault.line + "\nf 1 2 3\n");
    EXPECT_EQ(first_warning(file), fault.message);
    EXPECT_EQ(file.warnings.count(), file.dropped_faces);
    EXPECT_EQ(file.dropped_faces, 1);
    ASSERT_EQ(file.faces.size(), 1u);
    EXPECT_EQ(file.faces[0].line, 6);
    EXPECT_EQ(corner_text(file, 0, 0), "0/-/-");
  }
}

TEST(ParseObj, a_missing_attribute_leaves_the_face_its_other_content) {
  const FlatObj file = parse(four_vertices + "vt 0 0\nvn 0 0 1\nf 1/7/1 2/1/-3 3/0/1\n");
  ASSERT_EQ(file.faces.size(), 1u);
  EXPECT_EQ(file.dropped_faces, 0);
  EXPECT_EQ(corner_text(file, 0, 0), "0/-/0");
  EXPECT_EQ(corner_text(file, 0, 1), "1/0/-");
  EXPECT_EQ(corner_text(file, 0, 2), "2/-/0");
  ASSERT_EQ(file.warnings.count(), 3);
  EXPECT_EQ(file.warnings.messages()[0].what, "texture coordinate index 0: OBJ indices start at 1");
  EXPECT_EQ(file.warnings.messages()[1].what,
            "texture coordinate 7 does not exist (the file has 1)");
  EXPECT_EQ(file.warnings.messages()[2].what, "normal -3 does not exist (1 so far)");
}

TEST(ParseObj, a_malformed_vertex_keeps_its_place) {
  const FlatObj file = parse("v 0 0 0\nv 1 zero 0\nv 1\nv 1 1 0\nf 1 4 3\n");
  ASSERT_EQ(file.positions.size(), 4u);
  EXPECT_TRUE(std::isnan(file.positions[1].x));
  EXPECT_TRUE(std::isnan(file.positions[2].x));
  EXPECT_EQ(file.positions[3], Vec3d(1, 1, 0));
  ASSERT_EQ(file.warnings.count(), 2);
  EXPECT_EQ(first_warning(file), "x.obj:2: vertex: 'zero' is not a number");
  EXPECT_EQ(file.warnings.messages()[1].text(),
            "x.obj:3: vertex: 3 numbers are needed, here are 1");
}

TEST(ParseObj, a_malformed_color_costs_only_the_color) {
  const FlatObj file = parse("v 1 2 3 red 0 0\nv 1 2 3 1 0 0\n");
  ASSERT_EQ(file.positions.size(), 2u);
  EXPECT_EQ(file.positions[0], Vec3d(1, 2, 3));
  EXPECT_TRUE(std::isnan(file.colors[0].x));
  EXPECT_EQ(file.warnings.count(), 1);
}

TEST(ParseObj, numbers_that_are_not_finite_are_kept_as_they_are) {
  const FlatObj file = parse("v nan 1e400 -inf\nv 1e-400 0 0\n");
  EXPECT_TRUE(std::isnan(file.positions[0].x));
  EXPECT_TRUE(std::isinf(file.positions[0].y));
  EXPECT_TRUE(std::isinf(file.positions[0].z));
  EXPECT_EQ(file.positions[1].x, 0);
}

TEST(ParseObj, materials_libraries_objects_and_groups_are_kept) {
  const FlatObj file = parse(four_vertices +
                             "mtllib a.mtl my file.mtl\nmtllib odd name # x\no cow\ng a b\ng\n"
                             "f 1 2 3\nusemtl red  paint\nf 1 2 3\nusemtl Material #2\nf 1 2 3\n"
                             "usemtl red paint # again\nf 1 2 3\n");
  EXPECT_EQ(file.material_libraries,
            (std::vector<ObjName>{{"a.mtl", 5}, {"my file.mtl", 5}, {"odd name", 6}}));
  EXPECT_EQ(file.material_names,
            (std::vector<ObjName>{{"", 0}, {"red paint", 11}, {"Material #2", 13}}));
  EXPECT_EQ(file.object_count, 1u);
  EXPECT_EQ(file.group_count, 2u);
  ASSERT_EQ(file.faces.size(), 4u);
  EXPECT_EQ(file.faces[0].material, 0u);
  EXPECT_EQ(file.faces[1].material, 1u);
  EXPECT_EQ(file.faces[2].material, 2u);
  EXPECT_EQ(file.faces[3].material, 1u);
}

TEST(ParseObj, other_statements_are_passed_over) {
  const FlatObj file =
      parse("l 1 2\np 1\nl 1 2 3\nvp 0 1\ns off\nvertex 1 2 3\nend\ndeg 3 \\\n3\ncstype bspline\n");
  EXPECT_TRUE(file.positions.empty());
  EXPECT_EQ(file.warnings.count(), 0);
  EXPECT_EQ(file.others.lines, 2u);
  EXPECT_EQ(file.others.points, 1u);
}

TEST(ParseObj, free_forms_are_passed_over_counted_and_said_once) {
  const FlatObj file = parse(four_vertices +
                             "cstype bspline\ncurv 0 1 1 2 \\\n3\nparm u 0 1\nend\n"
                             "curv2 1 2\nsurf 0 1 0 1 1 2\nend\nf 1 2 3\nf 1 2 9\n");
  EXPECT_EQ(file.faces.size(), 1u);
  EXPECT_EQ(file.others.free_forms, 3u);
  ASSERT_EQ(file.warnings.count(), 2);
  EXPECT_EQ(first_warning(file),
            "x.obj:6: 3 free-form curves and surfaces from here on are passed over");
}

TEST(ParseObj, polypaint_colors_vertices_in_order) {
  const std::string paint = "#MRGB ff00ff00ffff0000\r\n#MRGB 000000ff\n";
  const FlatObj file = parse(four_vertices + paint + "f 1 2 3\n");
  ASSERT_EQ(file.colors.size(), 4u);
  EXPECT_EQ(file.colors[0], Vec3f(0, 1, 0));
  EXPECT_EQ(file.colors[1], Vec3f(1, 0, 0));
  EXPECT_EQ(file.colors[2], Vec3f(0, 0, 1));
  EXPECT_TRUE(std::isnan(file.colors[3].x));
  EXPECT_EQ(file.faces[0].line, 7);
  EXPECT_EQ(parse("v 0 0 0 0.5 0.5 0.5\n" + paint).colors[0], Vec3f(0.5f));
  EXPECT_TRUE(parse(four_vertices + "#MRGB xyz\n#MRGB\n#MRGB 12345\n").colors.empty());
}

TEST(ParseObj, numbers_for_floats_are_rounded_once) {
  // Just beyond the middle of two floats: as doubles they are the middle, which rounds to even.
  const FlatObj file = parse(
      "vt 1.00000005960464477539062500000001 1.0000000596046447754\n"
      "vn 1.0000000596046448 0 1e-45\n");
  EXPECT_EQ(file.texcoords[0].x, 1.00000012f);
  EXPECT_EQ(file.texcoords[0].y, 1.00000012f);
  EXPECT_EQ(file.normals[0].x, 1.00000012f);
  EXPECT_EQ(file.normals[0].z, std::numeric_limits<float>::denorm_min());
}

TEST(ParseObj, limits_are_errors_that_say_so) {
  const auto error_of = [](const ObjLimits& limits) -> std::string {
    Progress progress;
    const std::string text = four_vertices + "f 1 2 3 4\nf 1 2 3\n";
    MemorySource source(text);
    try {
      parse_obj(source, "x.obj", progress, Texcoords::kept, limits);
    } catch (const LoadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of({.corners = 7, .triangles = 3, .vertices = 4}), "");
  EXPECT_EQ(error_of({.corners = 6}),
            "x.obj: the file has more than 6 face corners, which 32-bit indices cannot count");
  EXPECT_EQ(error_of({.triangles = 2}),
            "x.obj: the file has more than 2 triangles, which 32-bit indices cannot count");
  EXPECT_EQ(error_of({.vertices = 3}),
            "x.obj: the file has more than 3 vertices, which 32-bit indices cannot count");
}

TEST(ParseObj, lines_of_200_megabytes_are_passed_over_or_refused) {
  for (const std::string& begin : {std::string("# a comment"), std::string("f")}) {
    SCOPED_TRACE(begin);
    std::string text = four_vertices + begin;
    while (text.size() < 200'000'000) text += " 1/1/1 2/2/2 3/3/3 4/4/4 1/1/1 2/2/2 3/3/3 4/4/4";
    text += "\nf 1 2 3\nf 9 1 2\n";
    const auto begin_time = std::chrono::steady_clock::now();
    const FlatObj file = parse(text);
    EXPECT_LT(std::chrono::steady_clock::now() - begin_time, std::chrono::seconds(10));
    ASSERT_EQ(file.faces.size(), 1u);
    EXPECT_EQ(file.faces[0].line, 6);
    EXPECT_EQ(file.dropped_faces, begin == "f" ? 2 : 1);
    EXPECT_EQ(first_warning(file), begin == "f"
                                       ? "x.obj:5: the face has more than 1048576 corners"
                                       : "x.obj:7: vertex 9 does not exist (the file has 4)");
  }
}

TEST(ParseObj, a_polygon_beyond_the_limit_is_dropped_and_one_at_it_is_kept) {
  const auto polygon = [](int corner_count) {
    std::string text = four_vertices + "f";
    for (int i = 0; i < corner_count; ++i) text += " 1";
    return text + "\nf 1 2 3\n";
  };
  EXPECT_EQ(parse(polygon(1 << 20)).faces.size(), 2u);
  const FlatObj file = parse(polygon((1 << 20) + 1));
  EXPECT_EQ(file.faces.size(), 1u);
  EXPECT_EQ(first_warning(file), "x.obj:5: the face has more than 1048576 corners");
}

/// Everything a file can hold, faults included, some thousand lines of it.
std::string rich_text() {
  std::string text = "\xef\xbb\xbf# rich\r\nmtllib a.mtl\n";
  for (int i = 0; i < 300; ++i) {
    const std::string number = std::to_string(i);
    text += "v " + number + ".25 0 1e-3" + (i % 3 == 0 ? " 0.5 0.25 1" : "") + "\r\n";
    text += "vt 0." + number + " 1\nvn 0 0 1\r";
    if (i % 7 == 0) text += "usemtl m" + std::to_string(i % 35) + " # c\n";
    if (i % 11 == 0) text += "g part\no whole\n";
    if (i > 4) text += "f -1/-1/-1 -2//-2 \\\r\n -3/-1 " + std::to_string(i % 300 + 2) + "\n";
    if (i % 50 == 0) text += "f 0 1 2\nv x\nf 1 2 5000\nf 1 2/900 3\n";
    if (i % 60 == 0) text += "# ends in a backslash \\\n\\\n\\\r\n";
  }
  return text + "f 1 2 3";
}

void expect_same(const FlatObj& a, const FlatObj& b) {
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (size_t i = 0; i < a.positions.size(); ++i) {
    EXPECT_TRUE(a.positions[i] == b.positions[i] || std::isnan(a.positions[i].x));
  }
  ASSERT_EQ(a.colors.size(), b.colors.size());
  for (size_t i = 0; i < a.colors.size(); ++i) {
    EXPECT_TRUE(a.colors[i] == b.colors[i] ||
                (std::isnan(a.colors[i].x) && std::isnan(b.colors[i].x)));
  }
  EXPECT_EQ(a.texcoords, b.texcoords);
  EXPECT_EQ(a.normals, b.normals);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_EQ(a.faces[i].line, b.faces[i].line);
    EXPECT_EQ(a.faces[i].material, b.faces[i].material);
    ASSERT_EQ(a.faces[i].corners.size(), b.faces[i].corners.size());
    for (size_t j = 0; j < a.faces[i].corners.size(); ++j) {
      EXPECT_EQ(corner_text(a, i, j), corner_text(b, i, j));
    }
  }
  EXPECT_EQ(a.material_names, b.material_names);
  EXPECT_EQ(a.material_libraries, b.material_libraries);
  EXPECT_EQ(a.object_count, b.object_count);
  EXPECT_EQ(a.group_count, b.group_count);
  EXPECT_EQ(a.dropped_faces, b.dropped_faces);
  EXPECT_EQ(a.warnings.count(), b.warnings.count());
  ASSERT_EQ(a.warnings.messages().size(), b.warnings.messages().size());
  for (size_t i = 0; i < a.warnings.messages().size(); ++i) {
    EXPECT_EQ(a.warnings.messages()[i].text(), b.warnings.messages()[i].text());
  }
}

TEST(ParseObj, results_and_warnings_do_not_depend_on_the_chunks) {
  const std::string text = rich_text();
  const FlatObj whole = parse(text);
  EXPECT_GT(whole.faces.size(), 290u);
  EXPECT_EQ(whole.warnings.messages().size(), Warnings::kept_messages);
  for (const size_t chunk_bytes : {1, 2, 3, 7, 64, 1000, 10000}) {
    SCOPED_TRACE(chunk_bytes);
    Progress progress;
    expect_same(FlatObj(parse_obj_in_chunks(text, "x.obj", chunk_bytes, progress)), whole);
  }
}

TEST(ParseObj, cr_only_and_unterminated_files_split_into_chunks_too) {
  for (const std::string_view text : {"v 1 2 3\rv 4 5 6\r\rv 7 8 9\rf 1 2 3", "v 1 2 \\", "\\",
                                      "v 1 2 3\\\r\n\\\r\n", "\r", "v 1 2 3\r\n\r\nv 4 5 6\r"}) {
    Progress progress;
    expect_same(FlatObj(parse_obj_in_chunks(text, "x.obj", 1, progress)), parse(text));
  }
}

TEST(ParseObj, a_fault_beyond_the_kept_messages_is_read_like_the_first) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += "v x# comment \\\nv 1 2 3\n";
  EXPECT_EQ(parse(text).positions.size(), 40u);
  EXPECT_EQ(parse(text).warnings.count(), 20);
}

TEST(ParseObj, nul_and_random_bytes_are_survived) {
  using namespace std::string_literals;
  const FlatObj file = parse(four_vertices + "\0\0\xff\xfe\x80 f 1\0\nf\0 1 2 3\nf 1 2 3\n"s);
  EXPECT_EQ(file.faces.size(), 1u);
}

TEST(ParseObj, many_changes_of_material_and_one_endless_line_take_linear_time) {
  std::string materials = four_vertices;
  for (int i = 0; i < 100'000; ++i) {
    materials += "usemtl m" + std::to_string(i % 50'000) + "\nf 1 2 3\n";
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(parse(materials).material_names.size(), 50'001u);
  Progress progress;
  const std::string endless(4 << 20, 'x');
  EXPECT_EQ(parse_obj_in_chunks(endless, "x.obj", 16, progress).face_count, 0u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(ParseObj, a_stop_ends_it) {
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(parse_obj(four_vertices, "x.obj", progress), Cancelled);
}

TEST(ParseObj, progress_ends_complete) {
  Progress progress;
  parse_obj(four_vertices, "x.obj", progress);
  EXPECT_STREQ(progress.stage(), "reading");
  EXPECT_EQ(progress.fraction(), 1.0f);
}

}  // namespace
}  // namespace tracer
