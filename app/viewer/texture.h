// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tracer/render/develop.h"
#include "tracer/render/film.h"

namespace app {

/// An OpenGL texture of 8-bit pixels that is copied to the screen. Lives in the context that is
/// current when it is made.
class Texture {
 public:
  Texture();
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  /// Pixels of `area` from a picture of `size_px`, rows of size_px.x; another size than before
  /// takes the whole picture.
  void upload(std::span<const tracer::Rgba8> picture, tracer::Vec2i size_px,
              const tracer::Tile& area);

  /// Copies the picture to `tile` of the window's framebuffer, whose rows from the top
  /// `framebuffer_height_px` counts; stretched where sizes differ. Not before an upload.
  void show(const tracer::Tile& tile, int framebuffer_height_px) const;

 private:
  unsigned name_ = 0;
  unsigned framebuffer_ = 0;  // that the texture is read through
  tracer::Vec2i size_px_{0, 0};
};

}  // namespace app
