// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "tests/support/run_program.h"

namespace tests {

/// Pixels of a screen, rows from the top.
struct Screen {
  int width = 0;
  int height = 0;
  std::vector<uint32_t> pixels;  // 0xRRGGBB

  uint32_t at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
};

/// Of the server's file, an XWD: where its rows of 4-byte pixels begin, and how far they are apart.
struct ScreenFormat {
  int width = 0;
  int height = 0;
  size_t pixels_offset_bytes = 0;
  size_t row_bytes = 0;
};
/// `bytes` holds the file's first 80 bytes at least.
ScreenFormat parse_screen_format(const char* bytes);

/// The path of a program of that name; empty when there is none.
std::string find_program(const std::string& name);

/// An X server without a screen or a visible cursor, 1280x800, for as long as this object lives.
/// Sets DISPLAY, and software OpenGL on one thread, in this process's environment.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  bool is_running() const { return !name_.empty(); }
  /// What is on the screen at this moment.
  Screen capture() const;
  /// The server's own pixels, as they change: an XWD file.
  std::filesystem::path pixel_file() const { return folder_.path() / "Xvfb_screen0"; }

 private:
  TemporaryFolder folder_;  // the server keeps its pixels there
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace tests
