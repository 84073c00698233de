// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace bench {

/// The mouse of the display that DISPLAY names, moved by the XTest extension: events as a real one
/// sends them.
class Mouse {
 public:
  /// Throws std::runtime_error where there is no such display, or no XTest in this build.
  Mouse();
  ~Mouse();

  /// Each returns when the server has the event.
  void move_to(int x, int y);
  void press();
  void release();

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace bench
