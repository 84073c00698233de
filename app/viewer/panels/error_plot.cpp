// SPDX-License-Identifier: MIT
#include "app/viewer/panels/error_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace app {
namespace {

// Unscaled.
constexpr float height = 34;
constexpr float label_width = 30;

/// A range of powers of ten, whole ones at its ends, over pixels.
class LogAxis {
 public:
  LogAxis(double least, double greatest, float from, float to)
      : first_(static_cast<int>(std::floor(std::log10(least)))),
        last_(std::max(static_cast<int>(std::ceil(std::log10(greatest))), first_ + 1)),
        from_(from),
        to_(to) {}

  int first() const { return first_; }
  int last() const { return last_; }
  float place(double value) const { return place_of_power(std::log10(value)); }
  float place_of_power(double power) const {
    const double part = (power - first_) / (last_ - first_);
    return from_ + static_cast<float>(part) * (to_ - from_);
  }

 private:
  int first_, last_;
  float from_, to_;
};

/// Points that a logarithm has a place for.
std::vector<ErrorPoint> drawable(std::span<const ErrorPoint> points) {
  std::vector<ErrorPoint> drawn;
  std::ranges::copy_if(points, std::back_inserter(drawn), [](const ErrorPoint& point) {
    return point.seconds > 0 && point.error.relmse > 0 && std::isfinite(point.error.relmse);
  });
  return drawn;
}

void draw_grid(const Ui& ui, const LogAxis& x, const LogAxis& y, const ImVec2& min,
               const ImVec2& max) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 line = ImGui::GetColorU32(ImVec4(1, 1, 1, 0.06f));
  for (int power = x.first(); power <= x.last(); ++power) {
    const float place = x.place_of_power(power);
    list.AddLine(ImVec2(place, min.y), ImVec2(place, max.y), line);
  }
  for (int power = y.first(); power <= y.last(); ++power) {
    const float place = y.place_of_power(power);
    list.AddLine(ImVec2(min.x, place), ImVec2(max.x, place), line);
  }
  const ImU32 dim = ImGui::GetColorU32(palette::dim);
  const float letter = ImGui::GetTextLineHeight();
  const float left = min.x - label_width * ui.scale;
  list.AddText(ImVec2(left, min.y - 0.2f * letter), dim, fmt::format("1e{}", y.last()).c_str());
  list.AddText(ImVec2(left, max.y - 0.8f * letter), dim, fmt::format("1e{}", y.first()).c_str());
  const auto in_words = [](int power) {
    const Quantity seconds = format_seconds(std::pow(10, power));
    return seconds.value + ' ' + seconds.unit;
  };
  const std::string last = in_words(x.last());
  list.AddText(ImVec2(min.x, max.y), dim, in_words(x.first()).c_str());
  list.AddText(ImVec2(max.x - ImGui::CalcTextSize(last.c_str()).x, max.y), dim, last.c_str());
}

std::string describe(const ErrorPoint& point) {
  const Quantity seconds = format_seconds(point.seconds);
  return fmt::format("After {} {}: {:.2g}, in 19 of 20 pictures at most {:.2g}.\n", seconds.value,
                     seconds.unit, point.error.relmse, point.error.upper_bound());
}

}  // namespace

void error_plot(const Ui& ui, const std::string& name, std::span<const ErrorPoint> points,
                double error_limit) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float letter = ImGui::GetTextLineHeight();
  ImGui::Dummy(ImVec2(width, height * ui.scale + letter));
  ui.layout.note_last_item(name);
  const ImVec2 min(corner.x + label_width * ui.scale, corner.y);
  const ImVec2 max(corner.x + width, corner.y + height * ui.scale);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(min, max, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f),
                     ImGui::GetStyle().FrameRounding);
  const std::string help =
      "The picture's error against the time spent on it, estimated from its own samples: relMSE, "
      "the mean of (x - r)^2 / (r^2 + 0.01), r what the picture converges to.";
  const std::vector<ErrorPoint> drawn = drawable(points);
  if (drawn.empty()) return tooltip(ui, help);

  const auto [least, greatest] =
      std::ranges::minmax(drawn, {}, [](const ErrorPoint& point) { return point.error.relmse; });
  const double least_error =
      error_limit > 0 ? std::min(error_limit, least.error.relmse) : least.error.relmse;
  const LogAxis x(drawn.front().seconds, drawn.back().seconds, min.x, max.x);
  const LogAxis y(least_error, greatest.error.relmse, max.y, min.y);
  draw_grid(ui, x, y, min, max);
  if (error_limit > 0) {
    const float place = y.place(std::min(error_limit, std::pow(10.0, y.last())));
    list.AddLine(ImVec2(min.x, place), ImVec2(max.x, place), ImGui::GetColorU32(palette::warning));
  }
  std::vector<ImVec2> line;
  line.reserve(drawn.size());
  for (const ErrorPoint& point : drawn) {
    line.emplace_back(x.place(point.seconds), y.place(point.error.relmse));
  }
  const ImU32 color = ImGui::GetColorU32(palette::accent);
  list.AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, 1.5f * ui.scale);
  list.AddCircleFilled(line.back(), 2.5f * ui.scale, color);
  // Errors fall: the upper right corner is free.
  const std::string now = fmt::format("error {:.2g}", drawn.back().error.relmse);
  const ImVec2 size = ImGui::CalcTextSize(now.c_str());
  list.AddText(ImVec2(max.x - size.x - 4 * ui.scale, min.y), ImGui::GetColorU32(palette::text),
               now.c_str());
  const float mouse = ImGui::GetMousePos().x;
  const auto nearest = std::ranges::min_element(
      line, {}, [mouse](const ImVec2& place) { return std::abs(place.x - mouse); });
  tooltip(ui, describe(drawn[static_cast<size_t>(nearest - line.begin())]) + help);
}

}  // namespace app
