// SPDX-License-Identifier: MIT
#include "tracer/base/trigonometry.h"

#include "tracer/base/trigonometry-inl.h"

namespace tracer {

CosSin cos_sin_of_turns(double turns) {
  const auto [cos, sin] = HWY_NAMESPACE::cos_sin_of_turns(turns);
  return {cos, sin};
}

}  // namespace tracer
