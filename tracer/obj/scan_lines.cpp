// SPDX-License-Identifier: MIT
#include "tracer/obj/scan_lines.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/obj/scan_lines.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/obj/plain_lines-inl.h"

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(ScanLines);
}  // namespace

LinePlace scan_lines(LinePlace from, const char* end, LineScan& scan) {
  return HWY_DYNAMIC_DISPATCH(ScanLines)(from, end, scan);
}

}  // namespace tracer
#endif
