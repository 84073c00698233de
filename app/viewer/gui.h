// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "app/viewer/style.h"
#include "app/viewer/window.h"
#include "tracer/render/film.h"

namespace app {

/// Dear ImGui in a window: frames are begun, filled with widgets, and rendered. One at a time.
class Gui {
 public:
  /// Throws WindowError when the window's OpenGL is too old.
  explicit Gui(const Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Follows the display's scale, which may have changed. Widgets see the mouse as it was at the
  /// end of `input`: Dear ImGui 1.86 looks at where it is now, and would lose a click in a slow
  /// frame.
  void begin_frame(std::span<const InputEvent> input);
  /// Fills a rectangle of the framebuffer, in window coordinates, beneath all widgets.
  void fill(const tracer::Vec2d& min, const tracer::Vec2d& max, const ImVec4& color);
  /// Draws the frame over what the framebuffer holds; the caller swaps.
  void render();

  const Fonts& fonts() const { return fonts_; }
  /// Of sizes in window coordinates, relative to an unscaled display.
  float scale() const { return static_cast<float>(ui_scale_); }
  /// Framebuffer pixels a window coordinate.
  double pixel_ratio() const { return pixel_ratio_; }
  /// Framebuffer pixels of a rectangle in window coordinates, both from the upper left corner.
  tracer::Tile framebuffer_tile(const tracer::Vec2d& min, const tracer::Vec2d& max) const;

 private:
  void follow_scale();
  void follow_mouse(std::span<const InputEvent> input);

  const Window& window_;
  Fonts fonts_;
  double ui_scale_ = 0;
  double pixel_ratio_ = 0;
  std::array<bool, 3> is_button_down_{};
};

}  // namespace app
