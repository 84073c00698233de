// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tracer/base/vectors.h"

struct GLFWwindow;

namespace app {

/// There is no display, or none with OpenGL 3. Says so in one line for the user.
struct WindowError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the user did, in the order it was done. Nothing is lost between two frames.
struct InputEvent {
  enum class Kind { key_press, button_press, button_release, cursor, scroll };
  Kind kind = Kind::cursor;
  int code = 0;            // GLFW's key or button
  int modifiers = 0;       // GLFW's
  tracer::Vec2d cursor{};  // in window coordinates, y down
  tracer::Vec2d scroll{};  // in steps
};

/// A window with an OpenGL 3 context that is current on the thread that made it. Swapping does not
/// wait for the display. One at a time.
class Window {
 public:
  /// Sizes are those of an unscaled display. Throws WindowError.
  Window(const std::string& title, tracer::Vec2i size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool should_close() const;
  /// (0, 0) when minimised.
  tracer::Vec2i framebuffer_px() const;
  /// In the coordinates of cursor events.
  tracer::Vec2i size() const;
  /// Sizes of letters and widgets relative to an unscaled display.
  double content_scale() const;
  void set_title(const std::string& title);
  void toggle_full_screen();
  void hide();
  void swap();

  /// Waits for an event or wake(); returns at once when there was one already.
  void wait_events();
  void wait_events(double timeout_seconds);
  void poll_events();
  /// From any thread: ends a wait.
  static void wake();

  /// Whether anything happened that may change what is shown, since the last call.
  bool take_activity();
  /// Up to the next press or release of a button, so that a frame sees the cursor where it was
  /// then, however long frames take. What is left counts as activity.
  std::vector<InputEvent> take_input();
  std::vector<std::filesystem::path> take_drops();

 private:
  static Window& of(GLFWwindow* window);
  void add(InputEvent event);
  void install_callbacks();

  GLFWwindow* window_ = nullptr;
  bool is_active_ = true;
  tracer::Vec2d cursor_{-1, -1};
  std::vector<InputEvent> input_;
  std::vector<std::filesystem::path> drops_;
  tracer::Vec2i windowed_position_{0, 0};  // while full screen
  tracer::Vec2i windowed_size_{0, 0};
};

}  // namespace app
