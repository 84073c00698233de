// SPDX-License-Identifier: MIT
#include "tracer/obj/make_mesh.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tracer/base/parallel.h"
#include "tracer/obj/parse_obj.h"

namespace tracer {
namespace {

ObjMesh make(std::string_view text) {
  Progress progress;
  ObjFile file = parse_obj(text, "x.obj", progress);
  return make_mesh(file, "x.obj", progress);
}

std::string load_error(std::string_view text) {
  try {
    make(text);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "";
}

const std::string square = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";

TEST(MakeMesh, polygons_become_triangles_about_the_centre) {
  const ObjMesh made = make(square + "f 1 2 3 4\n");
  const Mesh& mesh = made.mesh;
  EXPECT_EQ(mesh.origin, Vec3d(1, 1, 0));
  EXPECT_EQ(mesh.triangles, (LargeVector<Vec3u>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.positions[0], Vec3f(-1, -1, 0));
  EXPECT_EQ(mesh.bounds.min, Vec3f(-1, -1, 0));
  EXPECT_EQ(mesh.bounds.max, Vec3f(1, 1, 0));
  EXPECT_EQ(made.warnings.count(), 0);
}

TEST(MakeMesh, what_no_face_uses_stays_empty) {
  const Mesh mesh = make(square + "vt 0 0\nvn 0 0 1\nusemtl red\nusemtl\nf 1 2 3\n").mesh;
  EXPECT_TRUE(mesh.normals.empty() && mesh.normal_indices.empty());
  EXPECT_TRUE(mesh.texcoords.empty() && mesh.texcoord_indices.empty());
  EXPECT_TRUE(mesh.colors.empty());
  EXPECT_TRUE(mesh.materials.empty());
}

TEST(MakeMesh, survey_coordinates_keep_their_detail) {
  const ObjMesh made = make(
      "v 500000.125 5000000.25 100\nv 500000.25 5000000.25 100\nv 500000.125 5000000.5 100\nf 1 2 "
      "3\n");
  EXPECT_EQ(made.mesh.origin, Vec3d(500000.1875, 5000000.375, 100));
  EXPECT_EQ(made.mesh.positions[0], Vec3f(-0.0625f, -0.125f, 0));
}

TEST(MakeMesh, unused_vertices_do_not_move_the_centre) {
  EXPECT_EQ(make(square + "v 1000 1000 1000\nv nan 1e400 0\nf 1 2 3 4\n").mesh.origin,
            Vec3d(1, 1, 0));
}

TEST(MakeMesh, faces_that_no_float_can_hold_are_dropped_and_the_rest_is_shown) {
  const ObjMesh made = make(square +
                            "v nan 0 0\nv 1e400 0 0\nv 1e39 0 0\nv bad 0 0\nf 1 2 5\nf 1 2 6\nf 1 "
                            "2 7\nf 1 2 8\nf 1 2 3 4\n");
  EXPECT_EQ(made.dropped_faces, 4);
  EXPECT_EQ(made.warnings.count(), 4);
  EXPECT_EQ(made.warnings.messages()[0].text(),
            "x.obj:9: a vertex of the face is not finite, or too large");
  EXPECT_EQ(made.mesh.triangle_count(), 2u);
  EXPECT_EQ(made.mesh.origin, Vec3d(1, 1, 0));
  for (const Vec3f& position : made.mesh.positions) EXPECT_TRUE(is_finite(position));
}

TEST(MakeMesh, the_largest_floats_are_shown) {
  const Mesh mesh = make("v -3e38 0 0\nv 3e38 0 0\nv 0 3e38 3e38\nf 1 2 3\n").mesh;
  EXPECT_EQ(mesh.triangle_count(), 1u);
  for (const Vec3f& position : mesh.positions) EXPECT_TRUE(is_finite(position));
}

TEST(MakeMesh, faces_without_area_are_dropped) {
  const ObjMesh made = make(square + "v 1 1 0\nf 1 1 2\nf 1 5 3\nf 1 2 3\n");
  EXPECT_EQ(made.dropped_faces, 2);
  EXPECT_EQ(made.mesh.triangle_count(), 1u);
  EXPECT_EQ(made.warnings.messages()[1].text(), "x.obj:7: the face has no area");
}

TEST(MakeMesh, normals_are_unit_length_and_those_without_direction_are_none) {
  const Mesh mesh =
      make(square +
           "vn 0 0 5\nvn 0 0 0\nvn nan 0 1\nvn 1e-30 0 0\nf 1//1 2//2 3//3\nf 1//4 3 4//1\n")
          .mesh;
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
  EXPECT_EQ(mesh.normals[3], Vec3f(1, 0, 0));
  EXPECT_EQ(mesh.normal_indices, (LargeVector<Vec3u>{{0, no_index, no_index}, {3, no_index, 0}}));
}

TEST(MakeMesh, texture_coordinates_and_materials_follow_their_triangles) {
  const Mesh mesh =
      make(square + "vt 0 0\nvt 1 0\nvt 1 1\nf 1 2 3\nusemtl red\nf 1/1 2/2 3/3 4\n").mesh;
  ASSERT_EQ(mesh.triangle_count(), 3u);
  EXPECT_EQ(mesh.texcoord_indices[0], Vec3u(no_index));
  EXPECT_EQ(mesh.texcoord_indices[1], Vec3u(0, 1, 2));
  EXPECT_EQ(mesh.texcoord_indices[2], Vec3u(0, 2, no_index));
  EXPECT_EQ(mesh.materials, (LargeVector<uint32_t>{0, 1, 1}));
}

TEST(MakeMesh, texture_coordinates_nobody_needs_are_dropped_as_they_are_read) {
  const std::string vertices = square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
  const std::string faces = "f 1/1/1 2/2/1 3/3/1 4/1/1\nf 1/1 2/2 3/3\nf 2//1 3//1 4//1\nf 1 3 4\n";
  const auto parse = [](const std::string& text) {
    Progress progress;
    return parse_obj_in_chunks(text, "x.obj", 16, progress, Texcoords::dropped);
  };
  Progress progress;
  ObjFile bare = parse(vertices + faces);
  EXPECT_FALSE(bare.lacks_texcoords);
  EXPECT_EQ(bare.counts.texcoords, 3u);
  const Mesh mesh = make_mesh(bare, "x.obj", progress, Texcoords::dropped).mesh;
  const Mesh whole = make(vertices + faces).mesh;
  EXPECT_EQ(mesh.triangles, whole.triangles);
  EXPECT_EQ(mesh.normal_indices, whole.normal_indices);
  EXPECT_TRUE(mesh.texcoord_indices.empty());

  // Named at the begin, the library is known before the first is dropped.
  const ObjFile named = parse("mtllib a.mtl\n" + vertices + faces);
  EXPECT_FALSE(named.lacks_texcoords);
  EXPECT_TRUE(has_texcoord(named.chunks.back().chunk.runs[0].form) ||
              has_texcoord(named.chunks[named.chunks.size() - 2].chunk.runs[0].form));
  EXPECT_TRUE(parse(vertices + faces + "mtllib a.mtl\n").lacks_texcoords);
  EXPECT_TRUE(parse(vertices + "f 1/1 2/2 3/4\n").lacks_texcoords);
  // Relative ones are kept, and so are their faults.
  const ObjFile relative = parse(vertices + "f 1/-1 2/-2 3/-4\n");
  EXPECT_FALSE(relative.lacks_texcoords);
  EXPECT_EQ(relative.warnings.count(), 1);
}

TEST(MakeMesh, colors_run_from_0_to_1_or_from_0_to_255_and_default_to_white) {
  const Mesh unit = make("v 0 0 0 0.5 0 1\nv 1 0 0\nv 0 1 0 nan 0 0\nf 1 2 3\n").mesh;
  EXPECT_EQ(unit.colors, (LargeVector<Vec3f>{{0.5f, 0, 1}, {1, 1, 1}, {1, 1, 1}}));
  const Mesh bytes = make("v 0 0 0 255 0 51\nv 1 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n").mesh;
  EXPECT_EQ(bytes.colors, (LargeVector<Vec3f>{{1, 0, 0.2f}, {1, 1, 1}, {0, 0, 0}}));
}

TEST(MakeMesh, nothing_to_show_is_an_error_that_says_why) {
  EXPECT_EQ(load_error("hello\nworld\n"),
            "x.obj: no triangles to show: this does not look like an OBJ file");
  EXPECT_EQ(load_error(square), "x.obj: no triangles to show: the file has vertices, but no faces");
  EXPECT_EQ(load_error("f 1 2 3\n"),
            "x.obj: no triangles to show: its only face is faulty (line 1: vertex 1 does not exist "
            "(the file has 0))");
  EXPECT_EQ(
      load_error(square + "f 1 1 2\nf 0 1 2\nf 1 2\n"),
      "x.obj: no triangles to show: all 3 faces are faulty (line 6: face index 0: OBJ indices "
      "start at 1)");
}

TEST(MakeMesh, a_mesh_does_not_depend_on_the_number_of_threads) {
  std::string text;
  for (int i = 0; i < 30'000; ++i) {
    const std::string x = std::to_string(i % 173), y = std::to_string(i / 173);
    text += (i % 997 == 0 ? "v nan " : "v " + x + ".1 ") + y + ".7 " +
            std::to_string(i * 7919 % 13) + "\nvt 0." + x + " 0\nvn 0 1 " + y + "\n";
    if (i % 100 == 0)
      text += "usemtl m" + std::to_string(i % 7) + "\nf 1 2 " + std::to_string(i * 3) + "\n";
    if (i > 200) text += "f -1/-1/-1 -2/-2/-2 -175//-175 -174\n";
  }
  const auto make_on = [&](int thread_count) {
    return with_thread_count(thread_count, [&] { return make(text); });
  };
  const ObjMesh one = make_on(1);
  ASSERT_GT(one.dropped_faces, 0);
  for (const int thread_count : {2, 7}) {
    const ObjMesh other = make_on(thread_count);
    EXPECT_EQ(other.mesh.origin, one.mesh.origin);
    EXPECT_EQ(other.mesh.positions, one.mesh.positions);
    EXPECT_EQ(other.mesh.triangles, one.mesh.triangles);
    EXPECT_EQ(other.mesh.normal_indices, one.mesh.normal_indices);
    EXPECT_EQ(other.mesh.texcoord_indices, one.mesh.texcoord_indices);
    EXPECT_EQ(other.mesh.materials, one.mesh.materials);
    EXPECT_EQ(other.dropped_faces, one.dropped_faces);
    ASSERT_EQ(other.warnings.messages().size(), one.warnings.messages().size());
    EXPECT_EQ(other.warnings.messages().back().text(), one.warnings.messages().back().text());
  }
}

TEST(MakeMesh, a_stop_ends_it) {
  Progress progress;
  ObjFile file = parse_obj(square + "f 1 2 3\n", "x.obj", progress);
  progress.request_stop();
  EXPECT_THROW(make_mesh(file, "x.obj", progress), Cancelled);
}

}  // namespace
}  // namespace tracer
