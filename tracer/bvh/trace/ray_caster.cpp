// SPDX-License-Identifier: MIT
// Many rays at once: which kernel suits which of them.
#include <algorithm>
#include <bit>
#include <cassert>

#include "tracer/bvh/trace/accel.h"
#include "tracer/bvh/trace/bundle_kernels.h"

namespace tracer {
namespace {

// Fewer rays are done sooner one by one.
constexpr size_t least_bundle = 8;
constexpr size_t rays_under_way = bundles_under_way * bundle_size;
// A bundle that meets more leaves than that is slower than a stream; where streams don't pay, it
// has time. Measured.
constexpr size_t leaves_a_ray_before_stream = 2, leaves_a_ray_before_single = 32;
// In a row, after which one of 16 groups of bundles is tried.
constexpr unsigned most_failures = 4;

// Fewer rays are done sooner one by one, and so are those that meet hundreds of nodes and blocks:
// most blocks hold nothing for them, and a ray alone leaves those early. Measured.
constexpr size_t least_stream = 8;
constexpr float most_steps_in_stream = 100;
// With fewer lanes a step does less, and a stream's bookkeeping remains: bounces one by one are 1.3
// to 1.4 times as fast. Measured.
constexpr int least_width_of_stream = 16;

bool streams_pay(const WideTree& tree) {
  return tree.width >= least_width_of_stream && tree.expected_steps < most_steps_in_stream;
}

size_t rays_for_bundles(size_t ray_count) {
  const size_t rest = ray_count % bundle_size;
  return rest < least_bundle ? ray_count - rest : ray_count;
}

/// What answers many rays of one query.
template <class Answer>
struct Kernels {
  BundleVerdicts (*bundles)(const WideTree& tree, std::span<const Ray> rays, size_t leaves_a_ray,
                            const StopFlag& stop, std::span<Answer> answers);
  size_t (*stream)(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                   std::span<Answer> answers);
  size_t leaves_a_ray;  // of a bundle, before it is given up
};

// Calls trace_alone(ray, answer) for what the stream leaves. Returns how many the stream answered.
template <class Answer, class TraceAlone>
size_t trace_without_bundles(const WideTree* tree, std::span<const Ray> rays, const StopFlag& stop,
                             std::span<Answer> answers, const Kernels<Answer>& kernels,
                             const TraceAlone& trace_alone) {
  const bool pays = tree && streams_pay(*tree);
  size_t first = 0, streamed = 0;
  while (first < rays.size()) {
    if (pays && rays.size() - first >= least_stream) {
      const size_t done = kernels.stream(*tree, rays.subspan(first), stop, answers.subspan(first));
      streamed += done;
      first += done;
    }
    if (first < rays.size()) {
      trace_alone(rays[first], answers[first]);
      ++first;
    }
  }
  return streamed;
}

// Bundles first. Returns how many rays were answered by kernels, not by trace_alone.
template <class Answer, class TraceAlone>
size_t trace_many(const WideTree* tree, std::span<const Ray> rays, const StopFlag& stop,
                  std::span<Answer> answers, const Kernels<Answer>& kernels, BundleTries& tries,
                  const TraceAlone& trace_alone) {
  size_t answered = 0;
  size_t rest = 0;  // from here on rays are unanswered
  const auto trace_rest = [&](size_t end) {
    answered += trace_without_bundles(tree, rays.subspan(rest, end - rest), stop,
                                      answers.subspan(rest, end - rest), kernels, trace_alone);
    rest = end;
  };
  const size_t last = tree ? rays_for_bundles(rays.size()) : 0;
  for (size_t first = 0; first < last; first += rays_under_way) {
    if (stop.requested() || tries.skips_next()) continue;
    const size_t count = std::min(rays_under_way, last - first);
    const BundleVerdicts verdicts = kernels.bundles(
        *tree, rays.subspan(first), kernels.leaves_a_ray, stop, answers.subspan(first, count));
    tries.note(std::popcount(verdicts.answered), std::popcount(verdicts.given_up));
    for (uint32_t bits = verdicts.answered; bits != 0; bits &= bits - 1) {
      trace_rest(first + static_cast<size_t>(std::countr_zero(bits)) * bundle_size);
      const size_t end = std::min(rest + bundle_size, last);
      answered += end - rest;
      rest = end;
    }
  }
  trace_rest(rays.size());
  return answered;
}

}  // namespace

void BundleTries::note(int answered_count, int given_up_count) {
  if (answered_count + given_up_count == 0) return;
  failures_ = 3 * given_up_count > answered_count ? std::min(failures_ + 1, most_failures) : 0;
  to_skip_ = (1u << failures_) - 1;
}

void RayCaster::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) {
  assert(rays.size() == hits.size());
  const bool has_time = accel_.wide && !streams_pay(*accel_.wide);
  const Kernels<Hit> kernels{closest_hits_bundles, closest_hits_stream,
                             has_time ? leaves_a_ray_before_single : leaves_a_ray_before_stream};
  ray_count_ += trace_many(accel_.wide.get(), rays, stop_, hits, kernels, hit_tries_,
                           [this](const Ray& ray, Hit& hit) { hit = closest_hit(ray); });
}

void RayCaster::occluded(std::span<const Ray> rays, std::span<uint8_t> is_occluded) {
  assert(rays.size() == is_occluded.size());
  const Kernels<uint8_t> kernels{occluded_bundles, occluded_stream, leaves_a_ray_before_stream};
  ray_count_ +=
      trace_many(accel_.wide.get(), rays, stop_, is_occluded, kernels, occlusion_tries_,
                 [this](const Ray& ray, uint8_t& answer) { answer = occluded(ray) ? 1 : 0; });
}

}  // namespace tracer
