// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "tracer/base/error.h"
#include "tracer/base/file_bytes.h"
#include "tracer/scene/decode_image.h"
#include "tracer/scene/texture.h"

namespace tracer {

Texture load_texture(const std::filesystem::path& path, TexelEncoding encoding) {
  const FileBytes file(path);
  try {
    Texture texture = decode_image(file.bytes(), encoding);
    for (float& value : texture.values) {
      if (!std::isfinite(value)) value = 0;
    }
    add_levels(texture);
    return texture;
  } catch (const std::runtime_error& error) {
    throw LoadError({path.string(), 0, error.what()});
  }
}

}  // namespace tracer
