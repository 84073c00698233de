// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace tracer {

/// While it lives, stb_image grows no block of this thread's memory beyond `most_bytes`, and fails
/// instead: a PNG of some megabytes may unpack to gigabytes, whatever size its header tells.
class StbGrowthLimit {
 public:
  explicit StbGrowthLimit(size_t most_bytes);
  ~StbGrowthLimit();
  StbGrowthLimit(const StbGrowthLimit&) = delete;
  StbGrowthLimit& operator=(const StbGrowthLimit&) = delete;

  bool is_reached() const;
};

}  // namespace tracer
