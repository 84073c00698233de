// SPDX-License-Identifier: MIT
#include "app/viewer/panels/histogram.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

// Unscaled.
constexpr float height = 24;
constexpr float least_bar_height = 1;
constexpr float widest_bar = 30;

struct Bars {
  ImVec2 min;
  ImVec2 max;
  float width;  // of one, its gap included
};

void draw_bars(const Ui& ui, const Bars& bars, std::span<const uint32_t> counts, int hovered) {
  const auto most = static_cast<float>(*std::ranges::max_element(counts));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float gap = bars.width > 3 * ui.scale ? ui.scale : 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const float left = bars.min.x + static_cast<float>(i) * bars.width;
    const float bar = std::max(static_cast<float>(counts[i]) / most * (bars.max.y - bars.min.y),
                               least_bar_height * ui.scale);
    const ImGuiCol color =
        static_cast<int>(i) == hovered ? ImGuiCol_CheckMark : ImGuiCol_PlotHistogram;
    list.AddRectFilled(ImVec2(left, bars.max.y - bar), ImVec2(left + bars.width - gap, bars.max.y),
                       ImGui::GetColorU32(color));
  }
}

}  // namespace

void histogram(const Ui& ui, const std::string& name, float width, std::span<const uint32_t> counts,
               const std::string& help, const std::function<std::string(size_t)>& describe) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 max(min.x + width, min.y + height * ui.scale);
  ImGui::Dummy(ImVec2(width, height * ui.scale));
  ui.layout.note_last_item(name);
  ImGui::GetWindowDrawList()->AddRectFilled(min, max, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f),
                                            ImGui::GetStyle().FrameRounding);
  if (counts.empty()) return tooltip(ui, help);
  const float pad = 4 * ui.scale;
  const float inner = width - 2 * pad;
  const Bars bars{ImVec2(min.x + pad, min.y + pad), ImVec2(max.x - pad, max.y - 0.5f * pad),
                  std::min(inner / static_cast<float>(counts.size()), widest_bar * ui.scale)};
  const float place = std::floor((ImGui::GetMousePos().x - bars.min.x) / bars.width);
  const bool is_on_bar =
      ImGui::IsItemHovered() && place >= 0 && place < static_cast<float>(counts.size());
  const int hovered = is_on_bar ? static_cast<int>(place) : -1;
  draw_bars(ui, bars, counts, hovered);
  tooltip(ui, is_on_bar ? describe(static_cast<size_t>(place)) + '\n' + help : help);
}

}  // namespace app
