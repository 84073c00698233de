// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tracer {

/// Whether no Huffman table of a JPEG has more than the 256 codes that it may have [ITU-T T.81]:
/// stb_image writes beyond its arrays where one has. True of what is no JPEG. What follows the
/// first scan's header is searched whole, as only decoding would tell where scans end.
bool has_sound_huffman_tables(std::string_view bytes);

}  // namespace tracer
