// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "assets/outline.h"

namespace assets {

/// Collapses edges until at most `triangle_count` triangles are left or none can be collapsed, the
/// least change of shape first, times `importance` squared where it happens. A closed manifold
/// stays one, outlines between materials stay where they are. Equal input gives equal bits.
/// [Garland 1997]
PaintedSurface simplify(const PaintedSurface& surface, size_t triangle_count,
                        const Field& importance);

}  // namespace assets
