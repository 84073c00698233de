// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/obj/parse_mtl.h"
#include "tracer/scene/material.h"

namespace tracer {

/// What a library's material is to the renderer, but for its textures; docs/materials.md has the
/// rules. Every value is in the range that Principled and Material name.
Material map_material(const MtlMaterial& material);

/// What a map looks up, without its texture.
MaterialMap map_lookup(const MtlMap& map, MapSlot slot);

}  // namespace tracer
