// SPDX-License-Identifier: MIT
// What the comparisons are made of: if these are wrong, every number they print is.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/bench/compare/bar_chart.h"
#include "tests/bench/compare/build_records.h"
#include "tests/bench/compare/embree_scene.h"
#include "tests/bench/compare/oracle.h"
#include "tests/bench/compare/pinned_threads.h"
#include "tests/bench/compare/ray_records.h"
#include "tests/bench/compare/ray_sets.h"
#include "tests/bench/compare/statistics.h"
#include "tests/bench/compare/tracers.h"
#include "tests/bench/compare/window_records.h"
#include "tests/support/large_meshes.h"
#include "tracer/bvh/build.h"

namespace bench {
namespace {

using tracer::Mesh;
using tracer::Vec3f;

TEST(BenchStatistics, median_lies_between_the_extremes_in_any_order) {
  const Spread odd = spread_of({5, 1, 3});
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.max, 5);
  EXPECT_EQ(spread_of({4, 1, 2, 9}).median, 3);
}

TEST(BenchStatistics, quantile_is_a_value_that_was_measured) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(quantile(values, 0.95), 95);
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 1), 100);
  EXPECT_EQ(quantile({7}, 0.95), 7);
}

TEST(BenchStatistics, paired_ratio_cancels_noise_that_both_share) {
  const std::vector<double> theirs{2, 20, 2000};
  const std::vector<double> ours{1, 10, 1000};
  EXPECT_EQ(paired_ratio(theirs, ours), 2);
}

TEST(BenchStatistics, geometric_mean_of_a_ratio_and_its_inverse_is_one) {
  EXPECT_DOUBLE_EQ(geometric_mean(std::vector<double>{4, 0.25}), 1);
  EXPECT_EQ(geometric_mean({}), 0);
}

struct BallContest {
  Scene scene{"ball", std::make_shared<const Mesh>(tracer::bumpy_sphere(20)), Vec3f(0.3f, 0.2f, 4),
              Vec3f(0), Vec3f(0, 5, 3)};
  tracer::Accel accel;

  BallContest() {
    tracer::Progress progress;
    accel = make_accel(scene.mesh,
                       tracer::builders().front().build(primitive_boxes(*scene.mesh), {}, progress),
                       tracer::layouts().front(), progress);
  }
};

std::vector<Answer> answers_of(const Tracer& tracer, const RaySet& set) {
  std::vector<Answer> answers(set.rays.size());
  const TraceRange trace = tracer.prepare(set);
  if (trace) trace(0, set.rays.size(), answers);
  return answers;
}

TEST(BenchRays, there_are_four_kinds_and_secondary_rays_leave_their_surface) {
  const BallContest contest;
  const std::vector<RaySet> sets = make_ray_sets(contest.scene, contest.accel, 32);
  ASSERT_EQ(sets.size(), 4u);
  EXPECT_EQ(sets[0].rays.size(), 32u * 32);
  EXPECT_EQ(sets[3].rays.size(), 32u * 32);
  EXPECT_GT(sets[1].rays.size(), 100u);
  EXPECT_EQ(sets[1].rays.size(), sets[2].rays.size());
  // A ball is nearly convex: what left its surface meets it again only between two bumps.
  const std::vector<Answer> bounces =
      answers_of(boxwood_tracers(contest.accel, "").front(), sets[2]);
  EXPECT_LT(std::ranges::count_if(bounces, [](Answer a) { return a != tracer::no_primitive; }),
            static_cast<ptrdiff_t>(bounces.size() / 5));
}

TEST(BenchRays, a_block_of_camera_rays_is_a_square_of_neighbours) {
  const BallContest contest;
  const RaySet camera = make_ray_sets(contest.scene, contest.accel, 64).front();
  float widest = 0;
  for (size_t i = 0; i < 16; ++i) {
    widest = std::max(widest, glm::length(camera.rays[i].direction - camera.rays[0].direction));
  }
  const float pixel = glm::length(camera.rays[1].direction - camera.rays[0].direction);
  EXPECT_LT(widest, 4.5f * pixel);
}

