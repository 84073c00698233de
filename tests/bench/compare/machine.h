// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace bench {

/// The processor and the instruction set that the kernels take, the day, what else is compared.
std::string machine_line();

}  // namespace bench
