// SPDX-License-Identifier: MIT
// Images as the bytes of a file, for write_image.
#pragma once

#include <map>
#include <string>

#include "tracer/render/film.h"

namespace tracer {

using Metadata = std::map<std::string, std::string>;

/// 8-bit sRGB, developed with `exposure`; metadata as UTF-8 text chunks.
std::string encode_png(const Image& image, double exposure, const Metadata& metadata);
/// Linear 32-bit float R, G, B, ZIP compressed; metadata as string attributes. `exposure` is not
/// applied.
std::string encode_exr(const Image& image, double exposure, const Metadata& metadata);
/// Linear 32-bit little-endian float, rows from the bottom up; holds no metadata. `exposure` is not
/// applied.
std::string encode_pfm(const Image& image, double exposure, const Metadata& metadata);

}  // namespace tracer
