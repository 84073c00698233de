// SPDX-License-Identifier: MIT
// Fonts, colours and sizes of the panel.
#pragma once

#include <imgui.h>

namespace app {

namespace palette {
inline const ImVec4 text{0.90f, 0.91f, 0.92f, 1.00f};
inline const ImVec4 dim{0.56f, 0.58f, 0.61f, 1.00f};
inline const ImVec4 accent{0.45f, 0.73f, 0.51f, 1.00f};
inline const ImVec4 warning{0.93f, 0.72f, 0.36f, 1.00f};
inline const ImVec4 error{0.95f, 0.46f, 0.41f, 1.00f};
inline const ImVec4 backdrop{0.085f, 0.088f, 0.092f, 1.00f};  // where no picture is
inline const ImVec4 panel{0.118f, 0.122f, 0.128f, 1.00f};
}  // namespace palette

/// The fonts of the current style; regular is the default.
struct Fonts {
  ImFont* regular = nullptr;
  ImFont* bold = nullptr;
};

/// Sets the style of the current ImGui context. `ui_scale` multiplies all sizes; letters are drawn
/// with `pixel_ratio` framebuffer pixels a window coordinate.
Fonts apply_style(double ui_scale, double pixel_ratio);

}  // namespace app
