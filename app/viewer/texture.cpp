// SPDX-License-Identifier: MIT
#include "app/viewer/texture.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

namespace app {

Texture::Texture() {
  glGenTextures(1, &name_);
  glGenFramebuffers(1, &framebuffer_);
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture::~Texture() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &name_);
}

void Texture::upload(std::span<const tracer::Rgba8> picture, tracer::Vec2i size_px,
                     const tracer::Tile& area) {
  glBindTexture(GL_TEXTURE_2D, name_);
  tracer::Tile changed = area;
  if (size_px_ != size_px) {
    // No size is asked of the channels, and their order is the screen's: pixels of one format are
    // copied, where OpenGL runs on the processor, rather than drawn.
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size_px.x, size_px.y, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                 nullptr);
    size_px_ = size_px;
    changed = {0, 0, size_px.x, size_px.y};
  }
  const size_t first = static_cast<size_t>(changed.y0) * size_px.x + changed.x0;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, size_px.x);
  glTexSubImage2D(GL_TEXTURE_2D, 0, changed.x0, changed.y0, changed.width(), changed.height(),
                  GL_RGBA, GL_UNSIGNED_BYTE, &picture[first]);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::show(const tracer::Tile& tile, int framebuffer_height_px) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, name_, 0);
  glBlitFramebuffer(0, 0, size_px_.x, size_px_.y, tile.x0, framebuffer_height_px - tile.y0, tile.x1,
                    framebuffer_height_px - tile.y1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace app
