// SPDX-License-Identifier: MIT
#include "app/viewer/panels/rows.h"

#include <algorithm>

namespace app {
namespace {

// Where controls begin and how much room units take, unscaled.
constexpr float control_column = 118;
constexpr float unit_column = 48;
constexpr float unit_gap = 6;
constexpr float cell_gap = 20;

}  // namespace

bool section(const Ui& ui, const char* title) {
  ImGui::Dummy(ImVec2(0, 2 * ui.scale));
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(1, 1, 1, 0.035f));
  ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImVec4(1, 1, 1, 0.07f));
  ImGui::PushFont(ui.fonts.bold);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(3 * ui.scale, 3 * ui.scale));
  const bool is_open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  ImGui::PopStyleColor(2);
  ui.layout.note_last_item(std::string("section ") + title);
  return is_open;
}

bool closed_part(const Ui& ui, const char* title) {
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  const bool is_open = ImGui::TreeNodeEx(
      title, ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen);
  ImGui::PopStyleColor();
  ui.layout.note_last_item(std::string("part ") + title);
  return is_open;
}

void control_label(const Ui& ui, const std::string& label) {
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  ImGui::TextUnformatted(label.c_str());
  ImGui::PopStyleColor();
  ImGui::SameLine(control_column * ui.scale);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void tooltip(const Ui& ui, const std::string& text) {
  // In mid-drag the hand knows what it holds, and the picture is what is looked at.
  if (text.empty() || !ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  // Beside the panel, level with the item: over the controls it would hide the next one.
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetWindowPos().x - 6 * ui.scale, ImGui::GetItemRectMin().y),
                          ImGuiCond_Always, ImVec2(1, 0));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(260 * ui.scale);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void finish_control(const Ui& ui, const std::string& name, const std::string& help) {
  ui.layout.note_last_item(name);
  tooltip(ui, help);
}

int segmented(const Ui& ui, const std::string& name, std::initializer_list<const char*> labels,
              int chosen) {
  const float gap = 2 * ui.scale;
  const auto width_of = [](const char* label) { return ImGui::CalcTextSize(label).x; };
  float room = ImGui::GetContentRegionAvail().x - gap * static_cast<float>(labels.size() - 1);
  for (const char* label : labels) room -= width_of(label);
  const float padding = room / static_cast<float>(labels.size());  // the same around each
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(gap, ImGui::GetStyle().ItemSpacing.y));
  int index = 0;
  int result = chosen;
  for (const char* label : labels) {
    if (index > 0) ImGui::SameLine();
    ImGui::PushID(index);
    const ImGuiCol color = index == chosen ? ImGuiCol_Header : ImGuiCol_FrameBg;
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(color));
    if (ImGui::Button((std::string(label) + "##" + name).c_str(),
                      ImVec2(width_of(label) + padding, 0))) {
      result = index;
    }
    ImGui::PopStyleColor();
    ui.layout.note_last_item(name + ' ' + label);
    ImGui::PopID();
    ++index;
  }
  ImGui::PopStyleVar();
  return result;
}

void begin_slider(double part, float kept_width) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x - kept_width;
  const ImVec2 max(min.x + width, min.y + ImGui::GetFrameHeight());
  const bool is_hovered = ImGui::IsMouseHoveringRect(min, max);
  const float rounding = ImGui::GetStyle().FrameRounding;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(min, max,
                     ImGui::GetColorU32(is_hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg),
                     rounding);
  const float filled = static_cast<float>(std::clamp(part, 0.0, 1.0)) * width;
  if (filled > 0) {
    list.PushClipRect(min, ImVec2(min.x + filled, max.y), true);
    list.AddRectFilled(min, max, ImGui::GetColorU32(ImGuiCol_Header), rounding);
    list.PopClipRect();
  }
  ImGui::SetNextItemWidth(width);
  const ImVec4 none(0, 0, 0, 0);
  for (const ImGuiCol color : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive,
                               ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}) {
    ImGui::PushStyleColor(color, none);
  }
}

void end_slider() {
  ImGui::PopStyleColor(5);
}

void number_row(const Ui& ui, const char* label, const Quantity& quantity) {
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  ImGui::TextUnformatted(label);
  ImGui::PopStyleColor();
  const float right = ImGui::GetWindowContentRegionMax().x - unit_column * ui.scale;
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - ImGui::CalcTextSize(quantity.value.c_str()).x);
  ImGui::TextUnformatted(quantity.value.c_str());
  if (quantity.unit.empty()) return;
  ImGui::SameLine();
  ImGui::SetCursorPosX(right + unit_gap * ui.scale);
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  ImGui::TextUnformatted(quantity.unit.c_str());
  ImGui::PopStyleColor();
}

void number_row(const Ui& ui, const char* label, const Quantity& quantity,
                const std::string& help) {
  ImGui::BeginGroup();
  number_row(ui, label, quantity);
  ImGui::EndGroup();
  tooltip(ui, help);
}

float place_cell(const Ui& ui, int cell, int cell_count) {
  if (cell > 0) ImGui::SameLine();
  const float left = ImGui::GetWindowContentRegionMin().x;
  const float room = ImGui::GetWindowContentRegionMax().x - left;
  const float gap = cell_gap * ui.scale;
  const float width = (room + gap) / static_cast<float>(cell_count) - gap;
  ImGui::SetCursorPosX(left + static_cast<float>(cell) * (width + gap));
  return width;
}

void cell_row(const Ui& ui, std::initializer_list<Cell> cells) {
  const ImU32 dim = ImGui::GetColorU32(palette::dim);
  const auto width_of = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  int index = 0;
  for (const Cell& cell : cells) {
    const float width = place_cell(ui, index++, static_cast<int>(cells.size()));
    const ImVec2 left = ImGui::GetCursorScreenPos();
    ImGui::Dummy(ImVec2(width, ImGui::GetTextLineHeight()));
    tooltip(ui, cell.help);
    const std::string& unit = cell.quantity.unit;
    const float unit_left = left.x + width - width_of(unit);
    const float value_right = unit.empty() ? unit_left : unit_left - unit_gap * ui.scale;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(left, dim, cell.label);
    list.AddText(ImVec2(value_right - width_of(cell.quantity.value), left.y),
                 ImGui::GetColorU32(palette::text), cell.quantity.value.c_str());
    list.AddText(ImVec2(unit_left, left.y), dim, unit.c_str());
  }
}

}  // namespace app
