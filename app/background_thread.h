// SPDX-License-Identifier: MIT
#pragma once

namespace app {

/// From here on the calling thread, and the threads it starts, give way to the window's own where
/// there are fewer processors than threads. Does nothing where the system has no such notion.
void give_way_to_window();

}  // namespace app
