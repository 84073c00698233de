// SPDX-License-Identifier: MIT
#include "app/render_view.h"

#include <fmt/format.h>

#include "app/option_error.h"
#include "app/option_values.h"

namespace app {
namespace {

std::optional<tracer::View> find_view(const RenderOptions& options) {
  if (options.view_file) return tracer::load_view(*options.view_file);
  const std::filesystem::path beside = tracer::view_path_of(options.model);
  std::error_code ignored;
  if (!std::filesystem::exists(beside, ignored)) return std::nullopt;
  return tracer::load_view(beside);
}

// The camera's place is a float from the mesh's centre.
bool is_in_reach(const tracer::Vec3d& point, const tracer::Vec3d& origin) {
  constexpr double reach = 1e30;
  return tracer::max_abs(point - origin) <= reach;
}

void check(const ResolvedView& view, const tracer::Vec3d& origin) {
  if (int64_t{view.size_px.x} * view.size_px.y > max_picture_px) {
    throw OptionError(fmt::format("--size: {}x{} is too large; {} million pixels at most",
                                  view.size_px.x, view.size_px.y, max_picture_px >> 20));
  }
  if (!is_in_reach(view.camera.eye, origin) || !is_in_reach(view.camera.target, origin)) {
    throw OptionError("--eye or --target lies too far away; 1e30 from the model at most");
  }
  if (view.camera.eye == view.camera.target) {
    throw OptionError("--eye and --target are the same point; move one of them");
  }
  if (view.camera.up == tracer::Vec3d(0)) {
    throw OptionError("--up: 0,0,0 is no direction; say for example 0,1,0");
  }
}

}  // namespace

ResolvedView resolve_view(const RenderOptions& options, const tracer::Mesh& mesh) {
  const std::optional<tracer::View> saved = find_view(options);
  ResolvedView view;
  view.size_px =
      options.size_px.value_or(saved && saved->size_px ? *saved->size_px : default_size_px);
  const double aspect = static_cast<double>(view.size_px.x) / view.size_px.y;
  view.camera = saved ? saved->camera : tracer::default_camera(mesh.bounds, mesh.origin, aspect);
  view.camera.eye = options.eye.value_or(view.camera.eye);
  view.camera.target = options.target.value_or(view.camera.target);
  view.camera.up = options.up.value_or(view.camera.up);
  view.camera.fov_degrees = options.fov_degrees.value_or(view.camera.fov_degrees);
  view.sky = options.sky.value_or(saved && saved->sky ? *saved->sky : tracer::World{}.sky);
  view.environment = options.environment;
  check(view, mesh.origin);
  return view;
}

}  // namespace app
