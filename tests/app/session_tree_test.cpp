// SPDX-License-Identifier: MIT
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "app/build_accel.h"
#include "tests/app/session_fixture.h"

namespace app {
namespace {

namespace fs = std::filesystem;

TEST_F(SessionTest, the_first_model_comes_with_the_tree_that_the_edits_ask_for) {
  session_->set(Edits{});
  session_->open(ball("ball.obj", 24));
  ASSERT_TRUE(wait_until([this] { return status_.model != nullptr; }));
  EXPECT_GT(status_.tree.node_count, 0u);
  ASSERT_TRUE(wait_until([this] { return status_.rays > 0; }));
  EXPECT_EQ(status_.mrays_per_second_brute_force, 0);
}

TEST_F(SessionTest, a_new_tree_keeps_the_film_to_the_last_bit) {
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  const auto before = picture_.pixels;
  const uint64_t rays = status_.rays;
  const uint32_t nodes = status_.tree.node_count;
  edits_.build.max_depth = 3;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([&] { return status_.tree.depth <= 3 && is_done(); }));
  EXPECT_LT(status_.tree.node_count, nodes);
  EXPECT_EQ(status_.rays, rays);
  EXPECT_EQ(picture_.pixels, before);
}

TEST_F(SessionTest, the_tree_may_change_in_the_middle_of_a_pass) {
  const fs::path path = ball("ball.obj", 24);
  ASSERT_TRUE(show(path));
  const auto expected = picture_.pixels;
  for (const bool is_bvh_on : {false, true}) {
    edits_.camera.eye += tracer::Vec3d(0.1);
    session_->set(edits_);
    edits_.camera.eye -= tracer::Vec3d(0.1);
    edits_.builder = is_bvh_on ? nullptr : &tracer::builders().front();
    session_->set(edits_);
    ASSERT_TRUE(wait_until([this] { return status_.rays > 0; }));
    edits_.builder = is_bvh_on ? &tracer::builders().back() : nullptr;
    session_->set(edits_);
    ASSERT_TRUE(wait_until(
        [&] { return is_done() && (status_.tree.node_count > 0) == (edits_.builder != nullptr); }));
    EXPECT_EQ(picture_.pixels, expected);
  }
}

TEST_F(SessionTest, brute_force_gives_the_same_picture_and_a_rate_to_compare) {
  ASSERT_TRUE(show(ball("ball.obj", 12)));
  edits_.sample_limit = 4;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return is_done(); }));
  const auto with_tree = picture_.pixels;
  edits_.builder = nullptr;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return is_done() && status_.tree.node_count == 0; }));
  edits_.sample_limit = 8;  // only now: until the tree is gone, samples are traced with it
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return is_done(); }));
  EXPECT_GT(status_.mrays_per_second_brute_force, 0);
  EXPECT_GT(status_.mrays_per_second_bvh, 0);
  edits_.render.seed = 1;
  session_->set(edits_);
  edits_.render.seed = 0;
  edits_.sample_limit = 4;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return is_done() && status_.samples == 4; }));
  EXPECT_EQ(picture_.pixels, with_tree);
}

TEST_F(SessionTest, the_tree_in_use_is_measured_once_its_picture_is_left_alone) {
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  ASSERT_TRUE(wait_until([this] { return status_.tree_quality.has_value(); }));
  const double first = status_.tree_quality->epo.value;
  EXPECT_GT(first, 0);
  EXPECT_GT(status_.tree_quality->lcv.value, 0);
  edits_.build.leaf_size = 16;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([&] {
    return status_.tree_quality.has_value() && status_.tree_quality->epo.value != first;
  }));
  edits_.builder = nullptr;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return status_.tree.node_count == 0; }));
  EXPECT_FALSE(status_.tree_quality.has_value());
}

TEST_F(SessionTest, overlap_is_charged_at_the_costs_of_the_settings) {
  edits_.improve = false;
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  ASSERT_TRUE(wait_until([this] { return status_.tree_quality.has_value(); }));
  const double epo = status_.tree_quality->epo.value;
  edits_.build.traversal_cost *= 2;
  edits_.build.intersection_cost *= 2;
  session_->set(edits_);
  ASSERT_TRUE(wait_until(
      [&] { return status_.tree.costs.traversal == 2 && status_.tree_quality.has_value(); }));
  EXPECT_DOUBLE_EQ(status_.tree_quality->epo.value, 2 * epo);
}

TEST_F(SessionTest, tells_whose_tree_is_in_use) {
  edits_.builder = tracer::find_builder("morton");
  ASSERT_TRUE(show(ball("ball.obj", 12)));
  EXPECT_EQ(status_.builder, edits_.builder);
  edits_.builder = nullptr;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return status_.tree.node_count == 0; }));
  EXPECT_EQ(status_.builder, nullptr);
}

