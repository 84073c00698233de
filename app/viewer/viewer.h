// SPDX-License-Identifier: MIT
// The window's loop: input in, edits to the session, tiles to the screen.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <string>

#include "app/session.h"
#include "app/viewer/commands.h"
#include "app/viewer/file_watch.h"
#include "app/viewer/gui.h"
#include "app/viewer/layout_report.h"
#include "app/viewer/panels/open_dialog.h"
#include "app/viewer/panels/settings_panel.h"
#include "app/viewer/picture.h"
#include "app/viewer/screenshot.h"
#include "app/viewer/texture.h"
#include "app/viewer/view_command.h"
#include "app/viewer/viewpoint.h"
#include "app/viewer/window.h"

namespace app {

class Viewer {
 public:
  /// Throws WindowError, or LoadError for a view file that was asked for by name.
  explicit Viewer(const ViewOptions& options);
  /// Until the window is closed; the program's exit code.
  int run();

 private:
  // The loop: what is due, and when. viewer.cpp
  double due_seconds() const;
  void wait();
  void watch_files();
  void draw_frame(double due_seconds);
  bool has_finished_picture() const;
  bool is_run_over() const;

  // What comes in. viewer_model.cpp
  void take_update();
  void report_error();
  void adopt_model();
  std::optional<tracer::View> find_view();
  void open(const std::filesystem::path& path);
  /// That can be read again.
  bool has_file() const;
  void hold_back_build();
  void send_edits();
  void answer_edits();

  // What the user does. viewer_input.cpp
  void handle_input(std::span<const InputEvent> input);
  void handle_key(const InputEvent& event);
  void execute(Command command);
  void escape();
  void save_view();
  void save_screenshot();
  void show_toast(std::string text);

  // What the user sees. viewer_draw.cpp
  void lay_out();
  void draw_background();
  void draw_panel(const Ui& ui);
  void draw_header(const Ui& ui);
  void draw_overlays(const Ui& ui);
  void draw_panel_button(const Ui& ui);

  double aspect() const { return area_.size.x / area_.size.y; }
  bool is_job_running() const { return status_.is_loading || status_.is_building; }

  ViewOptions options_;
  std::optional<tracer::View> first_view_;  // asked for on the command line
  Window window_;
  Gui gui_;
  Texture texture_;
  Picture picture_;
  LayoutReport layout_;
  FileWatch file_watch_;
  ScreenshotWriter screenshots_;
  OpenDialog open_dialog_;

  ViewerSettings settings_;
  EnvironmentMaker environments_;
  tracer::BuildSettings sent_build_;  // what the session was last asked for
  bool was_build_dragged_ = false;    // when it was
  Viewpoint viewpoint_;
  PictureArea area_;
  bool is_panel_shown_ = true;
  bool is_cheat_sheet_shown_ = false;
  bool is_typing_ = false;  // into a field of the panel
  bool are_warnings_shown_ = false;
  std::string shown_error_;
  std::string toast_;
  double toast_end_seconds_ = 0;

  Status status_;
  uint64_t reported_error_generation_ = 0;  // the last on stderr
  uint64_t adopted_generation_ = 0;
  std::string adopted_path_;
  std::filesystem::path requested_path_;  // the last that was to be opened; empty: none yet
  double job_start_seconds_ = 0;

  std::atomic<bool> has_news_{false};
  int frames_due_ = 0;  // after input, until hovering and layout have settled
  int frames_drawn_ = 0;
  double last_frame_seconds_ = -1;
  double draw_seconds_ = 0;   // that the last frame took once edits were answered
  bool is_captured_ = false;  // the picture of a run of options_.frames

  Session session_;  // last: its threads end before what they wake
};

}  // namespace app
