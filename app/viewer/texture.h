// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tracer/render/develop.h"
#include "tracer/render/film.h"

namespace app {

/// An OpenGL texture of 8-bit pixels, shown pixel for pixel. Lives in the context that is current
/// when it is made.
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

  unsigned name() const { return name_; }

 private:
  unsigned name_ = 0;
  tracer::Vec2i size_px_{0, 0};
};

}  // namespace app
