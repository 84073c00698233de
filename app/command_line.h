// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace app {

/// Does what `arguments` (without the program's name) ask for; returns the exit code. What goes
/// wrong is said in one line on stderr.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace app
