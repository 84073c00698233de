// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tracer {

/// Whether a PNM (P5, P6) has 8-bit samples and a size that an int holds: stb_image reads beyond
/// its arrays where samples have 16 bits. True of what is no such file.
bool has_sound_pnm_header(std::string_view bytes);

}  // namespace tracer
