// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tracer {

/// Numbers of each pixel beside its colour, row 0 on top, the channels of a pixel side by side.
struct ImageLayer {
  std::string name;
  std::string channels;  // a letter each
  std::variant<std::vector<float>, std::vector<uint32_t>> values;
};

}  // namespace tracer
