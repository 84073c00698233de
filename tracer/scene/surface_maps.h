// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/scene/scene.h"

namespace tracer {

/// Replaces what the textures of `material` decide in `surface`, which holds the material's own
/// values and its normals. Where a corner has no texture coordinates, they stay. Numbers and base
/// colours stay in [0, 1], whatever a texture holds.
void apply_maps(const Scene& scene, const Material& material, const Hit& hit,
                const Triangle& triangle, double footprint, Surface& surface);

}  // namespace tracer
