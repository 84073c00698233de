// SPDX-License-Identifier: MIT
#pragma once

#include "app/session.h"
#include "app/viewer/panels/rows.h"
#include "app/viewer/up_axis.h"

namespace app {

/// What the sky of the window is made of.
enum class SkyKind { colour, sun, map };

/// The settings as the panel holds them.
struct ViewerSettings {
  bool is_bvh_on = true;
  const tracer::Builder* builder = &tracer::builders().front();  // while the BVH is on
  const tracer::Layout* layout = &tracer::layouts().front();
  tracer::BuildSettings build;
  bool is_build_dragged = false;  // one of `build` is under the mouse
  bool improves_tree = true;
  const tracer::Integrator* integrator = &tracer::integrators().front();
  tracer::Shading shading = tracer::Shading::flat;
  tracer::RenderSettings render;
  tracer::Vec3f sky_color{0.78f, 0.88f, 1.0f};
  float sky_brightness = 0.6f;
  SkyKind sky_kind = SkyKind::colour;
  tracer::SunPosition sun;
  std::optional<std::filesystem::path> environment_file;  // of the command line; else no map
  int sample_limit = 1024;
  double error_limit = 0;  // relMSE; 0: none
  ShownMap shown = ShownMap::picture;
  UpAxis up = UpAxis::automatic;

  tracer::Vec3d sky() const { return tracer::Vec3d(sky_color) * double{sky_brightness}; }
  /// Answers while settings of a large model are being dragged.
  static const tracer::Builder* quick_builder() { return tracer::find_builder("morton"); }
  /// nullptr while the BVH is off.
  const tracer::Builder* builder_for(uint32_t triangle_count) const;
  void set_sky(const tracer::Vec3d& radiance);
  void set_environment(const EnvironmentSource& source);
  EnvironmentSource environment_source() const;
};

/// The part of the panel that changes things. `used_builder` is that of the tree in use: nullptr
/// for none.
void draw_settings(const Ui& ui, ViewerSettings& settings, const tracer::Builder* used_builder);

}  // namespace app
