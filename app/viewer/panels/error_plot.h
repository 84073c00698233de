// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "app/session_renderer.h"
#include "app/viewer/panels/rows.h"

namespace app {

/// Draws the error against the time it took, both logarithmic, with a line at `error_limit` unless
/// that is 0, and reports its place as `name`. Hovered, it says what was known at the time below
/// the mouse.
void error_plot(const Ui& ui, const std::string& name, std::span<const ErrorPoint> points,
                double error_limit);

}  // namespace app
