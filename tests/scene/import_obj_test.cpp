// SPDX-License-Identifier: MIT
#include "tracer/scene/import_obj.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tracer {
namespace {

const std::string square = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string textured_face = "f 1/1 2/2 3/3 4/4\n";
const std::string white_ppm = "P6\n1 1\n255\n\xff\xff\xff";

ImportedScene import(const std::filesystem::path& path) {
  Progress progress;
  return import_obj(path, progress);
}

std::string load_error(const std::filesystem::path& path) {
  try {
    import(path);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "";
}

std::string warning(const ImportedScene& imported, size_t index) {
  const auto& messages = imported.warnings.messages();
  return index < messages.size() ? messages[index].text() : "";
}

TEST(ImportObj, joins_mesh_materials_and_textures) {
  const TemporaryFolder folder;
  folder.write(
      "sub/a.mtl",
      "newmtl red\nKd 1 0 0\nmap_Kd ..\\tex\\white.ppm\nnewmtl lamp\nKd 2 -1 0.5\nKe 3 2 1\n"
      "newmtl unused\nmap_Kd missing.png\n");
  folder.write("tex/white.ppm", white_ppm);
  const auto path =
      folder.write("x.obj", square + "mtllib sub\\a.mtl\no square\ng a\nf 1 2 3\nusemtl red\n" +
                                textured_face + "usemtl lamp\nf 2 3 4\nf 1 2 3 4\n");
  const ImportedScene imported = import(path);
  EXPECT_EQ(imported.warnings.count(), 0) << warning(imported, 0);
  EXPECT_EQ(imported.face_count, 4u);
  EXPECT_EQ(imported.dropped_faces, 0);
  EXPECT_EQ(imported.object_count, 1u);
  EXPECT_EQ(imported.group_count, 1u);
  EXPECT_EQ(imported.file_bytes, std::filesystem::file_size(path));

  const std::vector<Material>& materials = *imported.scene.materials;
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[0].scattering.base_color, Vec3f(0.8f));
  EXPECT_EQ(materials[1].name, "red");
  EXPECT_EQ(materials[1].scattering.base_color, Vec3f(1, 0, 0));
  EXPECT_EQ(materials[1].map(MapSlot::base_color).texture, 0u);
  EXPECT_EQ(materials[2].scattering.base_color, Vec3f(1, 0, 0.5f));
  EXPECT_EQ(materials[2].emission, Vec3f(3, 2, 1));
  EXPECT_EQ(materials[2].map(MapSlot::base_color).texture, no_texture);
  ASSERT_EQ(imported.scene.textures->size(), 1u);
  EXPECT_EQ(eval_texture(imported.scene.textures->at(0), Vec2f(0)), Vec3f(1));
  EXPECT_EQ(imported.scene.mesh->material_of(0), 0u);
  EXPECT_EQ(imported.scene.mesh->material_of(1), 1u);
  EXPECT_EQ(imported.scene.mesh->material_of(3), 2u);
  EXPECT_EQ(imported.scene.lights->triangles, (std::vector<uint32_t>{3, 4, 5}));
}

TEST(ImportObj, is_smooth_where_the_file_has_normals_and_flat_elsewhere) {
  const TemporaryFolder folder;
  const ImportedScene flat = import(folder.write("flat.obj", square + "f 1 2 3\n"));
  EXPECT_FALSE(flat.has_normals);
  EXPECT_EQ(flat.scene.shading, Shading::flat);
  const ImportedScene smooth =
      import(folder.write("smooth.obj", square + "vn 0 0 1\nf 1//1 2//1 3//1\n"));
  EXPECT_TRUE(smooth.has_normals);
  EXPECT_EQ(smooth.scene.shading, Shading::smooth);
}

TEST(ImportObj, texture_coordinates_are_kept_where_a_used_material_has_a_texture_alone) {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl plain\nnewmtl mapped\nmap_Kd no.png\n");
  const std::string faces = "f 1/1 2/2 3/3\n";
  const ImportedScene plain =
      import(folder.write("plain.obj", "mtllib m.mtl\n" + square + "usemtl plain\n" + faces));
  EXPECT_EQ(plain.dropped_texcoords, 4u);
  EXPECT_TRUE(plain.scene.mesh->texcoords.empty());
  EXPECT_TRUE(plain.scene.mesh->texcoord_indices.empty());
  // Faulty ones are told even where none is needed.
  const ImportedScene bare = import(folder.write("bare.obj", square + "f 1/1 2/9 3/3\n" + faces));
  EXPECT_EQ(bare.dropped_texcoords, 4u);
  EXPECT_TRUE(bare.scene.mesh->texcoord_indices.empty());
  EXPECT_EQ(bare.scene.mesh->triangle_count(), 2u);
  EXPECT_EQ(bare.warnings.count(), 1);
  const ImportedScene mapped =
      import(folder.write("mapped.obj", "mtllib m.mtl\n" + square + "usemtl mapped\n" + faces));
  EXPECT_EQ(mapped.dropped_texcoords, 0u);
  EXPECT_EQ(mapped.scene.mesh->texcoords.size(), 4u);
}

TEST(ImportObj, a_library_at_the_end_of_a_large_file_has_its_textures) {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl mapped\nmap_Kd white.ppm\n");
  folder.write("white.ppm", white_ppm);
  std::string text = square;
  while (text.size() < 1'000'000) text += textured_face;
  const ImportedScene imported =
      import(folder.write("late.obj", text + "mtllib m.mtl\nusemtl mapped\n" + textured_face));
  EXPECT_EQ(imported.warnings.count(), 0) << warning(imported, 0);
  const Mesh& mesh = *imported.scene.mesh;
  EXPECT_EQ(mesh.texcoords.size(), 4u);
  EXPECT_EQ(mesh.texcoord_indices[mesh.triangle_count() / 2], Vec3u(0, 1, 2));
  EXPECT_EQ(imported.scene.textures->size(), 1u);
  EXPECT_GT(imported.file_bytes, text.size());
}

TEST(ImportObj, a_missing_library_is_a_warning_and_its_materials_are_grey) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "x.obj", square + "mtllib no.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
  const ImportedScene imported = import(path);
  EXPECT_EQ(imported.warnings.count(), 2);
  EXPECT_EQ(warning(imported, 0),
            path.string() + ":9: material library: " + (folder.path() / "no.mtl").string() +
                ": No such file or directory");
  EXPECT_EQ(warning(imported, 1),
            path.string() +
                ":10: material 'a' and 2 more: in no material library, shown in the default grey");
  EXPECT_EQ(imported.scene.materials->at(3).scattering.base_color, Vec3f(0.8f));
}

