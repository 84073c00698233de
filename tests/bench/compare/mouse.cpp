// SPDX-License-Identifier: MIT
#include "tests/bench/compare/mouse.h"

#include <stdexcept>

#ifdef BOXWOOD_XTEST
#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>
#endif

namespace bench {

#ifdef BOXWOOD_XTEST

struct Mouse::Connection {
  Display* display = XOpenDisplay(nullptr);
  ~Connection() {
    if (display != nullptr) XCloseDisplay(display);
  }
};

Mouse::Mouse() : connection_(std::make_unique<Connection>()) {
  if (connection_->display == nullptr) throw std::runtime_error("the display cannot be opened");
}

void Mouse::move_to(int x, int y) {
  XTestFakeMotionEvent(connection_->display, -1, x, y, CurrentTime);
  XSync(connection_->display, False);
}

void Mouse::press() {
  XTestFakeButtonEvent(connection_->display, 1, True, CurrentTime);
  XSync(connection_->display, False);
}

void Mouse::release() {
  XTestFakeButtonEvent(connection_->display, 1, False, CurrentTime);
  XSync(connection_->display, False);
}

#else

struct Mouse::Connection {};

Mouse::Mouse() {
  throw std::runtime_error("built without XTest; install libxtst-dev and configure again");
}
void Mouse::move_to(int, int) {}
void Mouse::press() {}
void Mouse::release() {}

#endif

Mouse::~Mouse() = default;

}  // namespace bench
