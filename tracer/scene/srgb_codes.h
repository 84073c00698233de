// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tracer/scene/texture.h"

namespace tracer {

/// The value of each 8-bit code; of sRGB by the curve of [IEC 61966-2-1], with the same bits on
/// every machine.
const std::array<float, 256>& decode_table(TexelEncoding encoding);

/// The code whose value is nearest; `value` is in [0, 1].
uint8_t encode(TexelEncoding encoding, float value);

}  // namespace tracer