TEST(ImportObj, libraries_are_read_in_order_and_the_first_definition_counts) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl m\nKd 1 0 0\nnewmtl m\nKd 0 1 0\n");
  folder.write("my b.mtl", "newmtl m\nKd 0 0 1\nnewmtl Material #2\nKd 0 0 1\n");
  const ImportedScene imported = import(
      folder.write("x.obj", "mtllib a.mtl my b.mtl\nmtllib a.mtl\n" + square +
                                "usemtl m #comment\nf 1 2 3\nusemtl Material #2\nf 1 2 3\n"));
  EXPECT_EQ(imported.warnings.count(), 0) << warning(imported, 0);
  EXPECT_EQ(imported.scene.materials->at(1).scattering.base_color, Vec3f(1, 0, 0));
  EXPECT_EQ(imported.scene.materials->at(2).scattering.base_color, Vec3f(0, 0, 1));
}

TEST(ImportObj, tells_the_files_it_depends_on_also_those_that_are_missing) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl m\nmap_Kd white.ppm\nnewmtl unused\nmap_Kd other.ppm\n");
  const auto path =
      folder.write("x.obj", "mtllib a.mtl no.mtl\n" + square + "usemtl m\n" + textured_face);
  const std::vector<std::filesystem::path> expected{folder / "a.mtl", folder / "no.mtl",
                                                    folder / "white.ppm"};
  EXPECT_EQ(import(path).files, expected);
}

