// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <thread>

#include "tracer/base/progress.h"

namespace app {

/// One line of `columns` characters at most, without a line end: the stage, a bar, per cent, and,
/// once it can be told, the time left. `fraction` 0 to 1, `seconds` since the stage began.
std::string progress_line(std::string_view stage, double fraction, double seconds, int columns);

/// Shows `progress` on stderr for as long as it lives, and leaves no trace.
class ProgressBar {
 public:
  explicit ProgressBar(const tracer::Progress& progress);

  /// Whether anyone would see it.
  static bool is_visible();

 private:
  std::jthread drawing_;
};

}  // namespace app
