// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tracer {

/// Whether the run-length encoded rows of a Radiance HDR are whole and have no run of no texels:
/// stb_image never returns from one. True of what is no such file.
bool has_sound_hdr_runs(std::string_view bytes);

}  // namespace tracer
