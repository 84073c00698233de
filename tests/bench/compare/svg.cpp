// SPDX-License-Identifier: MIT
#include "tests/bench/compare/svg.h"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/support/run_program.h"
#include "tests/support/virtual_display.h"

namespace bench::svg {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '&') {
      safe += "&amp;";
    } else if (letter == '<') {
      safe += "&lt;";
    } else {
      safe += letter;
    }
  }
  return safe;
}

}  // namespace

std::string text(double x, double y, const TextStyle& style, const std::string& content) {
  constexpr const char* anchors[] = {"start", "middle", "end"};
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\" "
      "font-weight=\"{}\" stroke=\"#FFFFFF\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
      x, y, style.size, style.color, anchors[static_cast<int>(style.anchor)], style.weight,
      escaped(content));
}

std::string rectangle(double x, double y, double width, double height, const std::string& color) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
      width, height, color);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, x2,
                     y1, y2, attributes);
}

std::string page(double height, const Frame& frame, const std::string& content) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 "
             "{0} {1}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n",
             page_width, height) +
         rectangle(0, 0, page_width, height, "#FFFFFF") +
         text(page_margin, 40, {.size = 24, .weight = "bold"}, frame.title) +
         text(page_margin, 64, {.size = 14, .color = "#555555"}, frame.subtitle) + content +
         text(page_margin, height - 14, {.size = 12, .color = "#777777"}, frame.footer) +
         "</svg>\n";
}

std::vector<std::filesystem::path> write_files(const std::string& svg,
                                               const std::filesystem::path& path) {
  const std::filesystem::path svg_path = path.string() + ".svg";
  const std::filesystem::path png_path = path.string() + ".png";
  if (!(std::ofstream(svg_path) << svg)) {
    throw std::runtime_error("cannot write " + svg_path.string());
  }
  const std::string converter = tests::find_program("rsvg-convert");
  if (converter.empty()) return {svg_path};
  const tests::ProgramResult result =
      tests::ChildProgram(converter, {"-o", png_path.string(), svg_path.string()}).wait();
  if (result.exit_code != 0) throw std::runtime_error(result.err);
  return {svg_path, png_path};
}

}  // namespace bench::svg