TEST(BenchRays, thinning_keeps_whole_blocks) {
  const BallContest contest;
  const RaySet camera = make_ray_sets(contest.scene, contest.accel, 64).front();
  const RaySet kept = thinned(camera, 3);
  ASSERT_EQ(kept.rays.size(), 6 * rays_a_block);
  EXPECT_EQ(kept.rays[rays_a_block].direction, camera.rays[3 * rays_a_block].direction);
  EXPECT_EQ(thinned(camera, 1).rays.size(), camera.rays.size());
}

TEST(BenchRays, every_tracer_gives_the_same_answers_as_single_rays) {
  const BallContest contest;
  std::vector<Tracer> tracers = boxwood_tracers(contest.accel, "");
#ifdef BOXWOOD_EMBREE
  EmbreeScene standard(*contest.scene.mesh, RTC_BUILD_QUALITY_MEDIUM, EmbreeMode::standard);
  EmbreeScene robust(*contest.scene.mesh, RTC_BUILD_QUALITY_MEDIUM, EmbreeMode::robust);
  standard.build();
  robust.build();
  EXPECT_GT(standard.bytes(), 0);
  for (Tracer& tracer : embree_tracers(standard, robust)) tracers.push_back(std::move(tracer));
#endif
  for (const RaySet& set : make_ray_sets(contest.scene, contest.accel, 32)) {
    const std::vector<Answer> expected = answers_of(tracers.front(), set);
    EXPECT_NE(std::set<Answer>(expected.begin(), expected.end()).size(), 1u) << set.kind->name;
    for (const Tracer& tracer : tracers) {
      if (!tracer.prepare(set)) continue;
      const std::vector<Answer> answers = answers_of(tracer, set);
      size_t differences = 0;
      for (size_t i = 0; i < answers.size(); ++i) differences += answers[i] != expected[i];
      // Embree's rounding may decide otherwise at an edge.
      EXPECT_LE(differences, tracer.is_ours() ? 0u : 2u) << tracer.name << ' ' << set.kind->name;
    }
  }
}

TEST(BenchRays, the_oracle_finds_a_tree_over_another_mesh) {
  BallContest contest;
  const std::vector<RaySet> sets = make_ray_sets(contest.scene, contest.accel, 32);
  EXPECT_EQ(ask_oracle(contest.accel, sets[0]).disagreements, 0u);
  EXPECT_GT(ask_oracle(contest.accel, sets[0]).ray_count, 500u);
  Mesh halved = *contest.scene.mesh;
  for (Vec3f& position : halved.positions) position *= 0.5f;
  contest.accel.mesh = std::make_shared<const Mesh>(std::move(halved));
  EXPECT_GT(ask_oracle(contest.accel, sets[0]).disagreements, 100u);
}

TEST(BenchThreads, each_part_is_done_once) {
  for (int thread_count = 1; thread_count <= std::min(2, processor_count()); ++thread_count) {
    std::vector<int> visits(1000);
    run_pinned(thread_count, visits.size(), 64, [&](size_t first, size_t last) {
      EXPECT_EQ(first % 64, 0u);
      for (size_t i = first; i < last; ++i) ++visits[i];
    });
    EXPECT_EQ(std::ranges::count(visits, 1), 1000);
  }
}

RayRecord example_record(const std::string& tracer, double speed) {
  return {.scene = "cow",
          .rays = "S",
          .threads = 1,
          .tracer = tracer,
          .mrays_per_second = {speed - 1, speed, speed + 1},
          .disagreements = 0,
          .ray_count = 100,
          .oracle_rays = 10,
          .ratios = {{"embree", speed / 10}}};
}

TEST(BenchReport, ray_records_have_the_fields_that_scripts_read) {
  const nlohmann::json json = example_record("boxwood", 12);
  EXPECT_EQ(json["scene"], "cow");
  EXPECT_EQ(json["rays"], "S");
  EXPECT_EQ(json["threads"], 1);
  EXPECT_EQ(json["tracer"], "boxwood");
  EXPECT_EQ(json["mrays_per_second"]["min"], 11);
  EXPECT_EQ(json["mrays_per_second"]["median"], 12);
  EXPECT_EQ(json["mrays_per_second"]["max"], 13);
  EXPECT_EQ(json["disagreements"], 0);
}

