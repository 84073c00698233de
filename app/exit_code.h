// SPDX-License-Identifier: MIT
#pragma once

/// What the program returns, as `boxwood --help` says.
namespace app::exit_code {

inline constexpr int success = 0;
inline constexpr int failure = 1;    // of the program or the machine, not of what it was given
inline constexpr int bad_input = 2;  // options or files
inline constexpr int no_display = 3;
inline constexpr int interrupted = 130;  // by Ctrl-C, as shells have it

}  // namespace app::exit_code