TEST_F(SessionTest, the_tree_is_not_measured_while_the_user_is_at_work) {
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  edits_.build.leaf_size = 2;
  session_->set(edits_);
  const auto start = Clock::now();
  auto last_edit = start;
  double longest_rest = 0;
  bool was_measured = false;
  while (seconds_since(start) < 1) {
    longest_rest = std::max(longest_rest, seconds_since(last_edit));
    last_edit = Clock::now();
    edits_.camera.eye *= 1.001;
    session_->set(edits_);
    poll();
    was_measured |= status_.tree.largest_leaf == 2 && status_.tree_quality.has_value();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  // A busy machine may keep this thread from working, as a user never does.
  EXPECT_TRUE(!was_measured || longest_rest > 0.2);
  ASSERT_TRUE(wait_until([this] { return status_.tree_quality.has_value(); }));
}

TEST_F(SessionTest, the_tree_is_improved_after_the_picture_and_the_film_kept) {
  edits_.builder = tracer::find_builder("median");
  edits_.improve = false;
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  const auto expected = picture_.pixels;
  const double cost = status_.tree.sah_cost;
  const uint64_t rays = status_.rays;
  EXPECT_EQ(status_.improvement_rounds, 0);
  edits_.improve = true;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return status_.improvement_rounds > 0 && is_done(); }));
  EXPECT_LT(status_.tree.sah_cost, 0.999 * cost);
  EXPECT_EQ(status_.first_sah_cost, cost);
  EXPECT_EQ(status_.rays, rays);
  EXPECT_EQ(picture_.pixels, expected);
  edits_.render.seed = 1;
  session_->set(edits_);
  edits_.render.seed = 0;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return is_done(); }));
  EXPECT_EQ(picture_.pixels, expected);
}

TEST_F(SessionTest, without_improvement_the_tree_is_as_it_was_built) {
  edits_.builder = tracer::find_builder("median");
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  ASSERT_GT(status_.improvement_rounds, 0);
  edits_.improve = false;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return status_.improvement_rounds == 0 && is_done(); }));
  EXPECT_EQ(status_.tree.sah_cost, status_.first_sah_cost);
}

TEST_F(SessionTest, a_settled_session_holds_the_tree_in_the_one_form_that_is_traced) {
  for (const tracer::Layout& layout : tracer::layouts()) {
    for (const bool improve : {false, true}) {
      edits_.layout = &layout;
      edits_.improve = improve;
      edits_.model_generation = 0;
      ASSERT_TRUE(show(ball("ball.obj", 24)));
      ASSERT_TRUE(wait_until([this] { return status_.tree_quality.has_value(); }));
      tracer::Progress progress;
      const BuiltAccel expected = build_accel(
          status_.model->scene.mesh,
          {edits_.builder, &layout, edits_.build, status_.improvement_rounds}, progress);
      EXPECT_TRUE(wait_until([&] { return status_.tree_bytes == expected.accel->bytes(); }))
          << layout.name << ": " << status_.tree_bytes << " of " << expected.accel->bytes();
      EXPECT_EQ(status_.tree.bytes, expected.tree->bytes());
      session_ = std::make_unique<Session>([] {});
      status_ = {};
    }
  }
}

TEST_F(SessionTest, the_binary_tree_counts_as_long_as_it_is_held) {
  session_->set(edits_);
  session_->open(ball("ball.obj", 96));
  ASSERT_TRUE(wait_until([this] { return status_.model != nullptr; }));
  tracer::Progress progress;
  const BuiltAccel built = build_accel(status_.model->scene.mesh, {}, progress);
  EXPECT_EQ(status_.tree_bytes,
            built.accel->bytes() + (built.accel->tree ? 0 : built.tree->bytes()));
}

TEST_F(SessionTest, what_was_measured_is_still_known_after_the_bvh_was_off) {
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  ASSERT_TRUE(wait_until([this] { return status_.tree_quality.has_value(); }));
  const double epo = status_.tree_quality->epo.value;
  const auto switch_to = [&](const tracer::Builder* builder) {
    edits_.builder = builder;
    session_->set(edits_);
    return wait_until([&] { return (status_.tree.node_count > 0) == (builder != nullptr); });
  };
  const tracer::Builder* const builder = edits_.builder;
  ASSERT_TRUE(switch_to(nullptr));
  EXPECT_EQ(status_.tree_bytes, 0u);
  ASSERT_TRUE(switch_to(builder));
  ASSERT_TRUE(status_.tree_quality.has_value());
  EXPECT_EQ(status_.tree_quality->epo.value, epo);
}

TEST_F(SessionTest, improvement_gives_way_to_whatever_needs_another_tree) {
  edits_.builder = tracer::find_builder("median");
  session_->set(edits_);
  session_->open(ball("large.obj", 300));
  ASSERT_TRUE(wait_until([this] { return status_.is_improving && status_.stage[0] == 'i'; }));
  edits_.build.max_depth = 3;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return status_.tree.depth == 3 && is_done(); }));
  const fs::path small = ball("small.obj", 12);
  edits_.build.max_depth = 30;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([this] { return status_.is_improving && status_.stage[0] == 'i'; }));
  session_->open(small);
  ASSERT_TRUE(wait_until([&] { return status_.model_path == small.string() && is_done(); }));
}

}  // namespace
}  // namespace app
