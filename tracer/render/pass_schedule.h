// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/render.h"

namespace tracer {

/// Which pass comes after which, and when something new can be told from the film.
class PassSchedule {
 public:
  explicit PassSchedule(const RenderSettings& settings) : allocation_(settings.allocation) {}

  const Pass& pass() const { return pass_; }
  /// When the pass is complete in the film: on to the next. Adaptive samples are allocated anew
  /// after 16 passes, 32, 64 and so on.
  void advance(Film& film);
  /// Whether the film's error is worth an estimate between the last pass and this one: after 8
  /// passes, and then eight times a doubling of their number.
  bool is_estimate_due() const;

 private:
  Allocation allocation_;
  Pass pass_ = first_pass;
};

}  // namespace tracer