TEST(ImportObj, paths_that_leave_the_models_folder_are_refused) {
  const TemporaryFolder folder;
  folder.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
  folder.write("white.ppm", white_ppm);
  const std::string absolute = (folder.path() / "secret.mtl").string();
  for (const std::string& library :
       {absolute, std::string("../secret.mtl"), std::string("sub\\..\\..\\secret.mtl"),
        std::string("C:\\secret.mtl")}) {
    const auto path =
        folder.write("model/x.obj", "mtllib " + library + "\n" + square + "usemtl m\nf 1 2 3\n");
    const ImportedScene imported = import(path);
    EXPECT_NE(warning(imported, 0).find("is refused: paths must stay in the model's folder"),
              std::string::npos)
        << warning(imported, 0);
    EXPECT_EQ(imported.scene.materials->at(1).scattering.base_color, Vec3f(0.8f));
  }
  folder.write("model/a.mtl", "newmtl m\nmap_Kd ../white.ppm\n");
  const ImportedScene imported =
      import(folder.write("model/x.obj", "mtllib a.mtl\n" + square + "usemtl m\n" + textured_face));
  EXPECT_NE(warning(imported, 0).find("map_Kd '../white.ppm' is refused"), std::string::npos);
  EXPECT_EQ(imported.scene.materials->at(1).map(MapSlot::base_color).texture, 0u);
  EXPECT_EQ(imported.scene.textures->at(0).width, make_checker().width);
}

TEST(ImportObj, a_file_of_the_name_stands_in_for_a_path_of_another_machine) {
  const TemporaryFolder folder;
  folder.write("lib/white.ppm", white_ppm);
  for (const std::string written :
       {"/home/somebody/white.ppm", "..\\..\\white.ppm", "C:\\textures\\white.ppm", "C:white.ppm",
        "textures/white.ppm", "white.ppm"}) {
    folder.write("lib/a.mtl", "newmtl m\nmap_Kd " + written + "\n");
    const ImportedScene imported =
        import(folder.write("x.obj", "mtllib lib/a.mtl\n" + square + "usemtl m\n" + textured_face));
    EXPECT_EQ(imported.warnings.count(), 0) << warning(imported, 0);
    EXPECT_EQ(imported.scene.textures->size(), 1u) << written;
  }
  folder.write("b.mtl", "newmtl m\nKd 1 0 0\n");
  const ImportedScene imported =
      import(folder.write("x.obj", "mtllib D:\\b.mtl\n" + square + "usemtl m\nf 1 2 3\n"));
  EXPECT_EQ(imported.warnings.count(), 0) << warning(imported, 0);
  EXPECT_EQ(imported.scene.materials->at(1).scattering.base_color, Vec3f(1, 0, 0));
}

TEST(ImportObj, warnings_name_their_lines_and_stand_in_their_order) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl m\nkd x\n\nmap_kd no.png\n");
  const std::string path =
      folder
          .write("x.obj", "mtllib a.mtl no.mtl\n" + square + "usemtl m\n" + textured_face +
                              "f 1 1 2\nusemtl n\nf 1 2 9\nf 1 2 2\nf 1 2\n")
          .string();
  const ImportedScene imported = import(path);
  const std::string library = (folder.path() / "a.mtl").string();
  const std::vector<std::string> starts = {
      path + ":1: material library: ",    path + ":12: the face has no area",
      path + ":13: material 'n'",         path + ":14: vertex 9 does not exist",
      path + ":15: the face has no area", path + ":16: a face needs",
      library + ":2: Kd: 'x' is not",     library + ":4: map_Kd: "};
  ASSERT_EQ(imported.warnings.count(), static_cast<int64_t>(starts.size()));
  for (size_t i = 0; i < starts.size(); ++i) {
    EXPECT_TRUE(warning(imported, i).starts_with(starts[i])) << warning(imported, i);
  }
}

