// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tracer/scene/environment.h"

namespace tracer {

/// Where the sun stands.
struct SunPosition {
  double elevation_degrees = 45;  // above the horizon, 0 to 90
  double azimuth_degrees = 0;     // from +x, counter-clockwise as seen from above

  friend bool operator==(const SunPosition&, const SunPosition&) = default;
};

/// A clear sky and the sun in it, by [Preetham 1999], over a ground of albedo 0.2. Radiance 1 is
/// 20,000 cd/m^2: a grey floor at noon is about 1. `turbidity` 2 is very clear air, 10 haze.
std::shared_ptr<const Environment> make_sun_sky(const SunPosition& position, double turbidity = 3);

}  // namespace tracer
