// SPDX-License-Identifier: MIT
// What the comparison of ray-triangle tests is made of: if these are wrong, every number it prints
// is.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/bench/compare/exactness_records.h"
#include "tests/bench/compare/kernel_judge.h"
#include "tests/bench/compare/kernel_records.h"
#include "tests/bench/compare/moeller_kernels.h"
#include "tests/bench/compare/place_labels.h"
#include "tests/bench/compare/true_hit.h"
#include "tests/support/exact_hit.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"
#include "tests/support/test_meshes.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/accel.h"
#include "tracer/bvh/trace/bundle_kernels.h"
#include "tracer/bvh/trace/wide_kernels.h"

namespace bench {
namespace {

using tracer::Hit;
using tracer::RandomSource;
using tracer::Ray;
using tracer::StopFlag;
using tracer::Vec3f;

const Aiming& aiming(std::string_view name) {
  return *std::ranges::find(aimings(), name, &Aiming::name);
}

void expect_true_hit(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2) {
  const tracer::ExactHit exact = tracer::exact_hit(ray, v0, v1, v2);
  const auto found = true_hit(ray, v0, v1, v2);
  ASSERT_EQ(found.has_value(), exact.is_hit && exact.t >= 0);
  if (!found) return;
  EXPECT_LE(std::abs(*found - exact.t), 0x1p-38L * exact.t);
}

TEST(TrueHit, agrees_with_long_integers_at_random_and_on_a_lattice) {
  RandomSource random(1);
  for (int i = 0; i < 3000; ++i) {
    const Vec3f v0 = random.vector(-1, 1), v1 = random.vector(-1, 1), v2 = random.vector(-1, 1);
    const Vec3f origin = random.vector(-9, 9);
    expect_true_hit({.origin = origin, .direction = glm::mix(v0, v1, random.unit()) - origin}, v0,
                    v1, v2);
    expect_true_hit({.origin = origin, .direction = (v0 + v1 + v2) / 3.0f - origin}, v0, v1, v2);
    const Ray ray{.origin = random.lattice(-3, 3), .direction = random.lattice(-2, 2)};
    if (ray.direction == Vec3f(0)) continue;
    expect_true_hit(ray, random.lattice(-3, 3), random.lattice(-3, 3), random.lattice(-3, 3));
  }
}

TEST(ErrorHistogram, quantiles_are_a_bin_above_the_value_at_most) {
  ErrorHistogram errors;
  EXPECT_EQ(errors.quantile(0.5), 0);
  for (int i = 1; i <= 1000; ++i) errors.add(i);
  EXPECT_EQ(errors.max(), 1000);
  EXPECT_EQ(errors.quantile(1), 1000);
  EXPECT_GE(errors.quantile(0.99), 990);
  EXPECT_LE(errors.quantile(0.99), 990 * 1.02);
  EXPECT_GE(errors.quantile(0.001), 1);
  EXPECT_LE(errors.quantile(0.001), 1.02);
}

TEST(ErrorHistogram, keeps_zero_and_what_is_beyond_all_bins) {
  ErrorHistogram errors, other;
  errors.add(0);
  EXPECT_EQ(errors.quantile(1), 0);
  other.add(std::numeric_limits<double>::infinity());
  errors.add(other);
  EXPECT_EQ(errors.count(), 2u);
  EXPECT_EQ(errors.max(), std::numeric_limits<double>::infinity());
}

TEST(KernelBlocks, fans_are_closed_and_lie_in_the_lanes_in_order) {
  for (const Aiming& kind : aimings()) {
    const KernelBlock block = make_kernel_block(kind, 1);
    ASSERT_EQ(block.triangle_count() % block.fan_size, 0u);
    std::multiset<std::pair<uint32_t, uint32_t>> spokes;
    for (const tracer::Vec3u& triangle : block.mesh->triangles) {
      for (int i = 0; i < 3; ++i) {
        const uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
        const uint32_t hub = std::min(from, to);
        if (hub % (block.fan_size + 1) == 0) spokes.insert(std::minmax(from, to));
      }
    }
    EXPECT_EQ(spokes.size(), size_t{2} * block.triangle_count());
    for (const auto& spoke : spokes) EXPECT_EQ(spokes.count(spoke), 2u);
    if (tracer::wide_kernel_width() == 0) continue;
    ASSERT_EQ(block.tree.block_infos.size(), 1u);
    for (uint32_t lane = 0; lane < block.triangle_count(); ++lane) {
      EXPECT_EQ(std::bit_cast<uint32_t>(block.tree.blocks.row(9)[lane]), lane);
    }
  }
}

TEST(KernelBlocks, aimed_rays_meet_the_inside_of_a_fan) {
  for (const Aiming& kind : aimings()) {
    if (!kind.finds_leaks()) continue;
    const Kernel& exact = scalar_kernels().back();
    const std::vector<Verdicts> verdicts = judge({&exact, 1}, kind, 4, 64);
    EXPECT_EQ(verdicts.front().aimed_rays, 256u) << kind.name;
    EXPECT_EQ(verdicts.front().leaks, 0u) << kind.name;
  }
}

TEST(Kernels, all_are_right_on_random_rays_with_every_instruction_set) {
  tracer::for_each_instruction_set([](const char* name) {
    const std::vector<Kernel> all = kernels();
    const std::vector<Verdicts> verdicts = judge(all, aiming("random"), 8, 64);
    for (size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(verdicts[i].wrong, 0u)
          << all[i].name << ", " << name_of(all[i].form) << ", " << name;
      EXPECT_GT(verdicts[i].t_error_ulp.count(), 100u) << all[i].name;
      EXPECT_LT(verdicts[i].t_error_ulp.max(), 100) << all[i].name;
    }
  });
}

TEST(Kernels, ours_neither_leak_nor_err_where_moeller_and_trumbore_leak) {
  for (const Aiming& kind : aimings()) {
    if (!kind.finds_leaks()) continue;
    const std::vector<Kernel> all = kernels();
    const std::vector<Verdicts> verdicts = judge(all, kind, 16, 256);
    for (size_t i = 0; i < all.size(); ++i) {
      if (all[i].is_ours()) {
        EXPECT_EQ(verdicts[i].wrong, 0u) << kind.name << ' ' << name_of(all[i].form);
        EXPECT_EQ(verdicts[i].leaks, 0u) << kind.name << ' ' << name_of(all[i].form);
        EXPECT_LT(verdicts[i].t_error_ulp.max(), 0.01) << kind.name;
      } else if (all[i].name == "Möller-Trumbore" && kind.offset == 0) {
        EXPECT_GT(verdicts[i].leaks, verdicts[i].aimed_rays / 100) << kind.name;
      } else if (all[i].name == "Woop 2013") {
        EXPECT_EQ(verdicts[i].leaks, 0u) << kind.name;
      }
    }
  }
}

TEST(Kernels, what_is_timed_finds_the_nearest_of_what_is_judged) {
  const Aiming& kind = aiming("random");
  const KernelBlock block = make_kernel_block(kind, 3);
  const std::vector<Ray> rays = make_aimed_rays(kind, block, 200, 4);
  for (const Kernel& kernel : kernels()) {
    std::vector<Found> timed(rays.size()), judged(rays.size());
    kernel.prepare(block, rays)(timed);
    kernel.judge(block, rays)(judged);
    for (size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(timed[i].hits == 0, judged[i].hits == 0) << kernel.name;
      if (timed[i].hits == 0) continue;
      const int found = std::countr_zero(timed[i].hits);
      EXPECT_TRUE(judged[i].hits >> found & 1) << kernel.name;
      EXPECT_EQ(timed[i].t[found], judged[i].t[found]) << kernel.name;
    }
  }
}

class MoellerTraversal : public testing::Test {
 protected:
  MoellerTraversal() {
    tracer::Progress progress;
    auto mesh = std::make_shared<const tracer::Mesh>(tracer::rough_ball(12, 0.1f, 1));
    accel_ =
        make_accel(mesh, tracer::builders().front().build(primitive_boxes(*mesh), {}, progress),
                   tracer::layouts().front(), progress);
    RandomSource random(2);
    for (int i = 0; i < 500; ++i) {
      const Vec3f origin = 3.0f * random.vector(-1, 1);
      rays_.push_back({.origin = origin, .direction = random.vector(-1, 1) - origin});
    }
  }

