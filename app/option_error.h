// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace app {

/// Options that cannot be obeyed, in words for the user.
struct OptionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
