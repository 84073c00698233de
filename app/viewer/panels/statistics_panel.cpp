// SPDX-License-Identifier: MIT
#include "app/viewer/panels/statistics_panel.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace app {
namespace {

Quantity count_or_dash(uint64_t count) {
  return {count > 0 ? format_count(count) : "–", ""};
}

Quantity rate(double mrays_per_second) {
  return {mrays_per_second > 0 ? format_three_digits(mrays_per_second) : "–", "Mray/s"};
}

void draw_speed_up(const Ui& ui, const Status& status) {
  const double speed_up = speed_up_of(status);
  ImGui::Dummy(ImVec2(0, 1 * ui.scale));
  if (speed_up > 0) {
    ImGui::PushFont(ui.fonts.bold);
    ImGui::PushStyleColor(ImGuiCol_Text, speed_up >= 1 ? palette::accent : palette::warning);
    ImGui::Text("× %s", format_three_digits(speed_up).c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::SameLine(0, 5 * ui.scale);
    ImGui::TextUnformatted("the speed of brute force");
  } else {
    ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
    const bool has_tree_rate = status.mrays_per_second_bvh > 0;
    ImGui::TextUnformatted(has_tree_rate  ? "Switch the BVH off to compare (B)"
                           : status.model ? "Switch the BVH on to compare (B)"
                                          : " ");
    ImGui::PopStyleColor();
  }
  ui.layout.note_last_item("speed-up");
  tooltip(ui, fmt::format("Rays of this very view: {} Mray/s with the tree, {} without.",
                          rate(status.mrays_per_second_bvh).value,
                          rate(status.mrays_per_second_brute_force).value));
}

// By how much the tree in use has become cheaper since it was built.
Quantity improvement(const Status& status) {
  if (status.improvement_rounds == 0) return {status.is_improving ? "..." : "–", "%"};
  const double part = 1 - status.tree.sah_cost / status.first_sah_cost;
  return {fmt::format("−{:.1f}", 100 * part), "%"};
}

void draw_tree(const Ui& ui, const Status& status) {
  const tracer::TreeMetrics& tree = status.tree;
  const uint32_t triangle_count = status.model ? status.model->scene.mesh->triangle_count() : 0;
  number_row(ui, "Triangles", count_or_dash(triangle_count));
  number_row(ui, "Nodes", count_or_dash(tree.node_count));
  number_row(ui, "Leaves", count_or_dash(tree.leaf_count));
  const bool has_tree = tree.node_count > 0;
  number_row(ui, "Depth", {has_tree ? std::to_string(tree.depth) : "–", ""});
  number_row(ui, "Largest leaf", count_or_dash(tree.largest_leaf));
  number_row(ui, "SAH cost", {has_tree ? format_three_digits(tree.sah_cost) : "–", ""});
  number_row(ui, "Improved", improvement(status));
  number_row(ui, "Build", has_tree ? format_seconds(status.build_seconds) : Quantity{"–", "ms"});
  number_row(ui, "Load", status.model ? format_seconds(status.load_seconds) : Quantity{"–", "ms"});
}

void draw_tracing(const Ui& ui, const Status& status, int sample_limit) {
  number_row(ui, "Rate", rate(status.mrays_per_second));
  ui.layout.note_last_item("rate");
  const Quantity rays = format_large(static_cast<double>(status.rays));
  number_row(ui, "Rays", {rays.value, rays.unit});
  // What is traced stays when the limit is lowered below it.
  const uint32_t limit = std::max(static_cast<uint32_t>(sample_limit), status.samples);
  number_row(ui, "Samples", {format_count(status.samples), fmt::format("/ {}", limit)});
  ui.layout.note_last_item("samples");
  number_row(ui, "Time", format_seconds(status.seconds));
  const float part = static_cast<float>(status.samples) / static_cast<float>(limit);
  ImGui::ProgressBar(part, ImVec2(-FLT_MIN, 3 * ui.scale), "");
}

}  // namespace

double speed_up_of(const Status& status) {
  if (!(status.mrays_per_second_brute_force > 0)) return 0;
  return status.mrays_per_second_bvh / status.mrays_per_second_brute_force;
}

void draw_statistics(const Ui& ui, const Status& status, int sample_limit) {
  if (!section(ui, "Statistics")) return;
  draw_tree(ui, status);
  ImGui::Separator();
  draw_tracing(ui, status, sample_limit);
  draw_speed_up(ui, status);
}

}  // namespace app
