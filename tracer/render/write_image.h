// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "tracer/render/film.h"
#include "tracer/render/image_layer.h"

namespace tracer {

/// Writes .png (8-bit sRGB, developed with `exposure`), .exr or .pfm (linear radiance, float). The
/// file appears whole or not at all. `metadata` goes into PNG and EXR, `layers` into EXR alone.
/// Throws LoadError.
void write_image(const std::filesystem::path& path, const Image& image, double exposure,
                 const std::map<std::string, std::string>& metadata = {},
                 std::span<const ImageLayer> layers = {});

/// Whether write_image knows the extension.
bool is_writable_image(const std::filesystem::path& path);
/// Whether its format holds layers.
bool can_hold_layers(const std::filesystem::path& path);

}  // namespace tracer
