// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/support/test_ball.h"
#include "tests/viewer/window_driver.h"

namespace tests {
namespace {

/// A window that shows a ball by one sample a pixel, so that every picture is soon done and alike
/// however fast this machine is.
class BallWindowTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    write_ball(folder_.path() / "ball.obj", 10);
    start({"ball.obj", "--spp", "1"});
    ASSERT_TRUE(wait_for_widget("model"));
    move_to(150, 20);  // the server draws the pointer into its pixels
    ASSERT_TRUE(wait_until_settled());
  }

  /// The part of the panel below the settings.
  Rectangle statistics() const {
    const Rectangle heading = *find_widget("section Statistics");
    return {heading.x0, heading.y1, heading.x1, height_px};
  }
};

TEST_F(BallWindowTest, opens_with_the_model_in_the_middle_of_the_picture) {
  const Rectangle picture = *find_widget("picture");
  const Screen screen = display_->capture();
  const auto corner = screen.at(picture.x0 + 4, picture.y1 - 5);
  const auto center = screen.at((picture.x0 + picture.x1) / 2, (picture.y0 + picture.y1) / 2);
  EXPECT_NE(center, corner);
  EXPECT_EQ(screen.at(picture.x1 - 5, picture.y0 + 4), corner);
  // It fills most of the shorter side, and not all.
  const int y = (picture.y0 + picture.y1) / 2;
  int columns_with_ball = 0;
  for (int x = picture.x0; x < picture.x1; ++x) columns_with_ball += screen.at(x, y) != corner;
  EXPECT_GT(columns_with_ball, (picture.x1 - picture.x0) / 2);
  EXPECT_LT(columns_with_ball, picture.x1 - picture.x0);
}

TEST_F(BallWindowTest, dragging_orbits_and_home_comes_back) {
  const auto before = look_at("picture");
  drag(150, 300, 270, 340);
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  EXPECT_NE(look_at("picture"), before);
  press_key("Home");
  ASSERT_TRUE(wait_until_settled());
  EXPECT_EQ(look_at("picture"), before);
}

TEST_F(BallWindowTest, the_wheel_and_axis_keys_move_the_camera) {
  std::set<std::vector<uint32_t>> pictures{look_at("picture")};
  xdotool({"click", "4"});
  ASSERT_TRUE(wait_until_settled());
  pictures.insert(look_at("picture"));
  EXPECT_EQ(pictures.size(), 2u) << "wheel";
  for (const char* key : {"1", "3", "7", "ctrl+3"}) {
    const size_t before = pictures.size();
    press_key(key);
    ASSERT_TRUE(wait_until_settled());
    pictures.insert(look_at("picture"));
    EXPECT_EQ(pictures.size(), before + 1) << key;
  }
}

TEST_F(BallWindowTest, without_the_tree_the_picture_stays_and_the_numbers_change) {
  const auto picture = look_at("picture");
  const auto numbers = look_at(statistics());
  click("bvh");
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  EXPECT_EQ(look_at("picture"), picture);
  EXPECT_NE(look_at(statistics()), numbers);
}

TEST_F(BallWindowTest, tree_sliders_keep_the_picture_and_change_the_numbers) {
  const auto picture = look_at("picture");
  for (const char* slider : {"max-depth", "leaf-size"}) {
    const auto numbers = look_at(statistics());
    const Rectangle at = *find_widget(slider);
    const int y = (at.y0 + at.y1) / 2;
    // A press anywhere on a slider moves it there: depth 7, leaves of up to 7.
    drag((at.x0 + at.x1) / 2, y, at.x0 + (at.x1 - at.x0) / 10, y);
    move_to(150, 20);
    ASSERT_TRUE(wait_until_settled());
    EXPECT_EQ(look_at("picture"), picture) << slider;
    EXPECT_NE(look_at(statistics()), numbers) << slider;
  }
}

TEST_F(BallWindowTest, a_resting_window_uses_no_cpu) {
  const double before = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_LT(cpu_seconds() - before, 0.15);
}

TEST_F(BallWindowTest, f12_writes_the_picture_into_the_working_folder) {
  press_key("F12");
  const auto path = folder_.path() / "ball-001.png";
  EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(path); }));
  press_key("F12");
  EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(folder_.path() / "ball-002.png"); }));
  EXPECT_EQ(read_file(path).substr(1, 3), "PNG");
}

TEST_F(BallWindowTest, a_file_that_changes_on_disk_is_loaded_again) {
  const auto before = look_at("picture");
  write_ball(folder_.path() / "ball.obj", 10, 0.4);
  EXPECT_TRUE(wait_until([&] { return look_at("picture") != before; }));
}

