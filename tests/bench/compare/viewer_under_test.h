// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/run_program.h"
#include "tests/support/widget_layout.h"

namespace bench {

/// The real program in a window of 1280x720 at the display's upper left corner, for as long as this
/// object lives.
class ViewerUnderTest {
 public:
  explicit ViewerUnderTest(const std::filesystem::path& model);

  /// Where a widget is, once it is there. Throws std::runtime_error after two minutes.
  tests::Rectangle widget(const std::string& name) const;

 private:
  std::filesystem::path layout_file_;
  tests::ChildProgram program_;
};

}  // namespace bench
