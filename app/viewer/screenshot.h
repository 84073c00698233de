// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>

#include "tracer/render/film.h"

namespace app {

/// cow.obj -> FOLDER/cow-001.png, the first number that is free.
std::filesystem::path next_screenshot_path(const std::filesystem::path& folder,
                                           const std::filesystem::path& model);

/// Writes pictures to files on a thread of its own, one at a time.
class ScreenshotWriter {
 public:
  /// `wake` is called from that thread when a file is there or has failed.
  explicit ScreenshotWriter(std::function<void()> wake) : wake_(std::move(wake)) {}

  bool is_busy() const { return written_.valid(); }
  /// Not while busy.
  void write(const std::filesystem::path& path, tracer::Image image, double exposure);
  /// What became of the last one, in words for the user; once.
  std::optional<std::string> take_message();

 private:
  std::function<void()> wake_;
  std::future<std::string> written_;
};

/// The lower left `size_px` of the current OpenGL framebuffer, as linear radiance that develops to
/// its very bytes at exposure 0.
tracer::Image read_framebuffer(tracer::Vec2i size_px);

}  // namespace app
