// SPDX-License-Identifier: MIT
// Pieces of SVG that charts are made of, and files of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bench::svg {

enum class Anchor { start, middle, end };

struct TextStyle {
  double size;
  const char* color = "#222222";
  Anchor anchor = Anchor::start;
  const char* weight = "normal";
};

/// y is the baseline. A white rim keeps the text apart from what it lies on.
std::string text(double x, double y, const TextStyle& style, const std::string& content);
std::string rectangle(double x, double y, double width, double height, const std::string& color);
/// `attributes` tell of its stroke.
std::string line(double x1, double y1, double x2, double y2, const std::string& attributes);

constexpr double page_width = 1200;
constexpr double page_margin = 28;

/// What is said around a chart.
struct Frame {
  std::string title;
  std::string subtitle;
  std::string footer;
};

/// A chart on white: its title, a subtitle that ends at y = 70, the content, a footer at the end.
std::string page(double height, const Frame& frame, const std::string& content);

/// Writes PATH.svg, and PATH.png where rsvg-convert is found; returns the paths of what was
/// written. Throws std::runtime_error.
std::vector<std::filesystem::path> write_files(const std::string& svg,
                                               const std::filesystem::path& path);

}  // namespace bench::svg
