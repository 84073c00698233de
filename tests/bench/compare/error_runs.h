// SPDX-License-Identifier: MIT
// Boxwood's pictures after more and more time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tests/bench/compare/error_scenes.h"
#include "tracer/render/film.h"
#include "tracer/render/render_settings.h"

namespace bench {

/// A way of rendering whose error is measured.
struct Variant {
  std::string_view name;
  std::string_view what;
  tracer::RenderSettings settings;
  const char* builder = nullptr;  // nullptr: the default one
};

/// The first is what a user gets unasked.
std::vector<Variant> variants();

/// A picture after so much time.
struct Snapshot {
  int rung = 0;        // of the ladder of times or samples that it was asked for
  double seconds = 0;  // of rendering alone
  double samples = 0;  // a pixel, on average
  tracer::Image image;
};

/// Renders once, on all processors, and keeps the picture at the end of the first pass after each
/// of `seconds`, which grow. Fewer pictures than times where a pass takes longer than from one to
/// the next.
std::vector<Snapshot> render_ladder(const ErrorScene& scene, const Variant& variant, int seed,
                                    std::span<const double> seconds);

/// A picture as nobody has the time for, as two halves whose samples have nothing in common.
struct Reference {
  tracer::Image first, second;
  double samples = 0;  // a pixel in each half
};

/// With integer seeds that no run above uses. Each half takes so many seconds.
Reference render_reference(const ErrorScene& scene, double seconds);

}  // namespace bench
