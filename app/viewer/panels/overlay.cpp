// SPDX-License-Identifier: MIT
#include "app/viewer/panels/overlay.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "app/viewer/commands.h"
#include "tracer/base/byte_source.h"

namespace app {
namespace {

constexpr ImGuiWindowFlags floating = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

constexpr float margin = 16;

/// Begins a window whose `pivot` (0, 0 its upper left) lies at that part of the picture.
void begin_floating(const Ui& ui, const char* name, const PictureArea& area, ImVec2 pivot) {
  const tracer::Vec2f inset(margin * ui.scale);
  const tracer::Vec2f room = tracer::Vec2f(area.size) - 2.0f * inset;
  const tracer::Vec2f corner = tracer::Vec2f(area.min) + inset;
  ImGui::SetNextWindowPos(ImVec2(corner.x + pivot.x * room.x, corner.y + pivot.y * room.y),
                          ImGuiCond_Always, pivot);
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0),
                                      ImVec2(std::max(room.x, 1.0f), std::max(room.y, 1.0f)));
  ImGui::SetNextWindowBgAlpha(0.93f);
  ImGui::Begin(name, nullptr, floating);
}

bool draw_button(const Ui& ui, const char* label, const char* name) {
  const bool is_pressed = ImGui::Button(label);
  ui.layout.note_last_item(name);
  return is_pressed;
}

void colored_text(const ImVec4& color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void bold_text(const Ui& ui, const ImVec4& color, const std::string& text) {
  ImGui::PushFont(ui.fonts.bold);
  colored_text(color, text);
  ImGui::PopFont();
}

std::string plural(int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", format_count(static_cast<uint64_t>(count)), count == 1 ? one : many);
}

float text_width(const PictureArea& area, const Ui& ui) {
  return std::min(620 * ui.scale, static_cast<float>(area.size.x) - 5 * margin * ui.scale);
}

void draw_sheet_row(const char* keys, const char* what) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  colored_text(palette::accent, keys);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
}

}  // namespace

OverlayAnswer draw_progress(const Ui& ui, const PictureArea& area, const Status& status) {
  begin_floating(ui, "##progress", area, ImVec2(0.5f, 1));
  const std::string model = tracer::short_name_of_input(status.loading_path);
  const std::string subject = status.is_loading ? "Loading " + model : "Building";
  ImGui::TextUnformatted(subject.c_str());
  ImGui::SameLine();
  colored_text(palette::dim, status.stage);
  ImGui::ProgressBar(status.fraction, ImVec2(260 * ui.scale, ImGui::GetFrameHeight()));
  ui.layout.note_last_item("progress");
  ImGui::SameLine();
  const bool is_cancelled = draw_button(ui, "Cancel", "cancel");
  ImGui::End();
  return is_cancelled ? OverlayAnswer::cancel : OverlayAnswer::none;
}

OverlayAnswer draw_error(const Ui& ui, const PictureArea& area, const std::string& error) {
  ImGui::PushStyleColor(ImGuiCol_Border, palette::error);
  begin_floating(ui, "##error", area, ImVec2(0.5f, 0));
  ImGui::PushTextWrapPos(text_width(area, ui));
  colored_text(palette::error, error);
  ImGui::PopTextWrapPos();
  ui.layout.note_last_item("error");
  const bool is_dismissed = draw_button(ui, "Dismiss", "dismiss-error");
  ImGui::End();
  ImGui::PopStyleColor();
  return is_dismissed ? OverlayAnswer::dismiss : OverlayAnswer::none;
}

std::string summarize(const tracer::ImportedScene& model) {
  std::string text = plural(model.warnings.count(), "warning", "warnings");
  if (model.dropped_faces > 0) {
    text += ", " + plural(model.dropped_faces, "face left out", "faces left out");
  }
  return text;
}

OverlayAnswer draw_warnings(const Ui& ui, const PictureArea& area,
                            const tracer::ImportedScene& model) {
  begin_floating(ui, "##warnings", area, ImVec2(0, 0));
  bold_text(ui, palette::warning, summarize(model));
  ui.layout.note_last_item("warnings");
  ImGui::PushTextWrapPos(text_width(area, ui));
  for (const tracer::Message& message : model.warnings.messages()) {
    ImGui::TextUnformatted(message.text().c_str());
  }
  ImGui::PopTextWrapPos();
  const int64_t unlisted =
      model.warnings.count() - static_cast<int64_t>(model.warnings.messages().size());
  if (unlisted > 0) colored_text(palette::dim, fmt::format("and {} more", unlisted));
  const bool is_dismissed = draw_button(ui, "Dismiss", "dismiss-warnings");
  ImGui::End();
  return is_dismissed ? OverlayAnswer::dismiss : OverlayAnswer::none;
}

void draw_toast(const Ui& ui, const PictureArea& area, const std::string& text) {
  begin_floating(ui, "##toast", area, ImVec2(0, 1));
  ImGui::PushTextWrapPos(text_width(area, ui));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ui.layout.note_last_item("toast");
  ImGui::End();
}

void draw_welcome(const Ui& ui, const PictureArea& area) {
  begin_floating(ui, "##welcome", area, ImVec2(0.5f, 0.5f));
  bold_text(ui, palette::text, "Drop an OBJ file here");
  colored_text(palette::dim, "or press Ctrl O to choose one, H for help");
  ImGui::End();
}

OverlayAnswer draw_cheat_sheet(const Ui& ui, const PictureArea& area) {
  begin_floating(ui, "##cheat-sheet", area, ImVec2(0.5f, 0.5f));
  bold_text(ui, palette::text, "Mouse and keys");
  ui.layout.note_last_item("cheat-sheet");
  ImGui::Dummy(ImVec2(0, 2 * ui.scale));
  if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 92 * ui.scale);
    for (const MouseGesture& gesture : mouse_gestures()) {
      draw_sheet_row(gesture.gesture, gesture.what);
    }
    for (const KeyBinding& binding : key_bindings()) {
      if (binding.keys[0] != '\0') draw_sheet_row(binding.keys, binding.what);
    }
    ImGui::EndTable();
  }
  ImGui::Dummy(ImVec2(0, 2 * ui.scale));
  const bool is_dismissed = draw_button(ui, "Close", "close-cheat-sheet");
  ImGui::End();
  return is_dismissed ? OverlayAnswer::dismiss : OverlayAnswer::none;
}

}  // namespace app
