// SPDX-License-Identifier: MIT
#include "tracer/render/sampler.h"

namespace tracer {

std::span<const Choice<SamplerKind>> samplers() {
  static constexpr Choice<SamplerKind> table[] = {
      {SamplerKind::sobol, "sobol", "Sobol, blue noise",
       "Samples keep apart, within a pixel and between neighbours: the least noise at any time."},
      {SamplerKind::independent, "independent", "Independent",
       "Every sample by itself, for comparison."},
  };
  return table;
}

}  // namespace tracer