  tracer::Accel accel_;
  std::vector<Ray> rays_;
};

TEST_F(MoellerTraversal, finds_the_triangles_of_the_exact_one_at_nearly_the_same_distances) {
  if (!accel_.wide) GTEST_SKIP() << "no kernels for this processor";
  const StopFlag stop;
  std::vector<Hit> streamed(rays_.size());
  std::vector<uint8_t> occluded(rays_.size());
  ASSERT_EQ(closest_hits_stream_moeller(*accel_.wide, rays_, stop, streamed), rays_.size());
  ASSERT_EQ(occluded_stream_moeller(*accel_.wide, rays_, stop, occluded), rays_.size());
  size_t hits = 0;
  for (size_t i = 0; i < rays_.size(); ++i) {
    Hit exact, moeller, any;
    ASSERT_TRUE(closest_hit_wide(*accel_.wide, rays_[i], stop, exact));
    ASSERT_TRUE(closest_hit_moeller(*accel_.wide, rays_[i], stop, moeller));
    ASSERT_TRUE(occluded_moeller(*accel_.wide, rays_[i], stop, any));
    EXPECT_EQ(moeller.primitive, exact.primitive);
    EXPECT_EQ(streamed[i].primitive, exact.primitive);
    EXPECT_EQ(any.is_hit(), exact.is_hit());
    EXPECT_EQ(occluded[i] != 0, exact.is_hit());
    if (!exact.is_hit()) continue;
    EXPECT_NEAR(moeller.t / exact.t, 1, 1e-4);
    EXPECT_NEAR(moeller.u, exact.u, 1e-3);
    EXPECT_NEAR(moeller.v, exact.v, 1e-3);
    ++hits;
  }
  EXPECT_GT(hits, 50u);
}

KernelRecord example_record(const std::string& rays, double time, uint64_t leaks) {
  return {.kernel = "Plücker",
          .form = "SIMD",
          .rays = rays,
          .nanoseconds_a_test = {time - 1, time, time + 1},
          .tests = 2000,
          .hits = 100,
          .wrong_verdicts = 4,
          .aimed_rays = 1000,
          .leaks = leaks,
          .t_error_p9999_ulp = time,
          .t_error_max_ulp = 2 * time};
}

TEST(KernelReport, records_have_the_fields_that_scripts_read) {
  const nlohmann::json json = example_record("far", 3, 5);
  EXPECT_EQ(json["kernel"], "Plücker");
  EXPECT_EQ(json["rays"], "far");
  EXPECT_EQ(json["nanoseconds_a_test"]["min"], 2);
  EXPECT_EQ(json["nanoseconds_a_test"]["median"], 3);
  EXPECT_EQ(json["nanoseconds_a_test"]["max"], 4);
  EXPECT_EQ(json["wrong_verdicts_per_million"], 2000);
  EXPECT_EQ(json["leaks_per_million"], 5000);
  EXPECT_EQ(json["t_error_ulp"]["p9999"], 3);
  EXPECT_EQ(json["t_error_ulp"]["max"], 6);
}

TEST(KernelReport, a_summary_adds_counts_and_keeps_the_first_time_and_the_worst_error) {
  const std::vector<KernelRecord> summary =
      summarised(std::vector{example_record("random", 3, 0), example_record("far", 9, 5)});
  ASSERT_EQ(summary.size(), 1u);
  EXPECT_EQ(summary[0].nanoseconds_a_test.median, 3);
  EXPECT_EQ(summary[0].tests, 4000u);
  EXPECT_EQ(summary[0].leaks, 5u);
  EXPECT_EQ(summary[0].t_error_max_ulp, 18);
}

TEST(KernelReport, the_chart_names_each_kernel_and_shows_zero_in_a_band) {
  const std::string svg =
      to_svg(kernel_chart(std::vector{example_record("all", 3, 0)}, "a <machine>"));
  EXPECT_NE(svg.find(">Plücker</text>"), std::string::npos);
  EXPECT_NE(svg.find("none of 1,000 rays"), std::string::npos);
  EXPECT_NE(svg.find("a &lt;machine>"), std::string::npos);
  for (const char* number : {"\"nan", " nan", "\"inf", " inf", "-inf"}) {
    EXPECT_EQ(svg.find(number), std::string::npos) << number;
  }
  EXPECT_NE(to_svg(kernel_chart({}, "")).find("</svg>"), std::string::npos);
}

TEST(KernelReport, the_cost_of_exactness_is_the_part_of_the_speed_that_is_lost) {
  ExactnessRecord record;
  record.way = "single";
  record.speed_ratio = 0.75;
  EXPECT_EQ(nlohmann::json(record)["cost"], 0.25);
  EXPECT_NE(exactness_summary({&record, 1}).find("costs 25.0 %"), std::string::npos);
}

TEST(ScatterChart, the_front_is_what_no_other_point_beats_on_both_axes) {
  const auto at = [](double x, double y) {
    return ScatterPoint{.label = "", .color = "", .x = x, .y = y};
  };
  const std::vector<ScatterPoint> front =
      front_of({at(4, 0), at(1, 9), at(2, 9), at(2, 5), at(3, 7), at(9, 0)});
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].x, 1);
  EXPECT_EQ(front[1].y, 5);
  EXPECT_EQ(front[2].x, 4);
}

TEST(PlaceLabels, no_label_lies_over_another_or_leaves_the_plot) {
  std::vector<LabelledPoint> points;
  for (int i = 0; i < 6; ++i) points.push_back({390.0 - 3 * i, 100, "a long enough label"});
  const Rectangle bounds{0, 0, 400, 200};
  const std::vector<Rectangle> places = place_labels(points, bounds);
  for (size_t i = 0; i < places.size(); ++i) {
    EXPECT_TRUE(bounds.contains(places[i])) << i;
    for (size_t k = 0; k < i; ++k) EXPECT_FALSE(places[i].overlaps(places[k])) << i << ' ' << k;
  }
}

}  // namespace
}  // namespace bench
