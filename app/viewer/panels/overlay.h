// SPDX-License-Identifier: MIT
// Small windows that float over the picture.
#pragma once

#include <string>

#include "app/session.h"
#include "app/viewer/camera_controls.h"
#include "app/viewer/panels/rows.h"

namespace app {

enum class OverlayAnswer { none, cancel, dismiss };

/// What a load or a build is at, with a button that cancels it.
OverlayAnswer draw_progress(const Ui& ui, const PictureArea& area, const Status& status);
/// Why the last load showed nothing, with a button that dismisses it.
OverlayAnswer draw_error(const Ui& ui, const PictureArea& area, const std::string& error);
/// What the load had to leave out or guess, line by line, with a button that dismisses it.
OverlayAnswer draw_warnings(const Ui& ui, const PictureArea& area,
                            const tracer::ImportedScene& model);
/// A line that soon goes away again.
void draw_toast(const Ui& ui, const PictureArea& area, const std::string& text);
/// What to do while there is no model.
void draw_welcome(const Ui& ui, const PictureArea& area);
/// All keys and gestures.
OverlayAnswer draw_cheat_sheet(const Ui& ui, const PictureArea& area);

/// "12 warnings, 3 faces left out".
std::string summarize(const tracer::ImportedScene& model);

}  // namespace app
