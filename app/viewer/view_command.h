// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "app/environment_source.h"
#include "tracer/base/vectors.h"

namespace app {

struct ViewOptions {
  std::optional<std::filesystem::path> model;
  std::optional<std::filesystem::path> view_file;  // else MODEL.view.json beside the model
  EnvironmentSource environment;
  int sample_limit = 0;                 // samples a pixel; 0: the panel's default
  std::optional<double> error_limit{};  // relMSE at which the picture is done
  int frames = 0;  // more than 0: ends when the picture has so many samples a pixel, or is done
  std::optional<std::filesystem::path> screenshot;  // PNG of the whole window, written at the end
  int thread_count = 0;                             // 0: one a core
  tracer::Vec2i size_px{1280, 800};                 // of the window on an unscaled display
  std::optional<std::filesystem::path> ui_layout;   // see LayoutReport; else $BOXWOOD_UI_LAYOUT
};

/// Runs the window until it is closed. Returns an exit_code: no_display (which includes no OpenGL)
/// or bad_input after one line on stderr.
int view_command(const ViewOptions& options);

}  // namespace app
