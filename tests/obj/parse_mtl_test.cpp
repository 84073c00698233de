// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_mtl.h"

#include <gtest/gtest.h>

namespace tracer {
namespace {

MtlMaterial only(std::string_view text) {
  const MtlFile file = parse_mtl(text, "x.mtl");
  EXPECT_EQ(file.materials.size(), 1u);
  EXPECT_EQ(file.warnings.count(), 0) << file.warnings.messages()[0].text();
  return file.materials.at(0);
}

TEST(ParseMtl, reads_a_material_as_blender_writes_it) {
  const MtlMaterial m = only(
      "# Blender 3.4.1 MTL File: 'None'\n# www.blender.org\n\nnewmtl Red Paint.001\n"
      "Ns 250.000000\nKa 1.000000 1.000000 1.000000\nKd 0.800000 0.100000 0.000000\n"
      "Ks 0.500000 0.500000 0.250000\nKe 1.5 0.0 0.0\nNi 1.450000\nd 0.750000\nillum 2\n"
      "map_Kd textures/red paint.png\n");
  EXPECT_EQ(m.name, "Red Paint.001");
  EXPECT_EQ(m.kd, Vec3f(0.8f, 0.1f, 0));
  EXPECT_EQ(m.ks, Vec3f(0.5f, 0.5f, 0.25f));
  EXPECT_EQ(m.ke, Vec3f(1.5f, 0, 0));
  EXPECT_EQ(m.ns, 250);
  EXPECT_EQ(m.ni, 1.45f);
  EXPECT_EQ(m.d, 0.75f);
  EXPECT_EQ(m.illum, 2);
  EXPECT_EQ(m.map(MtlSlot::kd).path, "textures/red paint.png");
}

TEST(ParseMtl, keywords_in_any_case_crlf_tabs_bom_and_comments_are_read) {
  const MtlMaterial m =
      only("\xef\xbb\xbfNEWMTL a # first\r\n\tKD 0 \\\r\n 1 0\r\nmap_kd a.png # x\r\n# end");
  EXPECT_EQ(m.name, "a");
  EXPECT_EQ(m.kd, Vec3f(0, 1, 0));
  EXPECT_EQ(m.map(MtlSlot::kd).path, "a.png");
}

TEST(ParseMtl, options_of_a_map_are_not_part_of_its_path) {
  EXPECT_EQ(only("newmtl a\nmap_Kd -s 1 1 1 -bm 2 my file.png\n").map(MtlSlot::kd).path,
            "my file.png");
  EXPECT_EQ(only("newmtl a\nmap_Kd -o 0.5 -clamp on -blendu off a.png\n").map(MtlSlot::kd).path,
            "a.png");
  EXPECT_EQ(
      only("newmtl a\nmap_Kd -mm 0 1 -texres 8 -imfchan r sub\\b.png\n").map(MtlSlot::kd).path,
      "sub\\b.png");
  EXPECT_EQ(only("newmtl a\nmap_Kd -7.png\n").map(MtlSlot::kd).path, "-7.png");
}

TEST(ParseMtl, tr_is_one_minus_d_and_d_counts_where_both_are) {
  EXPECT_EQ(only("newmtl a\nTr 0.25\n").d, 0.75f);
  EXPECT_EQ(only("newmtl a\nd 0.5\nTr 0.25\n").d, 0.5f);
  EXPECT_EQ(only("newmtl a\nTr 0.25\nd 0.5\n").d, 0.5f);
  EXPECT_EQ(only("newmtl a\nd -halo 0.5\n").d, 0.5f);
  EXPECT_EQ(parse_mtl("newmtl a\nd 0.5\nnewmtl b\nTr 0.25\n", "x.mtl").materials.at(1).d, 0.75f);
}

TEST(ParseMtl, one_number_is_grey) {
  EXPECT_EQ(only("newmtl a\nKd 0.5\n").kd, Vec3f(0.5f));
}

TEST(ParseMtl, malformed_values_are_said_and_leave_the_default) {
  const struct {
    const char* line;
    const char* message;
  } faults[] = {
      {"Kd 1 2", "x.mtl:2: Kd: a number is missing"},
      {"Kd", "x.mtl:2: Kd: a number is missing"},
      {"Kd red", "x.mtl:2: Kd: 'red' is not a finite number"},
      {"Kd spectral a.rfl 1", "x.mtl:2: Kd: 'spectral' is not a finite number"},
      {"Ke nan 0 0", "x.mtl:2: Ke: 'nan' is not a finite number"},
      {"Ke 0 1e400 0", "x.mtl:2: Ke: '1e400' is not a finite number"},
      {"Ns 1e39", "x.mtl:2: Ns: '1e39' is not a finite number"},
      {"illum x", "x.mtl:2: illum: 'x' is not a finite number"},
      {"map_Kd", "x.mtl:2: map_Kd: the path is missing"},
  };
  for (const auto& fault : faults) {
    const MtlFile file = parse_mtl(std::string("newmtl a\n") + fault.line + "\nNi 2\n", "x.mtl");
    ASSERT_EQ(file.warnings.count(), 1) << fault.line;
    EXPECT_EQ(file.warnings.messages()[0].text(), fault.message);
    EXPECT_EQ(file.materials.at(0).kd, Vec3f(0.8f));
    EXPECT_EQ(file.materials.at(0).ke, Vec3f(0.0f));
    EXPECT_EQ(file.materials.at(0).ni, 2);
  }
}

TEST(ParseMtl, values_before_the_first_material_are_said) {
  const MtlFile file = parse_mtl("Kd 1 1 1\nnewmtl a\n", "x.mtl");
  ASSERT_EQ(file.warnings.count(), 1);
  EXPECT_EQ(file.warnings.messages()[0].text(), "x.mtl:1: Kd stands before the first newmtl");
}

TEST(ParseMtl, reads_the_extension_for_physically_based_materials) {
  const MtlMaterial m = only(
      "newmtl a\nPr 0.25\nPm 1\nPs 0.5\nPc 0.75\nPcr 0.125\naniso 0.3\nanisor 0.6\n"
      "Tf 0.5 0.25 1\nKa 0.1 0.2 0.3\nmap_Pr r.png\nmap_Pm m.png\nmap_Ps s.png\n"
      "map_Ke e.png\nnorm n.png\n");
  EXPECT_EQ(m.pr, 0.25f);
  EXPECT_EQ(m.pm, 1.0f);
  EXPECT_EQ(m.ps, 0.5f);
  EXPECT_EQ(m.pc, 0.75f);
  EXPECT_EQ(m.pcr, 0.125f);
  EXPECT_EQ(m.aniso, 0.3f);
  EXPECT_EQ(m.anisor, 0.6f);
  EXPECT_EQ(m.tf, Vec3f(0.5f, 0.25f, 1));
  EXPECT_EQ(m.ka, Vec3f(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.map(MtlSlot::pr).path, "r.png");
  EXPECT_EQ(m.map(MtlSlot::pm).path, "m.png");
  EXPECT_EQ(m.map(MtlSlot::ps).path, "s.png");
  EXPECT_EQ(m.map(MtlSlot::ke).path, "e.png");
  EXPECT_EQ(m.map(MtlSlot::norm).path, "n.png");
}

TEST(ParseMtl, several_keywords_name_a_bump_or_a_metal_texture) {
  for (const char* keyword : {"bump", "map_Bump", "map_bump", "MAP_BUMP"}) {
    const MtlMaterial m = only(std::string("newmtl a\n") + keyword + " -bm 0.5 b.png\n");
    EXPECT_EQ(m.map(MtlSlot::bump).path, "b.png") << keyword;
    EXPECT_EQ(m.map(MtlSlot::bump).bump_strength, 0.5f) << keyword;
  }
  EXPECT_EQ(only("newmtl a\nmap_refl m.png\n").map(MtlSlot::pm).path, "m.png");
  EXPECT_EQ(only("newmtl a\nrefl -type sphere r.png\n").map(MtlSlot::refl).path, "r.png");
}

TEST(ParseMtl, options_of_a_map_are_read) {
  const MtlMap map =
      only(
          "newmtl a\nmap_Kd -s 2 3 1 -o 0.5 -mm 0.25 0.5 -clamp on -imfchan G -t 1 1 1 \"my "
          "file.png\"\n")
          .map(MtlSlot::kd);
  EXPECT_EQ(map.path, "my file.png");
  EXPECT_EQ(map.scale, Vec2f(2, 3));
  EXPECT_EQ(map.offset, Vec2f(0.5f, 0));
  EXPECT_EQ(map.base, 0.25f);
  EXPECT_EQ(map.gain, 0.5f);
  EXPECT_TRUE(map.is_clamped);
  EXPECT_EQ(map.channel, 'g');
}

TEST(ParseMtl, options_cut_short_leave_their_defaults) {
  const MtlMap map =
      only("newmtl a\nmap_Kd -s x -clamp maybe -imfchan q -bm nan a.png\n").map(MtlSlot::kd);
  EXPECT_EQ(map.path, "a.png");
  EXPECT_EQ(map.scale, Vec2f(1));
  EXPECT_FALSE(map.is_clamped);
  EXPECT_EQ(map.channel, 0);
  EXPECT_EQ(map.bump_strength, 1);
  EXPECT_EQ(parse_mtl("newmtl a\nmap_Kd -imfchan", "x.mtl").warnings.count(), 1);
}

TEST(ParseMtl, what_is_not_written_is_told_from_what_is) {
  const MtlMaterial m = only("newmtl a\n");
  EXPECT_FALSE(m.ka || m.tf || m.ns || m.ni || m.illum || m.pr || m.pm);
  EXPECT_EQ(only("newmtl a\nNs 0\n").ns, 0.0f);
}

TEST(ParseMtl, every_slot_has_a_keyword_that_names_it) {
  for (size_t i = 0; i < mtl_slot_count; ++i) {
    const std::string keyword(keyword_of(static_cast<MtlSlot>(i)));
    EXPECT_EQ(only("newmtl a\n" + keyword + " x.png\n").maps[i].path, "x.png") << keyword;
  }
}

TEST(ParseMtl, other_keywords_are_passed_over) {
  EXPECT_EQ(only("newmtl a\nmap_Ka -bm 1 b.png\nsharpness 60\nmap_aat on\n").name, "a");
}

}  // namespace
}  // namespace tracer