TEST_F(BallWindowTest, a_reload_by_itself_leaves_the_open_dialog_open) {
  press_key("ctrl+o");
  ASSERT_TRUE(wait_for_widget("open ball.obj"));
  ASSERT_TRUE(wait_until_settled());
  const Rectangle numbers = statistics();
  const auto before = look_at(numbers);
  write_ball(folder_.path() / "ball.obj", 30);
  ASSERT_TRUE(wait_until([&] { return look_at(numbers) != before; }));
  EXPECT_TRUE(find_widget("open-filter").has_value());
}

TEST_F(BallWindowTest, the_open_dialog_loads_what_is_typed_and_chosen) {
  const auto before = look_at("picture");
  std::filesystem::create_directory(folder_.path() / "models");
  write_ball(folder_.path() / "models" / "other.obj", 6, 0.3);
  press_key("ctrl+o");
  ASSERT_TRUE(wait_for_widget("open models"));
  click("open models");
  ASSERT_TRUE(wait_for_widget("open other.obj"));
  xdotool({"type", "OTH"});
  press_key("Return");
  ASSERT_TRUE(wait_until([&] { return !find_widget("open-filter").has_value(); }));
  EXPECT_TRUE(wait_until([&] { return look_at("picture") != before; }));
}

TEST_F(BallWindowTest, a_faulty_file_is_explained_and_the_old_model_stays) {
  const auto before = look_at("picture");
  write_file(folder_.path() / "bad.obj", "v 0 0 0\nf 1 2 9\n");
  press_key("ctrl+o");
  click("open bad.obj");
  ASSERT_TRUE(wait_for_widget("error"));
  EXPECT_TRUE(program_->wait_for_error_text("bad.obj"));
  press_key("Escape");
  ASSERT_TRUE(wait_until([&] { return !find_widget("error").has_value(); }));
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  EXPECT_EQ(look_at("picture"), before);
}

TEST_F(BallWindowTest, the_cheat_sheet_and_the_panel_come_and_go) {
  press_key("h");
  ASSERT_TRUE(wait_for_widget("cheat-sheet"));
  press_key("h");
  press_key("Tab");
  ASSERT_TRUE(wait_for_widget("show-panel"));
  EXPECT_EQ(find_widget("picture")->x1, width_px);
  click("show-panel");
  ASSERT_TRUE(wait_for_widget("bvh"));
}

TEST_F(BallWindowTest, a_saved_view_is_opened_again) {
  drag(150, 300, 250, 250);
  press_key("ctrl+s");
  ASSERT_TRUE(
      wait_until([&] { return std::filesystem::exists(folder_.path() / "ball.view.json"); }));
  move_to(150, 20);
  ASSERT_TRUE(wait_until([&] { return !find_widget("toast").has_value(); }));
  ASSERT_TRUE(wait_until_settled());
  const auto saved = look_at("picture");
  press_key("3");
  ASSERT_TRUE(wait_until_settled());
  EXPECT_NE(look_at("picture"), saved);
  press_key("ctrl+q");
  EXPECT_EQ(program_->wait().exit_code, 0);
  std::filesystem::remove(folder_.path() / "layout.json");
  start({"ball.obj", "--spp", "1"});
  ASSERT_TRUE(wait_for_widget("model"));
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  EXPECT_EQ(look_at("picture"), saved);
}

TEST_F(WindowTest, trees_follow_a_hand_that_drags_on) {
  write_ball(folder_.path() / "large.obj", 500);
  start({"large.obj", "--spp", "1"});
  ASSERT_TRUE(wait_for_widget("finished picture"));
  move_to("leaf-size", 0.1);
  const Rectangle heading = *find_widget("section Statistics");
  const Rectangle row = *find_widget("rate");
  // Triangles, nodes and leaves: improvement of a tree leaves them alone.
  const Rectangle counts{heading.x0, heading.y1, heading.x1, heading.y1 + 3 * (row.y1 - row.y0)};
  const auto before = look_at(counts);
  // A new value every 10 ms, far less than a tree takes, for longer than the test waits.
  const Rectangle slider = *find_widget("leaf-size");
  std::vector<std::string> moves{"mousedown", "1"};
  for (int move = 0; move < 12'000; ++move) {
    const int x = slider.x0 + 20 + 3 * move % (slider.x1 - slider.x0 - 40);
    for (const std::string& word :
         {std::string("mousemove"), std::to_string(x), std::to_string(slider.y0 + 5),
          std::string("sleep"), std::string("0.01")}) {
      moves.push_back(word);
    }
  }
  const ChildProgram hand(find_program("xdotool"), moves);
  EXPECT_TRUE(wait_until([&] { return look_at(counts) != before; }));
}

