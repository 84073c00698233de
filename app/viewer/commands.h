// SPDX-License-Identifier: MIT
// The table of keys: what the window obeys and what the cheat sheet shows.
#pragma once

#include <optional>
#include <span>

namespace app {

enum class Command {
  open,
  reload,
  save_view,
  frame_all,
  reset_view,
  front,
  back,
  right,
  left,
  top,
  bottom,
  toggle_bvh,
  toggle_panel,
  screenshot,
  full_screen,
  cheat_sheet,
  escape,
  quit,
};

struct KeyBinding {
  int key = 0;        // GLFW's
  int modifiers = 0;  // GLFW's, exactly these of shift, control, alt and super
  Command command = Command::escape;
  const char* keys = "";  // as the cheat sheet has it; empty: a second way, not listed
  const char* what = "";
};

std::span<const KeyBinding> key_bindings();
std::optional<Command> find_command(int key, int modifiers);

/// What the mouse does, for the cheat sheet; the code is in camera_controls.
struct MouseGesture {
  const char* gesture;
  const char* what;
};
std::span<const MouseGesture> mouse_gestures();

}  // namespace app
