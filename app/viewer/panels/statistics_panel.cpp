// SPDX-License-Identifier: MIT
#include "app/viewer/panels/statistics_panel.h"

#include <algorithm>
#include <span>
#include <string>

#include <fmt/format.h>

#include "app/replay.h"
#include "app/viewer/panels/error_plot.h"
#include "app/viewer/panels/histogram.h"

namespace app {
namespace {

Quantity count_or_dash(uint64_t count) {
  return {count > 0 ? format_count(count) : "–", ""};
}

Quantity rate(double mrays_per_second) {
  return {mrays_per_second > 0 ? format_three_digits(mrays_per_second) : "–", "Mray/s"};
}

Quantity memory(size_t bytes) {
  return bytes > 0 ? format_bytes(bytes) : Quantity{"–", "MB"};
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

std::string of_leaves(uint32_t count) {
  return fmt::format("{} {}", format_count(count), count == 1 ? "leaf" : "leaves");
}

Quantity number_or_dash(bool is_known, double value) {
  return {is_known ? format_three_digits(value) : "–", ""};
}

void draw_histograms(const Ui& ui, const tracer::TreeMetrics& tree) {
  const std::string depth_help =
      "How many leaves lie how deep. A tree that treats all alike has one narrow hill.";
  histogram(ui, "leaf-depths", place_cell(ui, 0, 2), tree.leaves_at_depth, depth_help,
            [&](size_t depth) {
              return fmt::format("{} at depth {}.", of_leaves(tree.leaves_at_depth[depth]), depth);
            });
  // No leaf is empty: the first bar is of those of one triangle.
  const std::span<const uint32_t> sizes(tree.leaves_of_size);
  histogram(ui, "leaf-sizes", place_cell(ui, 1, 2), sizes.empty() ? sizes : sizes.subspan(1),
            "How many leaves hold how many triangles.", [&](size_t bar) {
              const size_t size = bar + 1;
              return fmt::format("{} of {}{} {}.", of_leaves(sizes[size]), size,
                                 size == tracer::largest_told_leaf ? " or more" : "",
                                 size == 1 ? "triangle" : "triangles");
            });
}

void draw_costs(const Ui& ui, const Status& status) {
  const tracer::TreeMetrics& tree = status.tree;
  const tracer::TreeQuality quality = status.tree_quality.value_or(tracer::TreeQuality{});
  const bool has_tree = tree.node_count > 0;
  const bool has_quality = has_tree && status.tree_quality.has_value();
  const std::string sah_help = fmt::format(
      "Surface area heuristic: the nodes (cost {} each) and triangles (cost {} each) that a random "
      "line through the model is expected to meet. Lower is better.",
      tree.costs.traversal, tree.costs.intersection);
  const std::string epo_help = fmt::format(
      "Effective primitive overlap: the cost of nodes ({} each) and of their triangles ({} each) "
      "that "
      "a point of the surface lies in though its triangle is in none of their leaves, so work in "
      "vain. Lower is better. {}",
      tree.costs.traversal, tree.costs.intersection,
      quality.epo.sample_count > 0
          ? fmt::format("From {} points.", format_count(quality.epo.sample_count))
          : "Exact.");
  const std::string lcv_help = fmt::format(
      "Leaf count variability: by how much lines through the model differ in the number of leaves "
      "they meet (standard deviation). Lower is steadier. From {} lines.",
      format_count(quality.lcv.ray_count));
  cell_row(ui, {{"SAH", number_or_dash(has_tree, tree.sah_cost), sah_help},
                {"EPO", number_or_dash(has_quality, quality.epo.value), epo_help},
                {"LCV", number_or_dash(has_quality, quality.lcv.value), lcv_help}});
}

void draw_tree(const Ui& ui, const Status& status) {
  const tracer::TreeMetrics& tree = status.tree;
  const bool has_tree = tree.node_count > 0;
  const uint32_t triangle_count = status.model ? status.model->scene.mesh->triangle_count() : 0;
  number_row(ui, "Triangles", count_or_dash(triangle_count));
  cell_row(ui, {{"Nodes", count_or_dash(tree.node_count),
                 "Boxes in the tree: inner nodes, which hold two nodes each, and leaves."},
                {"Leaves", count_or_dash(tree.leaf_count), "Nodes that hold triangles."}});
  cell_row(ui, {{"Depth",
                 {has_tree ? std::to_string(tree.depth) : "–", ""},
                 "Steps from the root to the deepest leaf."},
                {"Largest leaf", count_or_dash(tree.largest_leaf),
                 "A ray that enters it is tested against so many triangles."}});
  draw_histograms(ui, tree);
  draw_costs(ui, status);
  cell_row(ui, {{"Improved", improvement(status),
                 "By how much re-insertion has lowered the SAH cost since the tree was built."},
                {"Memory", memory(status.tree_bytes),
                 "Held for the tree beside the mesh. The binary tree that was laid out for the "
                 "traversal counts until it is improved and measured, and is let go then."}});
  cell_row(ui, {{"Build", has_tree ? format_seconds(status.build_seconds) : Quantity{"–", "ms"},
                 "Building the tree and laying it out for the traversal."},
                {"Load", status.model ? format_seconds(status.load_seconds) : Quantity{"–", "ms"},
                 "Reading the file and making a mesh of it."}});
}

// Where samples go unevenly, a pixel has fewer than the noisiest ones.
void draw_samples(const Ui& ui, const Status& status, uint32_t limit) {
  const bool is_uneven = status.samples > 0 && status.mean_samples < 0.99 * status.samples;
  number_row(ui, "Samples", {format_count(status.samples), fmt::format("/ {}", limit)},
             is_uneven ? fmt::format("Of the noisiest pixels; {} in the mean.",
                                     format_three_digits(status.mean_samples))
                       : std::string("Of each pixel."));
  ui.layout.note_last_item("samples");
}

void draw_tracing(const Ui& ui, const Status& status, int sample_limit, double error_limit) {
  number_row(ui, "Rate", rate(status.mrays_per_second));
  ui.layout.note_last_item("rate");
  const Quantity rays = format_large(static_cast<double>(status.rays));
  // What is traced stays when the limit is lowered below it.
  const uint32_t limit = std::max(static_cast<uint32_t>(sample_limit), status.samples);
  draw_samples(ui, status, limit);
  cell_row(ui, {{"Rays", {rays.value, rays.unit}, "Traced for this picture."},
                {"Time", format_seconds(status.seconds), "Spent tracing this picture."}});
  error_plot(ui, "error-plot", status.errors, error_limit);
  if (status.dropped_samples > 0) {
    number_row(ui, "Dropped", {format_count(status.dropped_samples), ""},
               count_of_dropped(status.dropped_samples) + ". For the first: " + status.replay);
  }
  const float part = static_cast<float>(status.samples) / static_cast<float>(limit);
  ImGui::ProgressBar(part, ImVec2(-FLT_MIN, 3 * ui.scale), "");
}

}  // namespace

double speed_up_of(const Status& status) {
  if (!(status.mrays_per_second_brute_force > 0)) return 0;
  return status.mrays_per_second_bvh / status.mrays_per_second_brute_force;
}

void draw_statistics(const Ui& ui, const Status& status, int sample_limit, double error_limit) {
  if (!section(ui, "Statistics")) return;
  draw_tree(ui, status);
  ImGui::Separator();
  draw_tracing(ui, status, sample_limit, error_limit);
  draw_speed_up(ui, status);
}

}  // namespace app
