// SPDX-License-Identifier: MIT
#include "app/build_accel.h"

namespace app {

std::shared_ptr<const tracer::Accel> build_accel(std::shared_ptr<const tracer::Mesh> mesh,
                                                 const tracer::Builder* builder,
                                                 const tracer::BuildSettings& settings,
                                                 tracer::Progress& progress) {
  auto accel = std::make_shared<tracer::Accel>();
  accel->mesh = std::move(mesh);
  if (builder) {
    progress.start_stage("building the tree");
    accel->tree = builder->build(tracer::primitive_boxes(*accel->mesh), settings, progress);
  }
  return accel;
}

}  // namespace app
