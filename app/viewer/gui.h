// SPDX-License-Identifier: MIT
#pragma once

#include "app/viewer/style.h"
#include "app/viewer/window.h"

namespace app {

/// Dear ImGui in a window: frames are begun, filled with widgets, and rendered. One at a time.
class Gui {
 public:
  /// Throws WindowError when the window's OpenGL is too old.
  explicit Gui(const Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Follows the display's scale, which may have changed.
  void begin_frame();
  /// Draws the frame over a cleared framebuffer; the caller swaps.
  void render();

  const Fonts& fonts() const { return fonts_; }
  /// Of sizes in window coordinates, relative to an unscaled display.
  float scale() const { return static_cast<float>(ui_scale_); }
  /// Framebuffer pixels a window coordinate.
  double pixel_ratio() const { return pixel_ratio_; }

 private:
  void follow_scale();

  const Window& window_;
  Fonts fonts_;
  double ui_scale_ = 0;
  double pixel_ratio_ = 0;
};

}  // namespace app
