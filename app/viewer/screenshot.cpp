// SPDX-License-Identifier: MIT
#include "app/viewer/screenshot.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include <GL/gl.h>
#include <fmt/format.h>

#include "tracer/render/write_image.h"

namespace app {
namespace {

/// Linear values of the 8-bit sRGB codes [IEC 61966-2-1].
std::array<float, 256> make_srgb_table() {
  std::array<float, 256> table{};
  for (size_t code = 0; code < table.size(); ++code) {
    const double encoded = static_cast<double>(code) / 255;
    table[code] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                        : std::pow((encoded + 0.055) / 1.055, 2.4));
  }
  return table;
}

}  // namespace

std::filesystem::path next_screenshot_path(const std::filesystem::path& folder,
                                           const std::filesystem::path& model) {
  const std::string stem = model.empty() ? "boxwood" : model.stem().string();
  for (int number = 1;; ++number) {
    auto path = folder / fmt::format("{}-{:03}.png", stem, number);
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return path;
  }
}

void ScreenshotWriter::write(const std::filesystem::path& path, tracer::Image image,
                             double exposure) {
  written_ = std::async(std::launch::async, [this, path, image = std::move(image), exposure] {
    std::string message = "Saved " + path.string();
    try {
      tracer::write_image(path, image, exposure);
    } catch (const std::exception& exception) {
      message = exception.what();
    }
    wake_();
    return message;
  });
}

std::optional<std::string> ScreenshotWriter::take_message() {
  if (!is_busy()) return std::nullopt;
  if (written_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return written_.get();
}

tracer::Image read_framebuffer(tracer::Vec2i size_px) {
  std::vector<uint8_t> bytes(static_cast<size_t>(size_px.x) * size_px.y * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_px.x, size_px.y, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  const auto linear_of = make_srgb_table();
  tracer::Image image{size_px, {}};
  image.pixels.reserve(static_cast<size_t>(size_px.x) * size_px.y);
  for (int y = size_px.y - 1; y >= 0; --y) {
    const uint8_t* row = &bytes[static_cast<size_t>(y) * size_px.x * 4];
    for (int x = 0; x < size_px.x; ++x, row += 4) {
      image.pixels.emplace_back(linear_of[row[0]], linear_of[row[1]], linear_of[row[2]]);
    }
  }
  return image;
}

}  // namespace app
