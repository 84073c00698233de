// SPDX-License-Identifier: MIT
// Viewer: what keys and the mouse do.
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

#include <GLFW/glfw3.h>

#include "app/viewer/viewer.h"
#include "tracer/base/byte_source.h"

namespace app {
namespace {

constexpr double toast_seconds = 4;

std::filesystem::path working_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::current_path(error);
  return error ? std::filesystem::path(".") : folder;
}

}  // namespace

void Viewer::handle_input(std::span<const InputEvent> input) {
  const bool is_over_gui = ImGui::GetIO().WantCaptureMouse;
  // The dialog's own text field counts as the dialog, also in the frame that closes it.
  is_typing_ = ImGui::GetIO().WantTextInput && !open_dialog_.is_open();
  for (const InputEvent& event : input) {
    using Kind = InputEvent::Kind;
    if (event.kind == Kind::key_press) {
      handle_key(event);
    } else if (!is_over_gui || event.kind == Kind::cursor || event.kind == Kind::button_release) {
      viewpoint_.handle(event, area_);
    }
  }
}

void Viewer::handle_key(const InputEvent& event) {
  if (open_dialog_.is_open()) {
    if (const auto path = open_dialog_.press_key(event.code)) open(*path);
    return;
  }
  if (is_typing_) return;
  if (const auto command = find_command(event.code, event.modifiers)) execute(*command);
}

void Viewer::execute(Command command) {
  switch (command) {
    case Command::open:
      open_dialog_.open(has_file() ? requested_path_.parent_path() : working_folder());
      break;
    case Command::reload:
      if (has_file()) open(requested_path_);
      break;
    case Command::save_view:
      save_view();
      break;
    case Command::frame_all:
      viewpoint_.frame_all(aspect());
      break;
    case Command::reset_view:
      viewpoint_.reset(aspect());
      break;
    case Command::front:
      viewpoint_.look_along(Axis::front);
      break;
    case Command::back:
      viewpoint_.look_along(Axis::back);
      break;
    case Command::right:
      viewpoint_.look_along(Axis::right);
      break;
    case Command::left:
      viewpoint_.look_along(Axis::left);
      break;
    case Command::top:
      viewpoint_.look_along(Axis::top);
      break;
    case Command::bottom:
      viewpoint_.look_along(Axis::bottom);
      break;
    case Command::toggle_bvh:
      settings_.is_bvh_on = !settings_.is_bvh_on;
      break;
    case Command::toggle_panel:
      is_panel_shown_ = !is_panel_shown_;
      break;
    case Command::screenshot:
      save_screenshot();
      break;
    case Command::full_screen:
      window_.toggle_full_screen();
      break;
    case Command::cheat_sheet:
      is_cheat_sheet_shown_ = !is_cheat_sheet_shown_;
      break;
    case Command::escape:
      escape();
      break;
    case Command::quit:
      glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
      break;
  }
}

void Viewer::escape() {
  if (std::exchange(is_cheat_sheet_shown_, false)) return;
  if (!std::exchange(shown_error_, {}).empty()) return;
  if (std::exchange(are_warnings_shown_, false)) return;
  if (is_job_running()) session_.cancel_job();
}

void Viewer::save_view() {
  if (adopted_path_.empty()) return;
  if (tracer::is_standard_input(adopted_path_)) {
    return show_toast("A view is saved beside its model's file; this model has none");
  }
  const std::filesystem::path path = tracer::view_path_of(adopted_path_);
  try {
    tracer::save_view(path, {viewpoint_.camera(), picture_.size_px(), settings_.sky()});
    show_toast("Saved " + path.filename().string());
  } catch (const std::exception& exception) {
    show_toast(exception.what());
  }
}

void Viewer::save_screenshot() {
  if (picture_.is_empty() || screenshots_.is_busy()) return;
  screenshots_.write(next_screenshot_path(working_folder(), adopted_path_), picture_.linear(),
                     settings_.render.exposure);
}

void Viewer::show_toast(std::string text) {
  toast_ = std::move(text);
  toast_end_seconds_ = glfwGetTime() + toast_seconds;
}

}  // namespace app
