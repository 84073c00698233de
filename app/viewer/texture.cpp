// SPDX-License-Identifier: MIT
#include "app/viewer/texture.h"

#include <GL/gl.h>

namespace app {

Texture::Texture() {
  glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture::~Texture() {
  glDeleteTextures(1, &name_);
}

void Texture::upload(std::span<const tracer::Rgba8> picture, tracer::Vec2i size_px,
                     const tracer::Tile& area) {
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, size_px.x);
  if (size_px_ != size_px) {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_px.x, size_px.y, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 picture.data());
    size_px_ = size_px;
  } else {
    const size_t first = static_cast<size_t>(area.y0) * size_px.x + area.x0;
    glTexSubImage2D(GL_TEXTURE_2D, 0, area.x0, area.y0, area.width(), area.height(), GL_RGBA,
                    GL_UNSIGNED_BYTE, &picture[first]);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

}  // namespace app
