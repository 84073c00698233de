// SPDX-License-Identifier: MIT
#include "app/viewer/panels/open_dialog.h"

#include <algorithm>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace app {
namespace {

constexpr size_t rows_a_page = 10;

std::string format_size(uint64_t size_bytes) {
  const Quantity size = format_bytes(size_bytes);
  return size.value + ' ' + size.unit;
}

}  // namespace

void OpenDialog::open(const std::filesystem::path& folder) {
  is_open_ = true;
  show_folder(folder);
}

void OpenDialog::show_folder(const std::filesystem::path& folder) {
  listing_ = list_folder(folder);
  filter_.fill('\0');
  takes_focus_ = true;
  apply_filter();
}

void OpenDialog::apply_filter() {
  shown_ = filter_entries(listing_.entries, filter_.data());
  selected_ = 0;
  has_moved_ = true;
}

std::optional<std::filesystem::path> OpenDialog::choose(const FolderEntry& entry) {
  const std::filesystem::path path = listing_.folder / entry.name;
  if (entry.is_folder) {
    show_folder(path);
    return std::nullopt;
  }
  is_open_ = false;
  return path;
}

std::optional<std::filesystem::path> OpenDialog::press_key(int key) {
  const size_t last = shown_.empty() ? 0 : shown_.size() - 1;
  has_moved_ = true;
  switch (key) {
    case GLFW_KEY_ESCAPE:
      close();
      break;
    case GLFW_KEY_UP:
      selected_ -= selected_ > 0 ? 1 : 0;
      break;
    case GLFW_KEY_DOWN:
      selected_ = std::min(selected_ + 1, last);
      break;
    case GLFW_KEY_PAGE_UP:
      selected_ -= std::min(selected_, rows_a_page);
      break;
    case GLFW_KEY_PAGE_DOWN:
      selected_ = std::min(selected_ + rows_a_page, last);
      break;
    case GLFW_KEY_BACKSPACE:
      if (filter_[0] == '\0') show_folder(listing_.folder.parent_path());
      break;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      if (selected_ < shown_.size()) return choose(FolderEntry(shown_[selected_]));
      break;
    default:
      has_moved_ = false;
  }
  return std::nullopt;
}

bool OpenDialog::draw_entry(const Ui& ui, size_t entry_index) {
  const FolderEntry& entry = shown_[entry_index];
  const std::string label = entry.is_folder ? entry.name + '/' : entry.name;
  const bool is_selected = entry_index == selected_;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, entry.is_folder ? palette::dim : palette::text);
  const bool is_clicked =
      ImGui::Selectable(label.c_str(), is_selected, ImGuiSelectableFlags_SpanAllColumns);
  ImGui::PopStyleColor();
  ui.layout.note_last_item("open " + entry.name);
  if (is_selected && has_moved_) {
    ImGui::SetScrollHereY();
    has_moved_ = false;
  }
  ImGui::TableNextColumn();
  if (!entry.is_folder) ImGui::TextDisabled("%s", format_size(entry.size_bytes).c_str());
  return is_clicked;
}

std::optional<std::filesystem::path> OpenDialog::draw_entries(const Ui& ui, float height) {
  std::optional<FolderEntry> clicked;
  const ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
  if (ImGui::BeginTable("##entries", 2, flags, ImVec2(0, height))) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 76 * ui.scale);
    for (size_t i = 0; i < shown_.size(); ++i) {
      if (draw_entry(ui, i)) clicked = shown_[i];
    }
    ImGui::EndTable();
  }
  return clicked ? choose(*clicked) : std::nullopt;
}

std::optional<std::filesystem::path> OpenDialog::draw(const Ui& ui, const PictureArea& area) {
  if (!is_open_) return std::nullopt;
  const tracer::Vec2f center = tracer::Vec2f(area.min + 0.5 * area.size);
  const tracer::Vec2f size = min(tracer::Vec2f(560, 440) * ui.scale, tracer::Vec2f(area.size));
  ImGui::SetNextWindowPos(ImVec2(center.x, center.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(size.x, size.y));
  ImGui::Begin("##open", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::PushFont(ui.fonts.bold);
  ImGui::TextUnformatted("Open a model");
  ImGui::PopFont();
  ImGui::TextDisabled("%s", listing_.folder.c_str());
  const float button_width = 84 * ui.scale;
  ImGui::SetNextItemWidth(-2 * (button_width + ImGui::GetStyle().ItemSpacing.x));
  if (takes_focus_) {
    ImGui::SetKeyboardFocusHere();
    takes_focus_ = false;
  }
  if (ImGui::InputTextWithHint("##filter", "type to narrow the list", filter_.data(),
                               filter_.size())) {
    apply_filter();
  }
  ui.layout.note_last_item("open-filter");
  ImGui::SameLine();
  if (ImGui::Button("Parent", ImVec2(button_width, 0))) show_folder(listing_.folder.parent_path());
  ui.layout.note_last_item("open-parent");
  ImGui::SameLine();
  if (ImGui::Button("Cancel", ImVec2(button_width, 0))) close();
  if (!listing_.error.empty()) ImGui::TextColored(palette::error, "%s", listing_.error.c_str());
  if (listing_.error.empty() && shown_.empty()) ImGui::TextDisabled("no OBJ files here");
  auto chosen = draw_entries(ui, ImGui::GetContentRegionAvail().y);
  ImGui::End();
  return chosen;
}

}  // namespace app
