// SPDX-License-Identifier: MIT
#include "tracer/scene/map_material.h"

#include <gtest/gtest.h>

#include "tracer/scene/bsdf_features.h"

namespace tracer {
namespace {

Material mapped(const std::string& statements) {
  const MtlFile file = parse_mtl("newmtl a\n" + statements, "x.mtl");
  EXPECT_EQ(file.warnings.count(), 0) << statements;
  return map_material(file.materials.at(0));
}

TEST(MapMaterial, exporters_materials_are_what_their_makers_meant) {
  const struct {
    const char* exporter;
    const char* statements;
    float metallic, roughness, specular, transmission, opacity;
  } cases[] = {
      {"Blender 3, default",
       "Ns 250\nKa 1 1 1\nKd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\nNi 1.45\nd 1\nillum 2", 0, 0.5f, 0.5f, 0,
       1},
      {"Blender 3, metal", "Ns 640\nKa 1 1 1\nKd 1 0.8 0.3\nKs 0.5 0.5 0.5\nNi 1.45\nd 1\nillum 3",
       1, 0.2f, 0.5f, 0, 1},
      {"Blender 3, half a metal", "Ns 0\nKa 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nNi 1.45\nd 1\nillum 3",
       0.5f, 1, 0.5f, 0, 1},
      {"Blender 3, alpha", "Ns 250\nKa 1 1 1\nKs 0.5 0.5 0.5\nNi 1.45\nd 0.25\nillum 9", 0, 0.5f,
       0.5f, 0, 0.25f},
      {"Blender 3, no specular", "Ns 250\nKa 1 1 1\nKs 0 0 0\nNi 1.45\nd 1\nillum 1", 0, 0.5f, 0, 0,
       1},
      {"Blender 4, glass",
       "Kd 1 1 1\nKs 0.5 0.5 0.5\nKe 0 0 0\nNi 1.45\nd 1\nillum 2\nPr 0\nPm 0\nPs 0\nPc 0\nPcr "
       "0.03\naniso 0\nanisor 0\nTf 1 1 1",
       0, 0, 0.5f, 1, 1},
      {"Blender 4, metal", "Kd 1 1 1\nKs 0.5 0.5 0.5\nNi 1.5\nd 1\nillum 3\nPr 0.3\nPm 1", 1, 0.3f,
       0.5f, 0, 1},
      {"MeshLab", "Ka 0.2 0.2 0.2\nKd 1 1 1\nKs 1 1 1\nTr 0\nillum 2\nNs 0", 0, 1, 1, 0, 1},
      {"ZBrush", "Kd 1 1 1\nKs 0 0 0\nd 1\nillum 2", 0, 0, 0, 0, 1},
      {"Rhino", "Ka 0 0 0\nKd 0.5 0.5 0.5\nKs 1 1 1\nTf 0 0 0\nd 1\nNs 1000\nNi 1\nillum 2", 0, 0,
       1, 0, 1},
      {"Maya, opaque", "illum 4\nKd 0.5 0.5 0.5\nKa 0 0 0\nTf 1 1 1\nNi 1", 0, 1, 0, 0, 1},
      {"photogrammetry", "Ka 1 1 1\nKd 1 1 1\nKs 1 1 1\nd 1\nNs 300\nillum 1", 0, 0.4522774f, 0, 0,
       1},
      {"classic glass", "Kd 0 0 0\nKs 1 1 1\nTf 1 1 1\nNi 1.5\nd 0.1\nNs 1000\nillum 7", 0, 0, 1, 1,
       1},
      {"Kd alone", "Kd 0.5 0.5 0.5", 0, 1, 0, 0, 1},
  };
  for (const auto& expected : cases) {
    const Material material = mapped(expected.statements);
    EXPECT_FLOAT_EQ(material.scattering.metallic, expected.metallic) << expected.exporter;
    EXPECT_NEAR(material.scattering.roughness, expected.roughness, 1e-6f) << expected.exporter;
    EXPECT_FLOAT_EQ(material.scattering.specular, expected.specular) << expected.exporter;
    EXPECT_FLOAT_EQ(material.scattering.transmission, expected.transmission) << expected.exporter;
    EXPECT_FLOAT_EQ(material.opacity, expected.opacity) << expected.exporter;
  }
}

TEST(MapMaterial, without_highlights_it_is_lambert) {
  for (const char* statements : {"", "Kd 1 1 1", "Ks 1 1 1\nillum 1", "Ks 1 1 1\nillum 0",
                                 "Ks 0 0 0\nillum 2", "Ka 1 1 1\nTf 1 1 1\nillum 1\nNi 1.5"}) {
    EXPECT_TRUE(is_lambert(mapped(statements).scattering)) << statements;
  }
  EXPECT_EQ(mapped("").scattering.base_color, Vec3f(0.8f));
}

TEST(MapMaterial, roughness_and_metal_of_the_extension_override) {
  const Principled p =
      mapped(
          "Ns 1000\nKa 1 1 1\nillum 3\nPr 0.75\nPm 0.25\nPs 0.1\nPc 0.2\nPcr 0.3\naniso "
          "0.4\nanisor 0.5")
          .scattering;
  EXPECT_EQ(p.roughness, 0.75f);
  EXPECT_EQ(p.metallic, 0.25f);
  EXPECT_EQ(p.sheen, 0.1f);
  EXPECT_EQ(p.coat, 0.2f);
  EXPECT_EQ(p.coat_roughness, 0.3f);
  EXPECT_EQ(p.anisotropy, 0.4f);
  EXPECT_EQ(p.anisotropy_turns, 0.5f);
}

TEST(MapMaterial, classic_glass_is_tinted_by_its_filter) {
  const Principled p = mapped("Kd 0 0 0\nTf 0.5 0.25 0\nNi 1.5\nillum 4").scattering;
  EXPECT_EQ(p.transmission, 0.5f);
  EXPECT_EQ(p.base_color, Vec3f(0.5f, 0.25f, 0));
  EXPECT_EQ(p.ior, 1.5f);
}

TEST(MapMaterial, values_out_of_range_are_brought_into_it) {
  const Material m = mapped(
      "Kd 2 -1 0.5\nKe 3 -2 1\nKs 9 9 9\nNs -5\nNi 0\nd 7\nillum 4\nPr -1\nPm 5\nPs -1\nPc 2\n"
      "Pcr 2\naniso 2\nanisor -2\nTf 9 9 9");
  EXPECT_EQ(m.scattering.base_color, Vec3f(1, 0, 0.5f));
  EXPECT_EQ(m.emission, Vec3f(3, 0, 1));
  EXPECT_EQ(m.scattering.roughness, 0);
  EXPECT_EQ(m.scattering.metallic, 1);
  EXPECT_EQ(m.scattering.specular, 1);
  EXPECT_EQ(m.scattering.sheen, 0);
  EXPECT_EQ(m.scattering.coat, 1);
  EXPECT_EQ(m.scattering.coat_roughness, 1);
  EXPECT_EQ(m.scattering.anisotropy, 1);
  EXPECT_EQ(m.scattering.anisotropy_turns, 0);
  EXPECT_EQ(m.scattering.transmission, 1);
  EXPECT_EQ(m.scattering.ior, 1);
  EXPECT_EQ(m.opacity, 1);
}

TEST(MapMaterial, options_of_a_map_say_where_and_what_to_look_up) {
  const MtlMaterial m =
      parse_mtl("newmtl a\nmap_Pr -s 2 3 -o 0.5 0.25 -mm 0.1 0.2 -clamp on -imfchan b a.png\n", "x")
          .materials.at(0);
  const MaterialMap map = map_lookup(m.map(MtlSlot::pr), MapSlot::roughness);
  EXPECT_EQ(map.scale, Vec2f(2, 3));
  EXPECT_EQ(map.offset, Vec2f(0.5f, 0.25f));
  EXPECT_EQ(map.base, 0.1f);
  EXPECT_EQ(map.gain, 0.2f);
  EXPECT_EQ(map.wrapping, Wrapping::clamp);
  EXPECT_EQ(map.channel, TexelChannel::blue);
  EXPECT_EQ(map_lookup({}, MapSlot::opacity).channel, TexelChannel::alpha);
  EXPECT_EQ(map_lookup({}, MapSlot::roughness).channel, TexelChannel::luminance);
}

}  // namespace
}  // namespace tracer
