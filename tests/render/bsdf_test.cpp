// SPDX-License-Identifier: MIT
#include "tracer/render/bsdf.h"

#include <gtest/gtest.h>

#include "tests/support/bsdf_cases.h"
#include "tracer/render/sampler.h"

namespace tracer {
namespace {

using test::direction_at;
using test::integrate_above;
using test::integrate_below;
using test::with_roughness;
using AnyBsdf = Bsdf<BsdfFeatures::all>;

constexpr double roughnesses[] = {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1};
constexpr double cosines[] = {0.03, 0.05, 0.1, 0.2, 0.4, 0.7, 0.9, 1};

/// Of a material whose layers are all of this roughness.
double albedo_above(const Principled& p, const Vec3d& wo, Side side = Side::outside) {
  const AnyBsdf bsdf(p, wo, side);
  const double alpha = make_ggx(p.roughness, p.anisotropy).alpha_y;
  return integrate_above(wo, alpha, [&](const Vec3d& wi) { return bsdf.eval(wi).value.x; });
}

TEST(Bsdf, without_any_layer_is_exactly_lamberts) {
  const Principled p{.base_color = Vec3f(0.2f, 0.5f, 0.75f), .roughness = 0.3f};
  Sampler sampler(0, 0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d wo = direction_at(1 - sampler.next(), sampler.next());
    const Vec3d wi = direction_at(1 - sampler.next(), sampler.next());
    const AnyBsdf bsdf(p, wo);
    const double pdf = wi.z / std::numbers::pi;
    ASSERT_EQ(bsdf.eval(wi).pdf, pdf);
    ASSERT_EQ(bsdf.eval(wi).value, Vec3d(p.base_color) * pdf);
    ASSERT_EQ(bsdf.eval(-wi).value, Vec3d(0));
  }
}

TEST(BsdfFurnace, white_layers_reflect_all_light_to_1e_4_at_every_roughness_and_angle) {
  for (const auto& [name, material] : test::white_materials()) {
    for (const double roughness : roughnesses) {
      for (const double cosine : cosines) {
        const Principled p = with_roughness(material, roughness);
        EXPECT_NEAR(albedo_above(p, direction_at(cosine, 0.1)), 1, 1e-4)
            << name << ' ' << roughness << ' ' << cosine;
      }
    }
  }
}

TEST(BsdfFurnace, facets_alone_lose_what_compensation_gives_back) {
  // The control: the same integral without the second bounce between facets.
  const AlbedoTables& tables = albedo_tables();
  const Vec3d wo = direction_at(0.7, 0);
  MicrofacetLayer layer(tables, 1, 0);
  layer.add(1, {Vec3d(1), 1});
  const double once =
      integrate_above(wo, 1, [&](const Vec3d& wi) { return layer.eval_single(wo, wi).value.x; });
  EXPECT_LT(once, 0.7);
  EXPECT_NEAR(once, tables.ggx(tables.row(1), 0.7).full, 1e-4);
}

TEST(BsdfFurnace, layers_over_layers_lose_little_light_and_make_none) {
  for (const auto& [name, material] : test::layered_materials()) {
    for (const double roughness : roughnesses) {
      for (const double cosine : cosines) {
        const double albedo =
            albedo_above(with_roughness(material, roughness), direction_at(cosine, 0.1));
        EXPECT_LT(albedo, name == "anisotropic metal" ? 1.04 : 1 + 1e-4)
            << name << ' ' << roughness << ' ' << cosine;
        EXPECT_GT(albedo, name == "anisotropic metal" ? 0.75 : 0.9)
            << name << ' ' << roughness << ' ' << cosine;
      }
    }
  }
}

/// The mean weight of samples that fill the cube of random numbers evenly.
double mean_weight(const AnyBsdf& bsdf, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto turned = [i](double step) { return std::fmod(0.5 + i * step, 1.0); };
    sum += bsdf.sample(turned(0.8191725133961645),
                       {turned(0.6710436067037893), turned(0.5497004779019703)})
               .weight.x;
  }
  return sum / count;
}

TEST(BsdfFurnace, smooth_surfaces_reflect_and_transmit_all_light) {
  for (const auto& materials : {test::white_materials(), test::clear_materials()}) {
    for (const auto& [name, material] : materials) {
      for (const Side side : {Side::outside, Side::inside}) {
        for (const double cosine : cosines) {
          const AnyBsdf bsdf(with_roughness(material, 0), direction_at(cosine, 0.2), side);
          // A coat and the glass below it are told apart only by Schlick's and Fresnel's formulas.
          EXPECT_NEAR(mean_weight(bsdf, 10'000), 1, name == "coated glass" ? 0.03 : 2e-3)
              << name << ' ' << cosine;
        }
      }
    }
  }
}

TEST(BsdfFurnace, rough_glass_reflects_and_transmits_all_light_to_1_percent_on_average) {
  double sum = 0;
  int count = 0;
  for (const double ior : {1.1, 1.33, 1.5, 2.0, 2.5}) {
    for (const Side side : {Side::outside, Side::inside}) {
      for (const double roughness : {0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
        for (const double cosine : {0.1, 0.4, 0.7, 1.0}) {
          const Principled p{.base_color = Vec3f(1),
                             .roughness = static_cast<float>(roughness),
                             .transmission = 1,
                             .ior = static_cast<float>(ior)};
          const double error = mean_weight(AnyBsdf(p, direction_at(cosine, 0.1), side), 32000) - 1;
          // The kink at the critical angle is what the tables of light from inside smear.
          EXPECT_LT(std::abs(error), side == Side::inside ? 0.04 : 0.015)
              << ior << ' ' << roughness << ' ' << cosine
              << (side == Side::inside ? " inside" : "");
          sum += std::abs(error);
          ++count;
        }
      }
    }
  }
  EXPECT_LT(sum / count, 0.01);
}

double uniform(Sampler& sampler, double low, double high) {
  return low + (high - low) * sampler.next();
}

TEST(Bsdf, is_reciprocal_for_a_million_pairs_of_directions) {
  const auto materials = test::all_materials();
  Sampler sampler(0, 0, 3);
  for (int i = 0; i < 1'000'000; ++i) {
    Principled p = materials[static_cast<size_t>(i) % materials.size()].p;
    p = with_roughness(p, uniform(sampler, 0.02, 1));
    const Vec3d wo = direction_at(1 - sampler.next(), sampler.next());
    Vec3d wi = direction_at(1 - sampler.next(), sampler.next());
    const bool is_through = p.transmission > 0 && i % 2 == 0;
    // Radiance counts per squared index.
    const double squared_index = is_through ? p.ior * double(p.ior) : 1;
    const AnyBsdf forth(p, wo, Side::outside);
    const AnyBsdf back(p, wi, is_through ? Side::inside : Side::outside);
    const double there = forth.eval(is_through ? -wi : wi).value.x / wi.z;
    const double here = back.eval(is_through ? -wo : wo).value.x / wo.z * squared_index;
    ASSERT_NEAR(there, here, 1e-7 * (there + here) + 1e-300) << i;
  }
}

TEST(Bsdf, values_and_pdfs_of_a_million_pairs_are_numbers_not_below_0) {
  const auto materials = test::all_materials();
  Sampler sampler(0, 0, 4);
  for (int i = 0; i < 1'000'000; ++i) {
    const Principled p = with_roughness(materials[static_cast<size_t>(i) % materials.size()].p,
                                        std::max(0.0, uniform(sampler, -0.1, 1)));
    // Grazing ones among them.
    const double cosine = i % 3 == 0 ? std::pow(1 - sampler.next(), 8) : 1 - sampler.next();
    const Vec3d wo = direction_at(cosine, sampler.next());
    const AnyBsdf bsdf(p, wo, i % 5 == 0 ? Side::inside : Side::outside);
    const Vec3d wi = direction_at(uniform(sampler, -1, 1), sampler.next());
    const BsdfValue found = bsdf.eval(wi);
    ASSERT_TRUE(is_finite(found.value) && std::isfinite(found.pdf)) << i;
    ASSERT_GE(std::min({found.value.x, found.value.y, found.value.z, found.pdf}), 0) << i;
    const BsdfSample sample = bsdf.sample(sampler.next(), sampler.next_2d());
    ASSERT_TRUE(is_finite(sample.wi) && is_finite(sample.weight)) << i;
    ASSERT_GE(std::min({sample.weight.x, sample.weight.y, sample.weight.z, sample.pdf}), 0) << i;
    if (sample.pdf == 0) continue;
    ASSERT_NEAR(glm::length(sample.wi), 1, 1e-9) << i;
  }
}

TEST(Bsdf, anisotropic_highlights_are_longer_across_their_axis) {
  const Principled p{.metallic = 1, .roughness = 0.5f, .anisotropy = 0.9f};
  const Vec3d wo(0, 0, 1);
  const AnyBsdf bsdf(p, wo);
  EXPECT_GT(bsdf.eval(direction_at(0.7, 0)).value.x,
            2 * bsdf.eval(direction_at(0.7, 0.25)).value.x);
}

TEST(Bsdf, kernels_without_a_feature_have_the_bits_of_those_with_it) {
  using enum BsdfFeatures;
  Sampler sampler(0, 0, 5);
  for (const auto& [name, material] : test::all_materials()) {
    for (int i = 0; i < 200; ++i) {
      const Principled p = with_roughness(material, sampler.next());
      const Vec3d wo = direction_at(1 - sampler.next(), sampler.next());
      const double u_lobe = sampler.next();
      const Vec2d u = sampler.next_2d();
      const BsdfSample expected = AnyBsdf(p, wo).sample(u_lobe, u);
      const auto expect_same = [&]<BsdfFeatures features>() {
        if (!has(features, features_of(p))) return;
        const BsdfSample found = Bsdf<features>(p, wo).sample(u_lobe, u);
        EXPECT_EQ(found.wi, expected.wi) << name;
        EXPECT_EQ(found.weight, expected.weight) << name;
        EXPECT_EQ(found.pdf, expected.pdf) << name;
      };
      expect_same.template operator()<reflection>();
      expect_same.template operator()<reflection | layers>();
      expect_same.template operator()<transmission>();
    }
  }
}

TEST(Glass, bends_light_as_snell_says_and_reflects_all_of_it_beyond_the_critical_angle) {
  const Principled p{.base_color = Vec3f(1), .roughness = 0, .transmission = 1, .ior = 1.5f};
  const BsdfSample entering =
      AnyBsdf(p, direction_at(0.6, 0), Side::outside).sample(0.999, {0.5, 0.5});
  EXPECT_TRUE(entering.is_specular);
  EXPECT_NEAR(entering.wi.x, -0.8 / 1.5, 1e-12);
  EXPECT_LT(entering.wi.z, 0);
  const BsdfSample leaving =
      AnyBsdf(p, direction_at(std::sqrt(1 - 0.25), 0), Side::inside).sample(0.999, {0.5, 0.5});
  EXPECT_NEAR(leaving.wi.x, -0.75, 1e-12);
  for (const double u : {0.001, 0.5, 0.999}) {
    EXPECT_GT(AnyBsdf(p, direction_at(0.6, 0), Side::inside).sample(u, {0.5, 0.5}).wi.z, 0);
  }
}

TEST(Glass, of_index_1_is_not_there) {
  const Principled p{.base_color = Vec3f(1), .roughness = 0.5f, .transmission = 1, .ior = 1};
  const Vec3d wo = direction_at(0.3, 0.4);
  const BsdfSample sample = AnyBsdf(p, wo).sample(0.3, {0.2, 0.7});
  EXPECT_EQ(sample.wi, -wo);
  EXPECT_EQ(sample.weight, Vec3d(1));
}

TEST(Fresnel, is_4_percent_head_on_and_all_at_grazing_angles) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(1e-9, 1.5), 1, 1e-7);
  EXPECT_EQ(fresnel_dielectric(0.5, 1 / 1.5), 1);
}

}  // namespace
}  // namespace tracer
