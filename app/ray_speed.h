// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/bvh/trace/accel.h"

namespace app {

/// Closest hits a second, in millions, of lines uniform through the model's box (uniform_lines.h),
/// on all threads there are: the best of a few counts, a quarter of a second in all. 0 where the
/// model has no area.
double measure_mrays_per_second(const tracer::Accel& accel);

}  // namespace app
