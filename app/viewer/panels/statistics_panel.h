// SPDX-License-Identifier: MIT
#pragma once

#include "app/session.h"
#include "app/viewer/panels/rows.h"

namespace app {

/// The part of the panel that says what was done. `error_limit` 0: none.
void draw_statistics(const Ui& ui, const Status& status, int sample_limit, double error_limit);

/// How many times as many rays a second the tree gives in this very view; 0 until both rates are
/// known.
double speed_up_of(const Status& status);

}  // namespace app
