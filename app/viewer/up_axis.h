// SPDX-License-Identifier: MIT
#pragma once

namespace app {

/// Which axis of the world is up; automatic: as the view file or else guess_up() says.
enum class UpAxis { automatic, y, z };

}  // namespace app
