// SPDX-License-Identifier: MIT
#include "app/viewer/gui.h"

#include <algorithm>

#include <GL/gl.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

namespace app {

Gui::Gui(const Window& window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;  // a blinking cursor would wake a resting program
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  if (!ImGui_ImplOpenGL3_Init("#version 130")) {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    throw WindowError("the display offers no OpenGL 3");
  }
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::follow_scale() {
  const tracer::Vec2i size = window_.size();
  const tracer::Vec2i framebuffer_px = window_.framebuffer_px();
  if (size.x <= 0 || framebuffer_px.x <= 0) return;
  const double pixel_ratio = static_cast<double>(framebuffer_px.x) / size.x;
  const double ui_scale = window_.content_scale() / pixel_ratio;
  if (pixel_ratio == pixel_ratio_ && ui_scale == ui_scale_) return;
  pixel_ratio_ = pixel_ratio;
  ui_scale_ = ui_scale;
  fonts_ = apply_style(ui_scale, pixel_ratio);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Gui::follow_mouse(std::span<const InputEvent> input) {
  using Kind = InputEvent::Kind;
  ImGuiIO& io = ImGui::GetIO();
  for (const InputEvent& event : input) {
    const auto button = static_cast<size_t>(event.code);
    if (event.kind == Kind::key_press || event.kind == Kind::scroll) continue;
    io.MousePos = {static_cast<float>(event.cursor.x), static_cast<float>(event.cursor.y)};
    if (event.kind == Kind::cursor || button >= is_button_down_.size()) continue;
    is_button_down_[button] = event.kind == Kind::button_press;
  }
  std::ranges::copy(is_button_down_, io.MouseDown);
}

void Gui::begin_frame(std::span<const InputEvent> input) {
  follow_scale();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  follow_mouse(input);
  ImGui::NewFrame();
}

tracer::Tile Gui::framebuffer_tile(const tracer::Vec2d& min, const tracer::Vec2d& max) const {
  const tracer::Vec2i first(round(min * pixel_ratio_));
  const tracer::Vec2i end(round(max * pixel_ratio_));
  return {first.x, first.y, end.x, end.y};
}

// A scissored clear: many times as fast as a rectangle where OpenGL runs on the processor.
void Gui::fill(const tracer::Vec2d& min, const tracer::Vec2d& max, const ImVec4& color) {
  const tracer::Tile tile = framebuffer_tile(min, max);
  glEnable(GL_SCISSOR_TEST);
  glScissor(tile.x0, window_.framebuffer_px().y - tile.y1, tile.width(), tile.height());
  glClearColor(color.x, color.y, color.z, color.w);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

void Gui::render() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace app
