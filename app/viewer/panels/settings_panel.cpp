// SPDX-License-Identifier: MIT
#include "app/viewer/panels/settings_panel.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace app {
namespace {

constexpr int greatest_sample_limit = 65536;
constexpr float brightest_slider = 5;
// Of the slider, whose right end stands for none.
constexpr double least_error_limit = 1e-6;
constexpr double no_error_limit = 1;

/// A combo over a table of {name, label, what}, which closed says `shown`.
template <class Entry>
void draw_choice(const Ui& ui, const char* label, const char* name, std::span<const Entry> entries,
                 const Entry*& chosen, const std::string& shown) {
  control_label(ui, label);
  const std::string id = std::string("##") + name;
  const bool is_open = ImGui::BeginCombo(id.c_str(), shown.c_str());
  if (!is_open) {
    finish_control(ui, name, std::string(chosen->what));
    return;
  }
  ui.layout.note_last_item(name);
  for (const Entry& entry : entries) {
    const bool is_chosen = &entry == chosen;
    if (ImGui::Selectable(std::string(entry.label).c_str(), is_chosen)) chosen = &entry;
    finish_control(ui, std::string(name) + ' ' + std::string(entry.name), std::string(entry.what));
  }
  ImGui::EndCombo();
}

template <class Entry>
void draw_choice(const Ui& ui, const char* label, const char* name, std::span<const Entry> entries,
                 const Entry*& chosen) {
  draw_choice(ui, label, name, entries, chosen, std::string(chosen->label));
}

void draw_value(const char* id, int& value, const tracer::Field<int>& field) {
  constexpr int widest_slider = 1000;
  if (field.max - field.min > widest_slider) {
    ImGui::DragInt(id, &value, 0.2f, field.min, field.max, "%d", ImGuiSliderFlags_AlwaysClamp);
    return;
  }
  begin_slider(static_cast<double>(value - field.min) / (field.max - field.min), 0);
  ImGui::SliderInt(id, &value, field.min, field.max, "%d", ImGuiSliderFlags_AlwaysClamp);
  end_slider();
}

void draw_value(const char* id, double& value, const tracer::Field<double>& field) {
  if (field.min < 0) {
    const std::string format = std::string("%+.2f") + field.unit;
    ImGui::DragScalar(id, ImGuiDataType_Double, &value, 0.02f, &field.min, &field.max,
                      format.c_str(), ImGuiSliderFlags_AlwaysClamp);
    return;
  }
  // Factors, of which a half is as far from one as two.
  const bool is_factor = field.min > 0;
  const double part =
      is_factor ? std::log(value / field.min) / std::log(field.max / field.min) : value / field.max;
  begin_slider(part, 0);
  const std::string format = std::string("%.2f") + field.unit;
  ImGui::SliderScalar(id, ImGuiDataType_Double, &value, &field.min, &field.max, format.c_str(),
                      ImGuiSliderFlags_AlwaysClamp |
                          (is_factor ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None));
  end_slider();
}

/// Whether it is being dragged.
template <class T>
bool draw_field(const Ui& ui, T& value, const tracer::Field<T>& field) {
  control_label(ui, format_label(field.name));
  draw_value((std::string("##") + field.name).c_str(), value, field);
  const bool is_dragged = ImGui::IsItemActive();
  finish_control(ui, field.name, field.help);
  return is_dragged;
}

template <class T>
requires std::is_enum_v<T>
bool draw_field(const Ui& ui, T& value, const tracer::Field<T>& field) {
  const tracer::Choice<T>* chosen = &choice_of(value, field);
  draw_choice(ui, format_label(field.name).c_str(), field.name, field.choices, chosen);
  value = chosen->value;
  return false;
}

/// Those of the settings that `is_drawn` picks by their names; whether one is being dragged.
template <class Settings, class Pick>
bool draw_fields(const Ui& ui, Settings& settings, Pick&& is_drawn) {
  bool is_dragged = false;
  for_each_field(settings, [&](auto& value, const auto& field) {
    if (!is_drawn(std::string_view(field.name))) return;
    is_dragged |= draw_field(ui, value, field);
  });
  return is_dragged;
}

bool is_main_tree_setting(std::string_view name) {
  return name == "max-depth" || name == "leaf-size";
}

bool is_main_picture_setting(std::string_view name) {
  return name == "exposure";
}

/// The chosen builder, unless a quicker one stands in for it.
std::string shown_builder(const ViewerSettings& settings, const tracer::Builder* used) {
  const bool is_stand_in =
      used != nullptr && used != settings.builder && used == ViewerSettings::quick_builder();
  if (!is_stand_in) return std::string(settings.builder->label);
  return std::string(used->label.substr(0, used->label.find(','))) + " while dragging";
}

void draw_tree_settings(const Ui& ui, ViewerSettings& settings,
                        const tracer::Builder* used_builder) {
  control_label(ui, "BVH");
  ImGui::Checkbox(settings.is_bvh_on ? "on##bvh" : "off: every triangle##bvh", &settings.is_bvh_on);
  finish_control(ui, "bvh",
                 "The tree over the triangles. Without it every ray meets every triangle; the "
                 "picture is the same to the last bit.");
  draw_choice(ui, "Builder", "builder", tracer::builders(), settings.builder,
              shown_builder(settings, used_builder));
  draw_choice(ui, "Traversal", "layout", tracer::layouts(), settings.layout);
  settings.is_build_dragged = draw_fields(ui, settings.build, is_main_tree_setting);
  if (!closed_part(ui, "More")) return;
  settings.is_build_dragged |=
      draw_fields(ui, settings.build, [](auto name) { return !is_main_tree_setting(name); });
  control_label(ui, "Improve");
  ImGui::Checkbox("in the background##improve", &settings.improves_tree);
  finish_control(
      ui, "improve",
      "While the picture resolves, nodes move to where boxes overlap less: the cost falls "
      "round by round. Off: the tree as it was built.");
}

void draw_degrees(const Ui& ui, const char* label, const char* name, double& degrees, double max,
                  const char* help) {
  constexpr double min = 0;
  control_label(ui, label);
  begin_slider(degrees / max, 0);
  ImGui::SliderScalar((std::string("##") + name).c_str(), ImGuiDataType_Double, &degrees, &min,
                      &max, "%.1f deg", ImGuiSliderFlags_AlwaysClamp);
  end_slider();
  finish_control(ui, name, help);
}

void draw_sky_color(const Ui& ui, ViewerSettings& settings) {
  control_label(ui, "Brightness");
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  begin_slider(settings.sky_brightness / brightest_slider, ImGui::GetFrameHeight() + gap);
  ImGui::SliderFloat("##sky", &settings.sky_brightness, 0, brightest_slider, "%.2f",
                     ImGuiSliderFlags_AlwaysClamp);
  end_slider();
  finish_control(ui, "sky", "Radiance from everywhere around the model.");
  ImGui::SameLine(0, gap);
  ImGui::ColorEdit3("##sky-color", &settings.sky_color.x,
                    ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float);
  settings.sky_color = clamp(settings.sky_color, tracer::Vec3f(0), tracer::Vec3f(1));
  finish_control(ui, "sky-color", "");
}

void draw_sky(const Ui& ui, ViewerSettings& settings) {
  control_label(ui, "Sky");
  const int kind =
      settings.environment_file
          ? segmented(ui, "sky-kind", {"Colour", "Sun", "Map"}, static_cast<int>(settings.sky_kind))
          : segmented(ui, "sky-kind", {"Colour", "Sun"}, static_cast<int>(settings.sky_kind));
  settings.sky_kind = static_cast<SkyKind>(kind);
  if (settings.sky_kind == SkyKind::colour) draw_sky_color(ui, settings);
  if (settings.sky_kind != SkyKind::sun) return;
  draw_degrees(ui, "Sun height", "sun-elevation", settings.sun.elevation_degrees, 90,
               "Of the sun above the horizon.");
  draw_degrees(ui, "Sun azimuth", "sun-azimuth", settings.sun.azimuth_degrees, 360,
               "From the model's +X, counter-clockwise as seen from above.");
}

void draw_limits(const Ui& ui, ViewerSettings& settings) {
  control_label(ui, "Samples");
  begin_slider(std::log(settings.sample_limit) / std::log(greatest_sample_limit), 0);
  ImGui::SliderInt("##sample-limit", &settings.sample_limit, 1, greatest_sample_limit, "up to %d",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  end_slider();
  finish_control(ui, "sample-limit", "Samples a pixel at which the picture is done.");
  control_label(ui, "Stop at error");
  double limit = settings.error_limit > 0 ? settings.error_limit : no_error_limit;
  begin_slider(std::log(limit / least_error_limit) / std::log(no_error_limit / least_error_limit),
               0);
  ImGui::SliderScalar("##error-limit", ImGuiDataType_Double, &limit, &least_error_limit,
                      &no_error_limit, limit < no_error_limit ? "%.2g" : "never",
                      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp |
                          ImGuiSliderFlags_NoRoundToFormat);
  end_slider();
  settings.error_limit = limit < no_error_limit ? limit : 0;
  finish_control(ui, "error-limit",
                 "The picture is done when its error is at or under this: relMSE, the mean of "
                 "(x - r)^2 / (r^2 + 0.01), told from its own samples.");
}

void draw_picture_settings(const Ui& ui, ViewerSettings& settings) {
  draw_choice(ui, "Integrator", "integrator", tracer::integrators(), settings.integrator);
  control_label(ui, "Shading");
  const int shading = segmented(ui, "shading", {"Flat", "Smooth"},
                                settings.shading == tracer::Shading::smooth ? 1 : 0);
  settings.shading = shading == 1 ? tracer::Shading::smooth : tracer::Shading::flat;
  draw_fields(ui, settings.render, is_main_picture_setting);
  draw_sky(ui, settings);
  draw_limits(ui, settings);
  control_label(ui, "Show");
  settings.shown = static_cast<ShownMap>(
      segmented(ui, "show", {"Picture", "Samples", "Error"}, static_cast<int>(settings.shown)));
  if (!closed_part(ui, "More##picture")) return;
  draw_fields(ui, settings.render, [](auto name) { return !is_main_picture_setting(name); });
  control_label(ui, "Up");
  settings.up =
      static_cast<UpAxis>(segmented(ui, "up", {"Auto", "Y", "Z"}, static_cast<int>(settings.up)));
}

}  // namespace

void ViewerSettings::set_sky(const tracer::Vec3d& radiance) {
  const double largest = tracer::max_abs(radiance);
  sky_brightness = static_cast<float>(largest);
  sky_color = largest > 0 ? tracer::Vec3f(radiance / largest) : tracer::Vec3f(1.0f);
}

void ViewerSettings::set_environment(const EnvironmentSource& source) {
  environment_file = source.file;
  if (source.file) sky_kind = SkyKind::map;
  if (!source.sun) return;
  sky_kind = SkyKind::sun;
  sun = *source.sun;
}

EnvironmentSource ViewerSettings::environment_source() const {
  if (sky_kind == SkyKind::sun) return {.file = {}, .sun = sun};
  if (sky_kind == SkyKind::map) return {.file = environment_file, .sun = {}};
  return {};
}

const tracer::Builder* ViewerSettings::builder_for(uint32_t triangle_count) const {
  constexpr uint32_t large = 20'000;
  if (!is_bvh_on) return nullptr;
  return is_build_dragged && triangle_count > large ? quick_builder() : builder;
}

void draw_settings(const Ui& ui, ViewerSettings& settings, const tracer::Builder* used_builder) {
  settings.is_build_dragged = false;
  if (section(ui, "Bounding volume hierarchy")) draw_tree_settings(ui, settings, used_builder);
  if (section(ui, "Picture")) draw_picture_settings(ui, settings);
}

}  // namespace app