TEST_F(WindowTest, a_picture_stops_at_its_error_and_maps_show_where_samples_went) {
  write_ball(folder_.path() / "ball.obj", 10);
  start({"ball.obj", "--spp", "60000", "--error", "0.5"});
  ASSERT_TRUE(wait_for_widget("model"));
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  EXPECT_TRUE(find_widget("error-plot"));
  const auto picture = look_at("picture");
  click("show Samples");
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  const auto samples = look_at("picture");
  EXPECT_NE(samples, picture);
  // As many for every pixel; the pointer is drawn over some.
  const auto same = std::ranges::count(samples, samples[samples.size() / 2]);
  EXPECT_GT(static_cast<size_t>(same), samples.size() * 99 / 100);
  click("show Picture");
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  EXPECT_EQ(look_at("picture"), picture);
}

TEST_F(WindowTest, frames_and_screenshot_write_the_whole_window) {
  write_ball(folder_.path() / "ball.obj", 10);
  start({"ball.obj", "--frames", "2", "--screenshot", "window.png"});
  const ProgramResult result = program_->wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string png = read_file(folder_.path() / "window.png");
  ASSERT_GT(png.size(), 24u);
  const auto byte = [&](size_t at) { return static_cast<uint8_t>(png[at]); };
  EXPECT_EQ(byte(18) << 8 | byte(19), width_px);
  EXPECT_EQ(byte(22) << 8 | byte(23), height_px);
}

TEST_F(WindowTest, a_model_from_standard_input_is_shown_and_read_only_once) {
  write_ball(folder_.path() / "ball.obj", 10);
  program_ = std::make_unique<ChildProgram>(
      "/bin/sh",
      std::vector<std::string>{"-c",
                               "exec " BOXWOOD_PROGRAM " view - --size 760x800 --spp 1 <ball.obj"},
      ErrorStream::pipe, folder_.path());
  ASSERT_TRUE(wait_for_widget("model"));
  move_to(150, 20);
  ASSERT_TRUE(wait_until_settled());
  const auto picture = look_at("picture");
  press_key("F5");
  press_key("ctrl+s");
  ASSERT_TRUE(wait_for_widget("toast"));
  ASSERT_TRUE(wait_until([&] { return !find_widget("toast").has_value(); }));
  ASSERT_TRUE(wait_until_settled());
  EXPECT_EQ(look_at("picture"), picture);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "-.view.json"));
  press_key("ctrl+q");
  const ProgramResult result = program_->wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(WindowTest, a_first_model_that_cannot_be_shown_ends_a_test_run_with_2) {
  write_file(folder_.path() / "bad.obj", "v 0 0 0\nf 1 2 9\n");
  start({"bad.obj", "--frames", "1"});
  const ProgramResult result = program_->wait();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("bad.obj"), std::string::npos) << result.err;
}

TEST_F(WindowTest, a_first_model_that_fails_is_explained_each_time_and_shown_once_it_is_mended) {
  write_file(folder_.path() / "ball.obj", "v 0 0 0\nf 1 2 9\n");
  start({"ball.obj"});
  ASSERT_TRUE(wait_for_widget("error"));
  press_key("Escape");
  ASSERT_TRUE(wait_until([&] { return !find_widget("error").has_value(); }));
  press_key("F5");
  ASSERT_TRUE(wait_for_widget("error"));
  write_ball(folder_.path() / "ball.obj", 10);
  EXPECT_TRUE(wait_for_widget("model"));
  EXPECT_TRUE(wait_until([&] { return !find_widget("error").has_value(); }));
}

TEST_F(WindowTest, without_a_model_it_waits_for_one) {
  start({});
  ASSERT_TRUE(wait_for_widget("open"));
  press_key("ctrl+q");
  EXPECT_EQ(program_->wait().exit_code, 0);
}

TEST_F(WindowTest, closing_it_during_a_load_ends_the_program) {
  write_ball(folder_.path() / "large.obj", 250);
  start({"large.obj"});
  ASSERT_TRUE(wait_for_widget("picture"));
  press_key("ctrl+q");
  EXPECT_EQ(program_->wait(30).exit_code, 0);
}

TEST(Window, without_a_display_it_says_so_in_one_line_and_ends_with_3) {
  setenv("DISPLAY", ":4711", 1);
  unsetenv("WAYLAND_DISPLAY");
  const ProgramResult result = run_boxwood({"view"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("display"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

}  // namespace
}  // namespace tests
