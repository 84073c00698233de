// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "app/viewer/panels/rows.h"

namespace app {

/// Draws a bar for each count, `width` wide in all, and reports its place as `name`. Hovered, it
/// says `describe(place)` of the bar below the mouse, and `help`.
void histogram(const Ui& ui, const std::string& name, float width, std::span<const uint32_t> counts,
               const std::string& help, const std::function<std::string(size_t)>& describe);

}  // namespace app
