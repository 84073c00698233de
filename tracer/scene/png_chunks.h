// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tracer {

/// Whether all chunks of a PNG [ISO 15948], up to IEND, are as long as they say: stb_image asks for
/// memory for all of a chunk before it looks for it, gigabytes for a file of some bytes. True of
/// what is no PNG.
bool has_sound_png_chunks(std::string_view bytes);

}  // namespace tracer
