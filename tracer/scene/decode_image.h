// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "tracer/scene/texture.h"

namespace tracer {

/// Whether the bytes begin as a picture of linear radiance does: Radiance's .hdr or OpenEXR.
bool is_radiance_image(std::string_view bytes);

/// The finest texels of an encoded image, as they are in the file: floats may be infinite or NaN.
/// `encoding` is that of 8-bit images. Throws std::runtime_error, in words for the user.
Texture decode_image(std::string_view bytes, TexelEncoding encoding);

}  // namespace tracer
