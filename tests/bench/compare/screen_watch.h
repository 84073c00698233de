// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tests/support/virtual_display.h"
#include "tests/support/widget_layout.h"

namespace bench {

/// Watches the pixels of a virtual display as they change, at little cost: the server's memory is
/// shared, and of large areas only some rows are looked at.
class ScreenWatch {
 public:
  /// Throws std::runtime_error.
  explicit ScreenWatch(const tests::VirtualDisplay& display);
  ~ScreenWatch();
  ScreenWatch(const ScreenWatch&) = delete;
  ScreenWatch& operator=(const ScreenWatch&) = delete;

  /// Differs where the area's pixels do.
  uint64_t fingerprint(const tests::Rectangle& area) const;
  /// The part of the area's pixels that have the color most of them have; of every fourth pixel of
  /// every fourth row.
  double part_of_commonest_color(const tests::Rectangle& area) const;
  /// Seconds until the fingerprint is no longer `before`, looked at twice a millisecond; nothing
  /// after `timeout_seconds`.
  std::optional<double> seconds_to_change(const tests::Rectangle& area, uint64_t before,
                                          double timeout_seconds) const;
  /// Waits until the area has not changed for so long; false after `timeout_seconds`.
  bool wait_until_still(const tests::Rectangle& area, double still_seconds,
                        double timeout_seconds) const;

 private:
  const char* bytes_ = nullptr;
  size_t size_bytes_ = 0;
  tests::ScreenFormat format_;
};

}  // namespace bench
