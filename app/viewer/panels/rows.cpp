// SPDX-License-Identifier: MIT
#include "app/viewer/panels/rows.h"

namespace app {
namespace {

// Where controls begin and how much room units take, unscaled.
constexpr float control_column = 104;
constexpr float unit_column = 48;

}  // namespace

bool section(const Ui& ui, const char* title) {
  ImGui::Dummy(ImVec2(0, 2 * ui.scale));
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(1, 1, 1, 0.035f));
  ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImVec4(1, 1, 1, 0.07f));
  ImGui::PushFont(ui.fonts.bold);
  const bool is_open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
  ImGui::PopFont();
  ImGui::PopStyleColor(2);
  ui.layout.note_last_item(std::string("section ") + title);
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
  if (text.empty() || !ImGui::IsItemHovered()) return;
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
  const float room = ImGui::GetContentRegionAvail().x;
  const float width =
      (room - gap * static_cast<float>(labels.size() - 1)) / static_cast<float>(labels.size());
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(gap, ImGui::GetStyle().ItemSpacing.y));
  int index = 0;
  int result = chosen;
  for (const char* label : labels) {
    if (index > 0) ImGui::SameLine();
    ImGui::PushID(index);
    const ImGuiCol color = index == chosen ? ImGuiCol_Header : ImGuiCol_FrameBg;
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(color));
    if (ImGui::Button((std::string(label) + "##" + name).c_str(), ImVec2(width, 0))) {
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

void number_row(const Ui& ui, const char* label, const Quantity& quantity) {
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  ImGui::TextUnformatted(label);
  ImGui::PopStyleColor();
  const float right = ImGui::GetWindowContentRegionMax().x - unit_column * ui.scale;
  ImGui::SameLine(right - ImGui::CalcTextSize(quantity.value.c_str()).x);
  ImGui::TextUnformatted(quantity.value.c_str());
  if (quantity.unit.empty()) return;
  ImGui::SameLine(right + 6 * ui.scale);
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  ImGui::TextUnformatted(quantity.unit.c_str());
  ImGui::PopStyleColor();
}

}  // namespace app