TEST(ImportObj, bounds_are_the_numbers_of_the_file) {
  const TemporaryFolder folder;
  const ImportedScene imported = import(folder.write(
      "x.obj", "v 0.1 4194304.3 -1e-7\nv 2 4194305.7 3\nv 1.3 4194305 9.9\nf 1 2 3\n"));
  EXPECT_EQ(imported.bounds.min, Vec3d(0.1, 4194304.3, -1e-7));
  EXPECT_EQ(imported.bounds.max, Vec3d(2, 4194305.7, 9.9));
}

TEST(ImportObj, a_broken_texture_is_a_warning_and_the_others_stay_right) {
  const TemporaryFolder folder;
  folder.write("white.ppm", white_ppm);
  folder.write("bad.png", "no image");
  folder.write(
      "a.mtl",
      "newmtl a\nmap_Kd bad.png\nnewmtl b\nmap_Kd missing.png\nnewmtl c\nmap_Kd white.ppm\n"
      "newmtl d\nmap_Kd ./white.ppm\n");
  std::string text = "mtllib a.mtl\n" + square;
  for (const char* name : {"a", "b", "c", "d"})
    text += std::string("usemtl ") + name + '\n' + textured_face;
  const ImportedScene imported = import(folder.write("x.obj", text));
  EXPECT_EQ(imported.warnings.count(), 2);
  EXPECT_NE(warning(imported, 0).find("bad.png: no image that can be read"), std::string::npos);
  EXPECT_NE(warning(imported, 1).find("missing.png: No such file"), std::string::npos);
  // The checker, once, and the white one.
  ASSERT_EQ(imported.scene.textures->size(), 2u);
  EXPECT_EQ(imported.scene.textures->at(0).codes, make_checker().codes);
  const std::vector<Material>& materials = *imported.scene.materials;
  EXPECT_EQ(materials[1].map(MapSlot::base_color).texture, 0u);
  EXPECT_EQ(materials[2].map(MapSlot::base_color).texture, 0u);
  EXPECT_EQ(materials[3].map(MapSlot::base_color).texture, 1u);
  EXPECT_EQ(materials[4].map(MapSlot::base_color).texture, 1u);
}

TEST(ImportObj, a_missing_texture_of_numbers_is_a_warning_and_the_number_counts) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl m\nPr 0.25\nmap_Pr no.png\nnorm no.png\nmap_d no.png\n");
  const ImportedScene imported =
      import(folder.write("x.obj", "mtllib a.mtl\n" + square + "usemtl m\n" + textured_face));
  // Once as numbers, once as normals.
  EXPECT_EQ(imported.warnings.count(), 2);
  const Material& material = imported.scene.materials->at(1);
  EXPECT_FALSE(material.has_maps);
  EXPECT_EQ(material.scattering.roughness, 0.25f);
  EXPECT_FALSE(imported.scene.surfaces.has_alpha);
}

TEST(ImportObj, an_image_is_read_once_a_use) {
  const TemporaryFolder folder;
  folder.write("t/wei\xc3\x9f 1.ppm", white_ppm);
  folder.write("a.mtl",
               "newmtl m\nmap_Kd t\\wei\xc3\x9f 1.ppm\nmap_Pr t/wei\xc3\x9f 1.ppm\n"
               "map_Pm t/./wei\xc3\x9f 1.ppm\nmap_Ke t/wei\xc3\x9f 1.ppm\n");
  const ImportedScene imported =
      import(folder.write("x.obj", "mtllib a.mtl\n" + square + "usemtl m\n" + textured_face));
  EXPECT_EQ(imported.warnings.count(), 0) << warning(imported, 0);
  EXPECT_EQ(imported.scene.textures->size(), 2u);
  EXPECT_EQ(imported.files.size(), 2u);
  const Material& material = imported.scene.materials->at(1);
  EXPECT_EQ(material.map(MapSlot::roughness).texture, material.map(MapSlot::metallic).texture);
  EXPECT_NE(material.map(MapSlot::roughness).texture, material.map(MapSlot::base_color).texture);
  // A texture shines without a Ke.
  EXPECT_EQ(material.emission, Vec3f(1));
}

