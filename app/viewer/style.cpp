// SPDX-License-Identifier: MIT
#include "app/viewer/style.h"

#include <cmath>
#include <filesystem>

namespace app {
namespace {

constexpr double font_size = 14.0;

// Latin, Greek, Cyrillic; dashes, quotes and dots; arrows, the triangle of warnings.
constexpr ImWchar glyph_ranges[] = {0x0020, 0x017F, 0x0370, 0x052F, 0x2010, 0x2044, 0x2190,
                                    0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF, 0};

ImFont* add_font(const char* file_name, double size_px) {
  const std::filesystem::path folder = "/usr/share/fonts/truetype/dejavu";
  const std::filesystem::path path = folder / file_name;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) {
    return atlas.AddFontFromFileTTF(path.c_str(), static_cast<float>(size_px), nullptr,
                                    glyph_ranges);
  }
  ImFontConfig config;
  config.SizePixels = static_cast<float>(size_px);
  return atlas.AddFontDefault(&config);
}

void set_colors(ImVec4* colors) {
  const ImVec4 field(0.17f, 0.177f, 0.186f, 1);
  const ImVec4 field_hovered(0.215f, 0.225f, 0.236f, 1);
  const ImVec4 field_active(0.25f, 0.262f, 0.275f, 1);
  const ImVec4 none(0, 0, 0, 0);
  colors[ImGuiCol_Text] = palette::text;
  colors[ImGuiCol_TextDisabled] = palette::dim;
  colors[ImGuiCol_WindowBg] = palette::panel;
  colors[ImGuiCol_PopupBg] = ImVec4(0.14f, 0.145f, 0.152f, 0.99f);
  colors[ImGuiCol_Border] = ImVec4(1, 1, 1, 0.08f);
  colors[ImGuiCol_FrameBg] = field;
  colors[ImGuiCol_FrameBgHovered] = field_hovered;
  colors[ImGuiCol_FrameBgActive] = field_active;
  colors[ImGuiCol_Button] = field;
  colors[ImGuiCol_ButtonHovered] = field_hovered;
  colors[ImGuiCol_ButtonActive] = field_active;
  colors[ImGuiCol_Header] = ImVec4(0.30f, 0.47f, 0.34f, 0.75f);
  colors[ImGuiCol_HeaderHovered] = field_hovered;
  colors[ImGuiCol_HeaderActive] = field_active;
  colors[ImGuiCol_CheckMark] = palette::accent;
  colors[ImGuiCol_SliderGrab] = ImVec4(0.38f, 0.60f, 0.43f, 1);
  colors[ImGuiCol_SliderGrabActive] = palette::accent;
  colors[ImGuiCol_PlotHistogram] = ImVec4(0.38f, 0.60f, 0.43f, 1);
  colors[ImGuiCol_Separator] = ImVec4(1, 1, 1, 0.07f);
  colors[ImGuiCol_ScrollbarBg] = none;
  colors[ImGuiCol_ScrollbarGrab] = ImVec4(1, 1, 1, 0.14f);
  colors[ImGuiCol_TextSelectedBg] = ImVec4(0.30f, 0.47f, 0.34f, 0.8f);
  colors[ImGuiCol_NavHighlight] = none;
}

}  // namespace

Fonts apply_style(double ui_scale, double pixel_ratio) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsDark(&style);
  set_colors(style.Colors);
  style.WindowPadding = ImVec2(14, 12);
  style.FramePadding = ImVec2(8, 3);
  style.ItemSpacing = ImVec2(8, 5);
  style.ItemInnerSpacing = ImVec2(6, 4);
  style.WindowRounding = 6;
  style.FrameRounding = 4;
  style.GrabRounding = 3;
  style.PopupRounding = 5;
  style.ScrollbarSize = 10;
  style.GrabMinSize = 4;
  style.WindowBorderSize = 1;
  style.FrameBorderSize = 0;
  style.ScaleAllSizes(static_cast<float>(ui_scale));

  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const double size_px = std::round(font_size * ui_scale * pixel_ratio);
  const Fonts fonts{add_font("DejaVuSans.ttf", size_px), add_font("DejaVuSans-Bold.ttf", size_px)};
  io.FontGlobalScale = static_cast<float>(1 / pixel_ratio);
  return fonts;
}

}  // namespace app