TEST(BenchReport, build_records_have_the_fields_that_scripts_read) {
  BuildRecord record;
  record.scene = "cow";
  record.threads = 2;
  record.builder = "median";
  record.ms = {1, 2, 3};
  record.sah = 21.5;
  record.bytes = 640;
  record.triangles = 10;
  const nlohmann::json json = record;
  EXPECT_EQ(json["scene"], "cow");
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["builder"], "median");
  EXPECT_EQ(json["ms"], 2);
  EXPECT_EQ(json["sah"], 21.5);
  EXPECT_EQ(json["bytes"], 640);
  EXPECT_EQ(json["bytes_a_triangle"], 64);
}

TEST(BenchWindow, the_longest_gap_counts_from_the_begin_and_to_the_end) {
  const std::vector<double> times{0.25, 0.5, 1.0};
  EXPECT_DOUBLE_EQ(frame_rate_of(times, 1.5).frames_per_second, 2);
  EXPECT_DOUBLE_EQ(frame_rate_of(times, 1.25).longest_gap_ms, 500);
  EXPECT_DOUBLE_EQ(frame_rate_of(times, 2).longest_gap_ms, 1000);
  EXPECT_DOUBLE_EQ(frame_rate_of({}, 2).longest_gap_ms, 2000);
  EXPECT_EQ(frame_rate_of({}, 2).frames_per_second, 0);
}

TEST(BenchWindow, drag_records_have_the_fields_that_scripts_read) {
  const nlohmann::json json = DragRecord{"cow", "drag", {{60, 17}, {50, 40}, {59, 20}}};
  EXPECT_EQ(json["scene"], "cow");
  EXPECT_EQ(json["measure"], "drag");
  EXPECT_EQ(json["drags"], 3);
  EXPECT_EQ(json["frames_per_second"]["median"], 59);
  EXPECT_EQ(json["longest_gap_ms"]["median"], 20);
  EXPECT_EQ(json["longest_gap_ms"]["max"], 40);
}

TEST(BenchReport, the_ratio_table_names_the_mean_and_the_least) {
  std::vector<RayRecord> records{example_record("boxwood", 20), example_record("boxwood", 5)};
  records[1].scene = "bunny";
  const std::string table = ratio_table(records);
  EXPECT_NE(table.find("1.00  least 0.50"), std::string::npos) << table;
}

TEST(BenchReport, the_chart_shows_each_tracer_with_its_value) {
  const std::vector<RayRecord> records{example_record("boxwood", 12), example_record("embree", 10)};
  const std::string svg = to_svg(ray_chart(records, "a <machine> & its day"));
  EXPECT_NE(svg.find(">12.0</text>"), std::string::npos);
  EXPECT_NE(svg.find(">10.0</text>"), std::string::npos);
  EXPECT_NE(svg.find(">× 1.20</text>"), std::string::npos);
  EXPECT_NE(svg.find("a &lt;machine> &amp; its day"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(BenchReport, a_chart_of_nothing_is_still_a_chart) {
  EXPECT_NE(to_svg(ray_chart({}, "")).find("</svg>"), std::string::npos);
}

TEST(LargeMeshes, are_of_the_size_that_was_asked_for_and_have_no_flat_spot) {
  EXPECT_EQ(tracer::bumpy_sphere(10).triangle_count(), 1200u);
  EXPECT_EQ(tracer::hair(500, 1).triangle_count(), 500u);
  EXPECT_EQ(tracer::terrain(30, 1).triangle_count(), 1800u);
  EXPECT_GT(tracer::stadium(10).triangle_count(), 1200u);
  EXPECT_GT(tracer::terrain(30, 1).bounds.extent().y, 0.05);
  EXPECT_GT(tracer::stadium(10).bounds.extent().x, 10000);
}

TEST(LargeMeshes, a_bumpy_sphere_has_no_hole) {
  const BallContest contest;
  const tracer::StopFlag stop;
  tracer::RayCaster caster(contest.accel, stop);
  for (const Vec3f& position : contest.scene.mesh->positions) {
    EXPECT_TRUE(caster.closest_hit({.origin = Vec3f(0), .direction = position}).is_hit());
  }
}

}  // namespace
}  // namespace bench
