// SPDX-License-Identifier: MIT
#include <algorithm>

#include <gtest/gtest.h>

#include "app/build_accel.h"
#include "tests/app/session_fixture.h"

namespace app {
namespace {

class SessionErrorTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    edits_.integrator = tracer::find_integrator("path");
    ASSERT_NE(edits_.integrator, nullptr);
    edits_.sky = tracer::Vec3d(1.0);
  }

  double last_bound() const { return status_.errors.back().error.upper_bound(); }

  testing::AssertionResult finish() {
    session_->set(edits_);
    return wait_until([this] { return is_done(); });
  }
};

TEST_F(SessionErrorTest, a_picture_is_done_when_it_is_good_enough_and_goes_on_for_a_smaller_error) {
  edits_.sample_limit = 4096;
  edits_.error_limit = 1;
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  const uint32_t samples = status_.samples;
  EXPECT_LT(samples, 4096u);
  ASSERT_FALSE(status_.errors.empty());
  EXPECT_LE(last_bound(), 1);
  ASSERT_GT(last_bound(), 0);

  edits_.error_limit = last_bound() / 8;
  ASSERT_TRUE(finish());
  EXPECT_GT(status_.samples, samples);
  EXPECT_LE(last_bound(), edits_.error_limit);
  for (size_t i = 0; i + 1 < status_.errors.size(); ++i) {
    EXPECT_GT(status_.errors[i].error.upper_bound(), edits_.error_limit);
    EXPECT_LT(status_.errors[i].seconds, status_.errors[i + 1].seconds);
  }
}

TEST_F(SessionErrorTest,
       a_picture_without_noise_takes_all_its_samples_where_no_error_is_asked_for) {
  edits_.integrator = tracer::find_integrator("normals");
  edits_.sample_limit = 20;
  ASSERT_TRUE(show(ball("ball.obj", 4)));
  EXPECT_EQ(status_.samples, 20u);
  EXPECT_EQ(status_.mean_samples, 20);
}

TEST_F(SessionErrorTest, adaptive_samples_go_where_a_headless_render_puts_them) {
  edits_.sample_limit = 40;
  edits_.render.allocation = tracer::Allocation::adaptive;
  const std::filesystem::path path = ball("ball.obj", 24);
  ASSERT_TRUE(show(path));
  EXPECT_EQ(status_.samples, 40u);
  EXPECT_LT(status_.mean_samples, 40);

  tracer::Progress progress;
  const auto imported = tracer::import_obj(path, progress);
  const auto scene = std::make_shared<const tracer::Scene>(imported.scene);
  const tracer::World world{
      .scene = scene,
      .accel =
          build_accel(scene->mesh, {edits_.builder, edits_.layout, edits_.build}, progress).accel,
      .camera = make_camera_frame(edits_.camera, edits_.size_px, scene->mesh->origin),
      .sky = edits_.sky,
      .environment = nullptr,
      .zenith = zenith_of(edits_.camera)};
  tracer::Film film(edits_.size_px);
  const tracer::StopFlag never;
  tracer::PassSchedule schedule(edits_.render);
  while (schedule.pass().sample < 40) {
    render_pass(world, *edits_.integrator, edits_.render, schedule.pass(), film, never);
    schedule.advance(film);
  }
  EXPECT_TRUE(std::ranges::equal(picture_.pixels, film.image().pixels));
}

TEST_F(SessionErrorTest, maps_take_the_place_of_the_picture_and_cost_no_sample) {
  edits_.sample_limit = 40;
  ASSERT_TRUE(show(ball("ball.obj", 24)));
  const std::vector<tracer::Vec3f> picture = picture_.pixels;
  const uint64_t rays = status_.rays;

  edits_.shown = ShownMap::samples;
  session_->set(edits_);
  const tracer::Vec3f all = map_color(1);
  ASSERT_TRUE(wait_until([&] {
    return std::ranges::all_of(picture_.pixels, [&](const auto& pixel) { return pixel == all; });
  }));
  edits_.shown = ShownMap::error;
  session_->set(edits_);
  // The sky has no error, the ball's outline has.
  ASSERT_TRUE(wait_until([&] {
    return picture_.pixels.front() == map_color(0) &&
           std::ranges::any_of(picture_.pixels,
                               [](const auto& pixel) { return pixel != map_color(0); });
  }));
  edits_.shown = ShownMap::picture;
  session_->set(edits_);
  ASSERT_TRUE(wait_until([&] { return picture_.pixels == picture; }));
  EXPECT_EQ(status_.rays, rays);
}

}  // namespace
}  // namespace app
