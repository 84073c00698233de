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
  EXPECT_EQ(m.map_kd, "textures/red paint.png");
}

TEST(ParseMtl, keywords_in_any_case_crlf_tabs_bom_and_comments_are_read) {
  const MtlMaterial m =
      only("\xef\xbb\xbfNEWMTL a # first\r\n\tKD 0 \\\r\n 1 0\r\nmap_kd a.png # x\r\n# end");
  EXPECT_EQ(m.name, "a");
  EXPECT_EQ(m.kd, Vec3f(0, 1, 0));
  EXPECT_EQ(m.map_kd, "a.png");
}

TEST(ParseMtl, options_of_a_map_are_skipped) {
  EXPECT_EQ(only("newmtl a\nmap_Kd -s 1 1 1 -bm 2 my file.png\n").map_kd, "my file.png");
  EXPECT_EQ(only("newmtl a\nmap_Kd -o 0.5 -clamp on -blendu off a.png\n").map_kd, "a.png");
  EXPECT_EQ(only("newmtl a\nmap_Kd -mm 0 1 -texres 8 -imfchan r sub\\b.png\n").map_kd,
            "sub\\b.png");
  EXPECT_EQ(only("newmtl a\nmap_Kd -7.png\n").map_kd, "-7.png");
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

TEST(ParseMtl, other_keywords_are_passed_over) {
  EXPECT_EQ(only("newmtl a\nPr 0.5\nmap_Bump -bm 1 b.png\nTf 1 1 1\nsharpness 60\nrefl -type "
                 "sphere r.png\n")
                .name,
            "a");
}

}  // namespace
}  // namespace tracer
