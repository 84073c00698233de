// SPDX-License-Identifier: MIT
// Samples of the BSDF are distributed as its pdf says.
#include <gtest/gtest.h>

#include "tests/support/bsdf_cases.h"
#include "tracer/base/parallel.h"
#include "tracer/render/sampler.h"

namespace tracer {
namespace {

using test::direction_at;
using test::with_roughness;
using AnyBsdf = Bsdf<BsdfFeatures::all>;

/// Equal cells of the sphere by solid angle: rows by z from 1 to -1, columns around.
struct Cells {
  static constexpr int rows = 24;
  static constexpr int columns = 24;
  std::vector<double> values = std::vector<double>(rows * columns, 0.0);

  double& at(const Vec3d& w) {
    const double turns = std::atan2(w.y, w.x) / (2 * std::numbers::pi) + 0.5;
    const int row = std::clamp(static_cast<int>((1 - w.z) / 2 * rows), 0, rows - 1);
    const int column = std::clamp(static_cast<int>(turns * columns), 0, columns - 1);
    return values[static_cast<size_t>(row * columns + column)];
  }
};

/// The integral of the pdf over each cell.
Cells expected_cells(const AnyBsdf& bsdf) {
  Cells cells;
  for (int row = 0; row < Cells::rows; ++row) {
    // Lobes about the poles, where light goes on almost as it came, are narrow.
    const bool is_polar = row == 0 || row == Cells::rows - 1;
    const int steps = is_polar ? 1000 : 24;
    const int columns = Cells::columns * (is_polar ? 4 : 24);
    const double area = 4 * std::numbers::pi / (double(Cells::rows) * steps * columns);
    for (int i = 0; i < steps; ++i) {
      const double z = 1 - 2 * (row + (i + 0.5) / steps) / Cells::rows;
      for (int j = 0; j < columns; ++j) {
        const double turns = (j + 0.5) / columns - 0.5;
        Vec3d wi = direction_at(std::abs(z), turns);
        wi.z = z;
        cells.at(wi) += bsdf.eval(wi).pdf * area;
      }
    }
  }
  return cells;
}

struct ChiSquare {
  double value = 0;
  double degrees = 0;
  /// That chance exceeds less than once in 100,000 times.
  double limit() const { return degrees + 4.5 * std::sqrt(2 * degrees) + 14; }
};

/// Of samples of one BSDF against another's pdf. Samples that scatter nothing have a cell too, and
/// cells where few are expected share one.
ChiSquare chi_square(const AnyBsdf& sampled, const AnyBsdf& expected, uint32_t seed) {
  constexpr int count = 200'000;
  Cells found;
  double nothing = 0;
  Sampler sampler(0, 0, seed);
  for (int i = 0; i < count; ++i) {
    const double u_lobe = sampler.next();
    const BsdfSample sample = sampled.sample(u_lobe, sampler.next_2d());
    ++(sample.pdf > 0 ? found.at(sample.wi) : nothing);
  }
  const Cells expectation = expected_cells(expected);
  ChiSquare result;
  double rest = count;
  double few_found = nothing;
  for (size_t i = 0; i < found.values.size(); ++i) {
    const double mean = count * expectation.values[i];
    if (mean < 25) {
      few_found += found.values[i];
      continue;
    }
    rest -= mean;
    result.value += (found.values[i] - mean) * (found.values[i] - mean) / mean;
    ++result.degrees;
  }
  if (rest > 25) {
    result.value += (few_found - rest) * (few_found - rest) / rest;
  } else {
    EXPECT_GT(rest, -5 * std::sqrt(double(count)));
  }
  return result;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double tried_roughness[] = {0.7};
#else
constexpr double tried_roughness[] = {0.4, 0.7, 1.0};
#endif

TEST(BsdfSampling, every_material_is_sampled_as_its_pdf_says) {
  struct Case {
    std::string name;
    Principled material;
    double cosine;
    ChiSquare found;
  };
  std::vector<Case> cases;
  for (const auto& [name, material] : test::all_materials()) {
    for (const double roughness : tried_roughness) {
      for (const double cosine : {0.2, 0.7, 1.0}) {
        cases.push_back({name, with_roughness(material, roughness), cosine, {}});
      }
    }
  }
  parallel_for_each_index(size_t{0}, cases.size(), [&](size_t i) {
    const AnyBsdf bsdf(cases[i].material, direction_at(cases[i].cosine, 0.15),
                       i % 2 == 0 ? Side::outside : Side::inside);
    cases[i].found = chi_square(bsdf, bsdf, static_cast<uint32_t>(i));
  });
  for (const Case& tried : cases) {
    EXPECT_LT(tried.found.value, tried.found.limit())
        << tried.name << ' ' << tried.material.roughness << ' ' << tried.cosine;
  }
}

TEST(BsdfSampling, a_pdf_of_other_roughness_is_told) {
  for (const auto& [name, material] : test::all_materials()) {
    const Vec3d wo = direction_at(0.7, 0.15);
    if (features_of(material) == BsdfFeatures::layers && material.coat == 0) continue;  // sheen
    if (name == "faint dielectric") continue;  // a hundredth of its light
    const ChiSquare found = chi_square(AnyBsdf(with_roughness(material, 0.6), wo),
                                       AnyBsdf(with_roughness(material, 1), wo), 7);
    EXPECT_GT(found.value, found.limit()) << name;
  }
}

TEST(BsdfSampling, a_sample_has_the_value_and_pdf_of_its_direction) {
  Sampler sampler(0, 0, 3);
  for (const auto& [name, material] : test::all_materials()) {
    for (int i = 0; i < 2000; ++i) {
      const Principled p = with_roughness(material, 0.02 + 0.98 * sampler.next());
      const AnyBsdf bsdf(p, direction_at(1 - sampler.next(), sampler.next()));
      const double u_lobe = sampler.next();
      const BsdfSample sample = bsdf.sample(u_lobe, sampler.next_2d());
      if (sample.pdf == 0) continue;
      const BsdfValue found = bsdf.eval(sample.wi);
      ASSERT_FALSE(sample.is_specular);
      ASSERT_EQ(sample.pdf, found.pdf) << name;
      ASSERT_LT(max_abs(sample.weight * sample.pdf - found.value), 1e-12 * max_abs(found.value));
    }
  }
}

TEST(BsdfSampling, weights_of_metal_are_close_to_one) {
  // Facets are sampled as they are seen. What is left is the compensation, which is not: at grazing
  // angles a weight in a million is some 30, so that a largest one would tell of the seed.
  constexpr int sample_count = 200'000;
  Sampler sampler(0, 0, 4);
  double squares = 0;
  for (int i = 0; i < sample_count; ++i) {
    const Principled p{.base_color = Vec3f(1),
                       .metallic = 1,
                       .roughness = static_cast<float>(0.02 + 0.98 * sampler.next())};
    const AnyBsdf bsdf(p, direction_at(1 - 0.95 * sampler.next(), sampler.next()));
    const double u_lobe = sampler.next();
    const double weight = bsdf.sample(u_lobe, sampler.next_2d()).weight.x;
    squares += weight * weight;
  }
  EXPECT_LT(squares / sample_count, 1.12);
}

}  // namespace
}  // namespace tracer
