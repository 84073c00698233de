// SPDX-License-Identifier: MIT
// The program's commands: each reads its arguments, does its work and returns the exit code. They
// throw OptionError and LoadError.
#pragma once

#include <string>
#include <vector>

namespace app {

int run_view(const std::vector<std::string>& arguments);
int run_render(const std::vector<std::string>& arguments);
int run_info(const std::vector<std::string>& arguments);

}  // namespace app
