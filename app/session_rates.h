// SPDX-License-Identifier: MIT
// How fast one picture is traced.
#pragma once

#include <cstdint>
#include <deque>

namespace app {

enum class TraceMode { bvh, brute_force };

/// Rays and seconds of one picture, a stretch of tracing at a time.
class TraceRates {
 public:
  /// `end_seconds` on any clock that only grows.
  void add(TraceMode mode, uint64_t rays, double seconds, double end_seconds);

  uint64_t rays() const { return bvh_.rays + brute_force_.rays; }
  double seconds() const { return bvh_.seconds + brute_force_.seconds; }
  /// For a change of mode: recent_mrays_per_second() is 0 until more is traced.
  void forget_recent() { recent_.clear(); }
  /// Over the last second of tracing; since the mode changed, when that is less.
  double recent_mrays_per_second() const;
  /// Over all rays of this picture that were traced in this mode; 0 when there were none.
  double mrays_per_second(TraceMode mode) const;

 private:
  struct Total {
    uint64_t rays = 0;
    double seconds = 0;
  };
  struct Stretch {
    Total total;
    double end_seconds;
  };

  Total bvh_;
  Total brute_force_;
  std::deque<Stretch> recent_;
};

}  // namespace app
