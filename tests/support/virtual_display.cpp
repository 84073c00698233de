// SPDX-License-Identifier: MIT
#include "tests/support/virtual_display.h"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tests {
namespace {

/// The 32-bit word at `index` of an XWD header, big-endian.
uint32_t header_word(const char* bytes, size_t index) {
  uint32_t word = 0;
  for (size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<uint8_t>(bytes[4 * index + i]);
  return word;
}

std::string read_line(int file) {
  std::string line;
  for (char letter = 0; read(file, &letter, 1) == 1 && letter != '\n';) line += letter;
  return line;
}

}  // namespace

std::string find_program(const std::string& name) {
  const char* search_path = std::getenv("PATH");
  std::istringstream folders(search_path != nullptr ? search_path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string path = folder + '/' + name;
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

// A header, a color map of 12-byte entries, rows of BGRX, X being 0.
ScreenFormat parse_screen_format(const char* bytes) {
  const size_t header_bytes = header_word(bytes, 0);
  const size_t color_count = header_word(bytes, 19);
  return {static_cast<int>(header_word(bytes, 4)), static_cast<int>(header_word(bytes, 5)),
          header_bytes + 12 * color_count, header_word(bytes, 12)};
}

VirtualDisplay::VirtualDisplay() {
  int number_pipe[2];
  if (pipe(number_pipe) != 0) return;
  pid_ = fork();
  if (pid_ == 0) {
    const int silence = open("/dev/null", O_RDWR);
    dup2(silence, STDOUT_FILENO);
    dup2(silence, STDERR_FILENO);
    const std::string pipe_end = std::to_string(number_pipe[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", pipe_end.c_str(), "-screen", "0", "1280x800x24", "-fbdir",
           folder_.path().c_str(), "-nocursor", "-nolisten", "tcp", nullptr);
    _exit(127);
  }
  close(number_pipe[1]);
  const std::string number = read_line(number_pipe[0]);
  close(number_pipe[0]);
  if (number.empty()) return;
  name_ = ':' + number;
  setenv("DISPLAY", name_.c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("LP_NUM_THREADS", "0", 1);
  unsetenv("WAYLAND_DISPLAY");
}

VirtualDisplay::~VirtualDisplay() {
  if (pid_ <= 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

Screen VirtualDisplay::capture() const {
  const std::string bytes = read_file(pixel_file());
  const ScreenFormat format = parse_screen_format(bytes.data());
  Screen screen{format.width, format.height, {}};
  screen.pixels.resize(static_cast<size_t>(screen.width) * screen.height);
  for (int y = 0; y < screen.height; ++y) {
    std::memcpy(&screen.pixels[static_cast<size_t>(y) * screen.width],
                &bytes[format.pixels_offset_bytes + y * format.row_bytes],
                screen.width * sizeof(uint32_t));
  }
  return screen;
}

}  // namespace tests
