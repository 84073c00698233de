// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "tracer/base/fields.h"

namespace tracer {

struct RenderSettings {
  int bounces = 8;  // scatterings of a path at most
  int seed = 0;
  bool skips = true;    // what the scene does not need: the same picture, sooner
  double exposure = 0;  // stops: radiance is multiplied by 2^exposure before it is shown
};

template <class Settings, class F>
requires std::same_as<std::remove_const_t<Settings>, RenderSettings>
void for_each_field(Settings& settings, F&& f) {
  f(settings.bounces,
    Field<int>{"bounces", 0, 64, "scatterings of a path at most", Effect::restart});
  f(settings.seed, Field<int>{"seed", 0, 0x7fffffff, "picks the random numbers", Effect::restart});
  f(settings.exposure, Field<double>{"exposure", -20, 20, "stops of light added to the picture",
                                     Effect::develop, " EV"});
}

}  // namespace tracer
