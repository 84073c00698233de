// SPDX-License-Identifier: MIT
#include "app/viewer/layout_report.h"

#include <fstream>
#include <utility>

#include <imgui.h>
#include <nlohmann/json.hpp>

namespace app {

void LayoutReport::note(const std::string& name, const tracer::Vec2f& min,
                        const tracer::Vec2f& max) {
  if (path_.empty()) return;
  noted_[name] = {static_cast<int>(min.x), static_cast<int>(min.y), static_cast<int>(max.x),
                  static_cast<int>(max.y)};
}

void LayoutReport::note_last_item(const std::string& name) {
  // A window that fits itself to what it holds is not seen in its first frame, and not in place.
  if (ImGui::IsWindowAppearing()) return;
  const ImVec2 min = ImGui::GetItemRectMin();
  const ImVec2 max = ImGui::GetItemRectMax();
  note(name, {min.x, min.y}, {max.x, max.y});
}

void LayoutReport::finish_frame() {
  if (noted_ != written_) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, at] : noted_) json[name] = {at.x0, at.y0, at.x1, at.y1};
    std::filesystem::path partial = path_;
    partial += ".part";
    std::ofstream(partial) << json.dump(1) << '\n';
    std::error_code ignored;
    std::filesystem::rename(partial, path_, ignored);
    written_ = noted_;
  }
  noted_.clear();
}

}  // namespace app
