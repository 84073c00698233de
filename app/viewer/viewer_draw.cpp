// SPDX-License-Identifier: MIT
// Viewer: the picture, the panel and what floats over them.
#include <cmath>
#include <cstdint>
#include <filesystem>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/viewer/panels/overlay.h"
#include "app/viewer/panels/statistics_panel.h"
#include "app/viewer/viewer.h"
#include "tracer/base/byte_source.h"

namespace app {
namespace {

constexpr float panel_width = 312;
// A job is shown when it takes longer than this, so that short ones do not flicker.
constexpr double patience_seconds = 0.2;

constexpr ImGuiWindowFlags docked = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;

}  // namespace

void Viewer::lay_out() {
  const tracer::Vec2d size = max(window_.size(), tracer::Vec2i(1));
  const double panel = is_panel_shown_ ? std::round(panel_width * gui_.scale()) : 0;
  area_ = {{0, 0}, {std::max(size.x - panel, 1.0), size.y}};
  const tracer::Vec2f min(area_.min);
  layout_.note("picture", min, min + tracer::Vec2f(area_.size));
}

void Viewer::draw_background() {
  const tracer::Vec2d max = area_.min + area_.size;
  const tracer::Vec2d corner(window_.size());
  if (max.x < corner.x) gui_.fill({max.x, 0}, corner, palette::panel);
  if (adopted_generation_ == 0 || picture_.is_empty()) {
    gui_.fill(area_.min, max, palette::backdrop);
    return;
  }
  for (const tracer::Tile& tile : picture_.take_changes()) {
    texture_.upload(picture_.developed(), picture_.size_px(), tile);
  }
  texture_.show(gui_.framebuffer_tile(area_.min, max), window_.framebuffer_px().y);
  if (has_finished_picture()) {
    layout_.note("finished picture", tracer::Vec2f(area_.min), tracer::Vec2f(max));
  }
}

void Viewer::draw_header(const Ui& ui) {
  const std::string name =
      adopted_path_.empty() ? std::string("Boxwood") : tracer::short_name_of_input(adopted_path_);
  const float button_width = 58 * ui.scale;
  const float help_width = ImGui::GetFrameHeight();
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float buttons_left =
      ImGui::GetWindowContentRegionMax().x - button_width - 2 * help_width - 2 * gap;
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(ui.fonts.bold);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(start, ImVec2(ImGui::GetWindowPos().x + buttons_left - gap, start.y + 99),
                      true);
  ImGui::TextUnformatted(name.c_str());
  ImGui::PopClipRect();
  ImGui::PopFont();
  if (adopted_generation_ > 0) finish_control(ui, "model", adopted_path_);
  ImGui::SameLine(buttons_left);
  if (ImGui::Button("Open", ImVec2(button_width, 0))) execute(Command::open);
  finish_control(ui, "open", "Choose a model (Ctrl O)");
  ImGui::SameLine(0, gap);
  if (ImGui::Button("?", ImVec2(help_width, 0))) execute(Command::cheat_sheet);
  finish_control(ui, "help", "Mouse and keys (H)");
  ImGui::SameLine(0, gap);
  if (ImGui::ArrowButton("##hide", ImGuiDir_Right)) execute(Command::toggle_panel);
  finish_control(ui, "hide-panel", "Hide the panel (Tab)");
}

void Viewer::draw_panel(const Ui& ui) {
  if (!is_panel_shown_) {
    draw_panel_button(ui);
    answer_edits();
    return;
  }
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float left = static_cast<float>(area_.size.x);
  ImGui::SetNextWindowPos(ImVec2(left, 0));
  ImGui::SetNextWindowSize(ImVec2(std::max(display.x - left, 1.0f), display.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin("##panel", nullptr, docked | ImGuiWindowFlags_NoBackground);
  ImGui::PopStyleVar(2);
  draw_header(ui);
  if (status_.model && status_.model->warnings.count() > 0) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette::warning);
    if (ImGui::SmallButton(summarize(*status_.model).c_str())) {
      are_warnings_shown_ = !are_warnings_shown_;
    }
    ImGui::PopStyleColor();
    ui.layout.note_last_item("show-warnings");
  }
  draw_settings(ui, settings_, status_.builder);
  answer_edits();
  draw_statistics(ui, status_, settings_.sample_limit, settings_.error_limit);
  ImGui::End();
}

void Viewer::draw_panel_button(const Ui& ui) {
  const float inset = 10 * ui.scale;
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - inset, inset), ImGuiCond_Always,
                          ImVec2(1, 0));
  ImGui::SetNextWindowBgAlpha(0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin("##panel-button", nullptr, docked | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar(2);
  if (ImGui::ArrowButton("##show", ImGuiDir_Left)) execute(Command::toggle_panel);
  finish_control(ui, "show-panel", "Show the panel (Tab)");
  ImGui::End();
}

void Viewer::draw_overlays(const Ui& ui) {
  const double now = glfwGetTime();
  if (adopted_generation_ == 0 && !is_job_running()) draw_welcome(ui, area_);
  if (is_job_running() && now - job_start_seconds_ > patience_seconds) {
    if (draw_progress(ui, area_, status_) == OverlayAnswer::cancel) session_.cancel_job();
  }
  if (are_warnings_shown_ && status_.model) {
    const auto answer = draw_warnings(ui, area_, *status_.model);
    if (answer == OverlayAnswer::dismiss) are_warnings_shown_ = false;
  }
  if (!shown_error_.empty() && draw_error(ui, area_, shown_error_) == OverlayAnswer::dismiss) {
    shown_error_.clear();
  }
  if (!toast_.empty() && now >= toast_end_seconds_) toast_.clear();
  if (!toast_.empty()) draw_toast(ui, area_, toast_);
  if (is_cheat_sheet_shown_ && draw_cheat_sheet(ui, area_) == OverlayAnswer::dismiss) {
    is_cheat_sheet_shown_ = false;
  }
  if (const auto path = open_dialog_.draw(ui, area_)) open(*path);
}

}  // namespace app
