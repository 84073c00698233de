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
  bool skips = true;  // what the scene does not need: the same picture, sooner
  double sky_strength = 1;
  double sky_rotation = 0;  // of the environment about its zenith, in degrees
  double clamp = 0;         // of indirect samples; 0: off, and the picture is unbiased
  double exposure = 0;      // stops: radiance is multiplied by 2^exposure before it is shown
};

template <class Settings, class F>
requires std::same_as<std::remove_const_t<Settings>, RenderSettings>
void for_each_field(Settings& settings, F&& f) {
  f(settings.bounces,
    Field<int>{"bounces", 0, 64, "scatterings of a path at most", Effect::restart});
  f(settings.seed, Field<int>{"seed", 0, 0x7fffffff, "picks the random numbers", Effect::restart});
  f(settings.sky_strength,
    Field<double>{"sky-strength", 0, 100, "times the light of the sky", Effect::restart});
  f(settings.sky_rotation,
    Field<double>{"sky-rotation", -360, 360, "turns the environment map", Effect::restart, " deg"});
  f(settings.clamp,
    Field<double>{"clamp", 0, 1000,
                  "cuts what light scattered twice or more adds to a sample: less noise, too dark; "
                  "0: off",
                  Effect::restart});
  f(settings.exposure, Field<double>{"exposure", -20, 20, "stops of light added to the picture",
                                     Effect::develop, " EV"});
}

}  // namespace tracer
