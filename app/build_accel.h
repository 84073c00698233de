// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/accel.h"

namespace app {

/// A tree over the mesh by `builder`, or none where that is nullptr: brute force. Throws Cancelled.
std::shared_ptr<const tracer::Accel> build_accel(std::shared_ptr<const tracer::Mesh> mesh,
                                                 const tracer::Builder* builder,
                                                 const tracer::BuildSettings& settings,
                                                 tracer::Progress& progress);

}  // namespace app
