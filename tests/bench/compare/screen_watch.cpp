// SPDX-License-Identifier: MIT
#include "tests/bench/compare/screen_watch.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "app/stopwatch.h"

namespace bench {
namespace {

constexpr int most_rows_a_look = 120;
constexpr auto pause_between_looks = std::chrono::microseconds(400);

}  // namespace

ScreenWatch::ScreenWatch(const tests::VirtualDisplay& display) {
  const int file = open(display.pixel_file().c_str(), O_RDONLY);
  if (file < 0) throw std::runtime_error("the display's pixels cannot be read");
  size_bytes_ = std::filesystem::file_size(display.pixel_file());
  void* mapped = mmap(nullptr, size_bytes_, PROT_READ, MAP_SHARED, file, 0);
  close(file);
  if (mapped == MAP_FAILED) throw std::runtime_error("the display's pixels cannot be mapped");
  bytes_ = static_cast<const char*>(mapped);
  format_ = tests::parse_screen_format(bytes_);
}

ScreenWatch::~ScreenWatch() {
  munmap(const_cast<char*>(bytes_), size_bytes_);
}

uint64_t ScreenWatch::fingerprint(const tests::Rectangle& area) const {
  uint64_t hash = 0;
  const int width = std::min(area.x1, format_.width) - area.x0;
  const int height = std::min(area.y1, format_.height) - area.y0;
  const int row_step = height / most_rows_a_look + 1;
  for (int y = area.y0; y < area.y0 + height; y += row_step) {
    const char* row = bytes_ + format_.pixels_offset_bytes +
                      static_cast<size_t>(y) * format_.row_bytes + 4 * static_cast<size_t>(area.x0);
    for (int x = 0; x + 2 <= width; x += 2) {
      uint64_t two_pixels = 0;
      std::memcpy(&two_pixels, row + 4 * static_cast<size_t>(x), sizeof two_pixels);
      hash = (hash ^ two_pixels) * 0x9e3779b97f4a7c15u;
    }
  }
  return hash;
}

double ScreenWatch::part_of_commonest_color(const tests::Rectangle& area) const {
  std::vector<uint32_t> colors;
  for (int y = area.y0; y < std::min(area.y1, format_.height); y += 4) {
    const char* row = bytes_ + format_.pixels_offset_bytes + y * format_.row_bytes;
    for (int x = area.x0; x < std::min(area.x1, format_.width); x += 4) {
      std::memcpy(&colors.emplace_back(), row + 4 * static_cast<size_t>(x), sizeof(uint32_t));
    }
  }
  std::ranges::sort(colors);
  std::ptrdiff_t most = 0;
  for (auto at = colors.begin(); at != colors.end();) {
    const auto end = std::upper_bound(at, colors.end(), *at);
    most = std::max(most, end - at);
    at = end;
  }
  return static_cast<double>(most) / static_cast<double>(colors.size());
}

std::optional<double> ScreenWatch::seconds_to_change(const tests::Rectangle& area, uint64_t before,
                                                     double timeout_seconds) const {
  const app::Stopwatch stopwatch;
  while (fingerprint(area) == before) {
    if (stopwatch.seconds() > timeout_seconds) return std::nullopt;
    std::this_thread::sleep_for(pause_between_looks);
  }
  return stopwatch.seconds();
}

bool ScreenWatch::wait_until_still(const tests::Rectangle& area, double still_seconds,
                                   double timeout_seconds) const {
  const app::Stopwatch stopwatch;
  while (stopwatch.seconds() < timeout_seconds) {
    if (!seconds_to_change(area, fingerprint(area), still_seconds)) return true;
  }
  return false;
}

}  // namespace bench