TEST(ImportObj, textures_that_are_not_shown_are_said_once_a_kind) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl m\ndisp d.png\nnewmtl n\ndisp d.png\nmap_Ps s.png\n");
  const ImportedScene imported =
      import(folder.write("x.obj", "mtllib a.mtl\n" + square + "usemtl m\n" + textured_face +
                                       "usemtl n\n" + textured_face));
  ASSERT_EQ(imported.warnings.count(), 2);
  EXPECT_NE(warning(imported, 0).find("a.mtl:2: disp: textures of this kind are not shown"),
            std::string::npos)
      << warning(imported, 0);
  EXPECT_NE(warning(imported, 1).find("a.mtl:5: map_Ps"), std::string::npos);
}

TEST(ImportObj, textures_without_coordinates_to_use_them_are_not_read) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl m\nmap_Kd missing.png\n");
  const ImportedScene imported =
      import(folder.write("x.obj", "mtllib a.mtl\n" + square + "usemtl m\nf 1 2 3\n"));
  EXPECT_EQ(imported.warnings.count(), 0);
}

TEST(ImportObj, dropped_faces_of_every_kind_are_counted) {
  const TemporaryFolder folder;
  const ImportedScene imported = import(
      folder.write("x.obj", square + "v nan 0 0\nf 1 2\nf 1 2 9\nf 1 2 5\nf 1 1 2\nf 1 2 3\n"));
  EXPECT_EQ(imported.dropped_faces, 4);
  EXPECT_EQ(imported.face_count, 1u);
  EXPECT_EQ(imported.warnings.count(), 4);
}

TEST(ImportObj, what_cannot_be_shown_is_one_clear_line) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_error(folder.path()),
            folder.path().string() + ": this is a directory, not a file");
  EXPECT_EQ(load_error(folder.path() / "no.obj"),
            (folder.path() / "no.obj").string() + ": No such file or directory");
  const auto empty = folder.write("empty.obj", "");
  EXPECT_EQ(load_error(empty), empty.string() + ": no triangles to show: the file is empty");
  const auto text = folder.write("text.obj", "Dear sir or madam,\nfaces and vertices: none\n");
  EXPECT_EQ(load_error(text),
            text.string() + ": no triangles to show: this does not look like an OBJ file");
  const auto binary = folder.write("b.obj", std::string("\x7f"
                                                        "ELF\x02\x01\x01\x00\x00",
                                                        9));
  EXPECT_EQ(load_error(binary),
            binary.string() + ": no triangles to show: this does not look like an OBJ file");
}

TEST(ImportObj, a_stop_ends_it) {
  const TemporaryFolder folder;
  const auto path = folder.write("x.obj", square + "f 1 2 3\n");
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(import_obj(path, progress), Cancelled);
}

/// Triangles that a file's faces make, by counting words: an oracle that shares no code.
uint32_t count_triangles(const std::filesystem::path& path) {
  std::ifstream file(path);
  uint32_t count = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word != "f") continue;
    uint32_t corners = 0;
    while (words >> word) ++corners;
    count += corners - 2;
  }
  return count;
}

TEST(ImportObj, well_known_models_load_whole) {
  const std::filesystem::path models = BOXWOOD_SHARED_DIR "/models";
  if (!std::filesystem::exists(models)) GTEST_SKIP() << models << " is missing";
  for (const char* name : {"cow", "spot", "stanford-bunny", "suzanne", "teapot"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path path = models / (std::string(name) + ".obj");
    const ImportedScene imported = import(path);
    EXPECT_EQ(imported.scene.mesh->triangle_count(), count_triangles(path));
    EXPECT_EQ(imported.dropped_faces, 0);
    for (int i = 0; i < 3; ++i) {
      const Box& bounds = imported.scene.mesh->bounds;
      EXPECT_NEAR(bounds.min[i] + bounds.max[i], 0, 1e-6 * bounds.extent()[i]);
    }
  }
}

}  // namespace
}  // namespace tracer
