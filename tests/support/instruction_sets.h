// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <hwy/targets.h>

namespace tracer {

/// Calls f(name) once for each instruction set that this processor has and the kernels are
/// compiled for, with the kernels forced to it.
template <class F>
void for_each_instruction_set(F&& f) {
  constexpr int64_t compiled[] = {HWY_AVX3, HWY_AVX2, HWY_SSE4};
  const int64_t supported = hwy::SupportedTargets();
  for (const int64_t target : compiled) {
    if ((supported & target) == 0) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    f(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace tracer
