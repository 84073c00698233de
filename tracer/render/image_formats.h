// SPDX-License-Identifier: MIT
// Images as the bytes of a file, for write_image.
#pragma once

#include <map>
#include <span>
#include <string>

#include "tracer/render/film.h"
#include "tracer/render/image_layer.h"

namespace tracer {

using Metadata = std::map<std::string, std::string>;

/// 8-bit sRGB, developed with `exposure`; metadata as UTF-8 text chunks.
std::string encode_png(const Image& image, double exposure, const Metadata& metadata);
/// Linear 32-bit float R, G, B, ZIP compressed; metadata as string attributes. Channels of layers
/// are named LAYER.CHANNEL; values are 32-bit floats or whole numbers.
std::string encode_exr(const Image& image, const Metadata& metadata,
                       std::span<const ImageLayer> layers);
/// Linear 32-bit little-endian float, rows from the bottom up; holds no metadata. `exposure` is not
/// applied.
std::string encode_pfm(const Image& image, double exposure, const Metadata& metadata);

}  // namespace tracer
