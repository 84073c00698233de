// SPDX-License-Identifier: MIT
// Many rays at once: which kernel suits which of them.
#include <algorithm>
#include <cassert>

#include "tracer/bvh/trace/accel.h"
#include "tracer/bvh/trace/bundle_kernels.h"

namespace tracer {
namespace {

// Fewer rays are done sooner one by one.
constexpr size_t least_bundle = 8;
// In a row, after which every 32nd bundle is tried.
constexpr size_t most_failures = 5;

// Fewer rays are done sooner one by one, and so are those that meet hundreds of nodes and blocks:
// most blocks hold nothing for them, and a ray alone leaves those early. Measured.
constexpr size_t least_stream = 8;
constexpr float most_steps_in_stream = 100;

size_t bundle_end(size_t first, size_t ray_count) {
  return std::min(first + bundle_size, ray_count);
}

bool may_share_origin(std::span<const Ray> rays) {
  return rays.size() >= least_bundle && rays.front().origin == rays.back().origin;
}

template <class Answer>
using StreamFunction = size_t (*)(const WideTree& tree, std::span<const Ray> rays,
                                  const StopFlag& stop, std::span<Answer> answers);

// Calls trace_alone(ray, answer) for what the stream leaves. Returns how many the stream answered.
template <class Answer, class TraceAlone>
size_t trace_without_bundles(const WideTree* tree, std::span<const Ray> rays, const StopFlag& stop,
                             std::span<Answer> answers, StreamFunction<Answer> stream,
                             const TraceAlone& trace_alone) {
  const bool pays = tree && tree->expected_steps < most_steps_in_stream;
  size_t first = 0, streamed = 0;
  while (first < rays.size()) {
    if (pays && rays.size() - first >= least_stream) {
      const size_t done = stream(*tree, rays.subspan(first), stop, answers.subspan(first));
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

}  // namespace

void RayCaster::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) {
  assert(rays.size() == hits.size());
  const auto trace_rest = [&](size_t begin, size_t end) {
    const size_t streamed =
        trace_without_bundles(accel_.wide.get(), rays.subspan(begin, end - begin), stop_,
                              hits.subspan(begin, end - begin), closest_hits_stream,
                              [this](const Ray& ray, Hit& hit) { hit = closest_hit(ray); });
    ray_count_ += streamed;
  };
  size_t unanswered = 0;  // from here on
  for (size_t first = 0; first < rays.size();) {
    const size_t end = bundle_end(first, rays.size());
    const auto bundle = rays.subspan(first, end - first);
    if (accel_.wide && may_share_origin(bundle) && !stop_.requested() &&
        closest_hits_bundle(*accel_.wide, bundle, stop_, hits.subspan(first, end - first))) {
      trace_rest(unanswered, first);
      ray_count_ += bundle.size();
      unanswered = end;
    }
    first = end;
  }
  trace_rest(unanswered, rays.size());
}

void RayCaster::occluded(std::span<const Ray> rays, std::span<uint8_t> is_occluded) {
  assert(rays.size() == is_occluded.size());
  const auto trace_rest = [&](size_t begin, size_t end) {
    const size_t streamed = trace_without_bundles(
        accel_.wide.get(), rays.subspan(begin, end - begin), stop_,
        is_occluded.subspan(begin, end - begin), occluded_stream,
        [this](const Ray& ray, uint8_t& answer) { answer = occluded(ray) ? 1 : 0; });
    ray_count_ += streamed;
  };
  size_t unanswered = 0;                     // from here on
  size_t failures = 0, bundles_to_skip = 0;  // where bundles don't pay, few are tried
  for (size_t first = 0; first < rays.size();) {
    const size_t end = bundle_end(first, rays.size());
    const auto bundle = rays.subspan(first, end - first);
    if (bundles_to_skip > 0) {
      --bundles_to_skip;
    } else if (accel_.wide && bundle.size() >= least_bundle && !stop_.requested() &&
               occluded_bundle(*accel_.wide, bundle, stop_,
                               is_occluded.subspan(first, end - first))) {
      trace_rest(unanswered, first);
      ray_count_ += bundle.size();
      unanswered = end;
      failures = 0;
    } else {
      bundles_to_skip = (size_t{1} << failures) - 1;
      failures = std::min(failures + 1, most_failures);
    }
    first = end;
  }
  trace_rest(unanswered, rays.size());
}

}  // namespace tracer
