// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace tracer {

/// Adds what a comment of ZBrush's says of vertices' colours: "#MRGB " and eight hexadecimal digits
/// a vertex, 0xMMRRGGBB. Other comments, and what is no such digit, say nothing.
void read_paint(std::string_view comment, std::vector<uint32_t>& painted);

}  // namespace tracer
