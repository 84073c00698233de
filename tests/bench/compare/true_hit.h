// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "tracer/geometry/ray.h"

namespace bench {

/// Where the ray meets the triangle at t >= 0, or nothing: the verdict is exact, t within 2^-38.
/// Extended precision decides where it can and long integers where it cannot; neither shares
/// anything with the kernels that are judged by it. All coordinates finite.
std::optional<long double> true_hit(const tracer::Ray& ray, const tracer::Vec3f& v0,
                                    const tracer::Vec3f& v1, const tracer::Vec3f& v2);

}  // namespace bench
