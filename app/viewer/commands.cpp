// SPDX-License-Identifier: MIT
#include "app/viewer/commands.h"

#include <GLFW/glfw3.h>

namespace app {
namespace {

constexpr int control = GLFW_MOD_CONTROL;

constexpr KeyBinding bindings[] = {
    {GLFW_KEY_O, control, Command::open, "Ctrl O", "open a model (or drop one on the window)"},
    {GLFW_KEY_F5, 0, Command::reload, "F5", "load the file again"},
    {GLFW_KEY_S, control, Command::save_view, "Ctrl S", "save this view beside the model"},
    {GLFW_KEY_F, 0, Command::frame_all, "F", "frame all"},
    {GLFW_KEY_R, 0, Command::reset_view, "R  Home", "the view it opened in"},
    {GLFW_KEY_HOME, 0, Command::reset_view, "", ""},
    {GLFW_KEY_1, 0, Command::front, "1", "front (Ctrl: back)"},
    {GLFW_KEY_1, control, Command::back, "", ""},
    {GLFW_KEY_KP_1, 0, Command::front, "", ""},
    {GLFW_KEY_KP_1, control, Command::back, "", ""},
    {GLFW_KEY_3, 0, Command::right, "3", "right (Ctrl: left)"},
    {GLFW_KEY_3, control, Command::left, "", ""},
    {GLFW_KEY_KP_3, 0, Command::right, "", ""},
    {GLFW_KEY_KP_3, control, Command::left, "", ""},
    {GLFW_KEY_7, 0, Command::top, "7", "top (Ctrl: bottom)"},
    {GLFW_KEY_7, control, Command::bottom, "", ""},
    {GLFW_KEY_KP_7, 0, Command::top, "", ""},
    {GLFW_KEY_KP_7, control, Command::bottom, "", ""},
    {GLFW_KEY_B, 0, Command::toggle_bvh, "B", "BVH on or off"},
    {GLFW_KEY_TAB, 0, Command::toggle_panel, "Tab", "show or hide the panel"},
    {GLFW_KEY_F11, 0, Command::full_screen, "F11", "full screen"},
    {GLFW_KEY_F12, 0, Command::screenshot, "F12", "save the picture as PNG"},
    {GLFW_KEY_H, 0, Command::cheat_sheet, "H", "this sheet"},
    {GLFW_KEY_F1, 0, Command::cheat_sheet, "", ""},
    {GLFW_KEY_ESCAPE, 0, Command::escape, "Esc", "close what is open, cancel a load or build"},
    {GLFW_KEY_Q, control, Command::quit, "Ctrl Q", "quit"},
};

constexpr MouseGesture gestures[] = {
    {"Drag", "orbit (left or middle button)"},
    {"Shift drag", "pan (or right button)"},
    {"Wheel", "towards the cursor and back"},
    {"Ctrl drag", "nearer and farther"},
};

}  // namespace

std::span<const KeyBinding> key_bindings() {
  return bindings;
}

std::optional<Command> find_command(int key, int modifiers) {
  const int relevant =
      modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
  for (const KeyBinding& binding : bindings) {
    if (binding.key == key && binding.modifiers == relevant) return binding.command;
  }
  return std::nullopt;
}

std::span<const MouseGesture> mouse_gestures() {
  return gestures;
}

}  // namespace app
