// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "tracer/scene/texture.h"

namespace tracer {

inline constexpr int64_t max_texels = int64_t{1} << 27;

bool is_exr(std::string_view bytes);

/// The finest texels of an OpenEXR picture: R, G, B or Y, and A where it has one; its data window.
/// Throws std::exception on what cannot be read.
Texture decode_exr(std::string_view bytes);

}  // namespace tracer
