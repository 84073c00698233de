// SPDX-License-Identifier: MIT
#include "app/viewer/window.h"

#include <algorithm>
#include <utility>

#include <GLFW/glfw3.h>

namespace app {
namespace {

std::string last_error() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description != nullptr ? description : "unknown error";
}

/// The monitor that the window's center lies on.
GLFWmonitor* monitor_of(GLFWwindow* window) {
  tracer::Vec2i position{0, 0}, size{0, 0};
  glfwGetWindowPos(window, &position.x, &position.y);
  glfwGetWindowSize(window, &size.x, &size.y);
  const tracer::Vec2i center = position + size / 2;
  int monitor_count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&monitor_count);
  for (int i = 0; i < monitor_count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    tracer::Vec2i corner{0, 0};
    glfwGetMonitorPos(monitors[i], &corner.x, &corner.y);
    const tracer::Vec2i offset = center - corner;
    const bool is_inside =
        offset.x >= 0 && offset.y >= 0 && offset.x < mode->width && offset.y < mode->height;
    if (is_inside) return monitors[i];
  }
  return glfwGetPrimaryMonitor();
}

}  // namespace

Window::Window(const std::string& title, tracer::Vec2i size) {
  if (!glfwInit()) throw WindowError("no display to open a window on (" + last_error() + ")");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = last_error();
    glfwTerminate();
    throw WindowError("the display offers no OpenGL 3 window (" + reason + ")");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  install_callbacks();
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

Window& Window::of(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void Window::add(InputEvent event) {
  is_active_ = true;
  event.cursor = cursor_;
  input_.push_back(event);
}

void Window::install_callbacks() {
  using Kind = InputEvent::Kind;
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
    of(window).is_active_ = true;
    if (action == GLFW_PRESS) of(window).add({Kind::key_press, key, modifiers, {}, {}});
  });
  glfwSetMouseButtonCallback(
      window_, [](GLFWwindow* window, int button, int action, int modifiers) {
        const Kind kind = action == GLFW_PRESS ? Kind::button_press : Kind::button_release;
        of(window).add({kind, button, modifiers, {}, {}});
      });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    of(window).cursor_ = {x, y};
    of(window).add({Kind::cursor, 0, 0, {}, {}});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
    of(window).add({Kind::scroll, 0, 0, {}, {x, y}});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int path_count, const char** paths) {
    of(window).is_active_ = true;
    for (int i = 0; i < path_count; ++i) of(window).drops_.emplace_back(paths[i]);
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned) { of(window).is_active_ = true; });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { of(window).is_active_ = true; });
  glfwSetWindowFocusCallback(window_,
                             [](GLFWwindow* window, int) { of(window).is_active_ = true; });
  glfwSetCursorEnterCallback(window_,
                             [](GLFWwindow* window, int) { of(window).is_active_ = true; });
  glfwSetFramebufferSizeCallback(
      window_, [](GLFWwindow* window, int, int) { of(window).is_active_ = true; });
  glfwSetWindowContentScaleCallback(
      window_, [](GLFWwindow* window, float, float) { of(window).is_active_ = true; });
}

bool Window::should_close() const {
  return glfwWindowShouldClose(window_);
}

tracer::Vec2i Window::framebuffer_px() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return {0, 0};
  tracer::Vec2i size{0, 0};
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

tracer::Vec2i Window::size() const {
  tracer::Vec2i size{0, 0};
  glfwGetWindowSize(window_, &size.x, &size.y);
  return size;
}

double Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(std::max(x, y), 0.5f, 8.0f);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::toggle_full_screen() {
  if (glfwGetWindowMonitor(window_) != nullptr) {
    glfwSetWindowMonitor(window_, nullptr, windowed_position_.x, windowed_position_.y,
                         windowed_size_.x, windowed_size_.y, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = monitor_of(window_);
  if (monitor == nullptr) return;
  glfwGetWindowPos(window_, &windowed_position_.x, &windowed_position_.y);
  windowed_size_ = size();
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::hide() {
  glfwHideWindow(window_);
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

void Window::wait_events() {
  glfwWaitEvents();
}

void Window::wait_events(double timeout_seconds) {
  glfwWaitEventsTimeout(timeout_seconds);
}

void Window::poll_events() {
  glfwPollEvents();
}

void Window::wake() {
  glfwPostEmptyEvent();
}

bool Window::take_activity() {
  return std::exchange(is_active_, false);
}

std::vector<InputEvent> Window::take_input() {
  const auto is_button = [](const InputEvent& event) {
    return event.kind == InputEvent::Kind::button_press ||
           event.kind == InputEvent::Kind::button_release;
  };
  auto end = std::ranges::find_if(input_, is_button);
  if (end != input_.end()) ++end;
  std::vector<InputEvent> taken(input_.begin(), end);
  input_.erase(input_.begin(), end);
  if (!input_.empty()) is_active_ = true;
  return taken;
}

std::vector<std::filesystem::path> Window::take_drops() {
  return std::exchange(drops_, {});
}

}  // namespace app
