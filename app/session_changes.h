// SPDX-License-Identifier: MIT
// What a change of the settings costs.
#pragma once

#include <vector>

#include "app/session.h"
#include "tracer/base/fields.h"

namespace app {

/// Whether any field whose change has this effect differs.
template <class Settings>
bool differs(const Settings& before, const Settings& after, tracer::Effect effect) {
  std::vector<double> values;  // holds every int and double exactly
  for_each_field(before, [&](const auto& value, const auto&) { values.push_back(value); });
  size_t field_index = 0;
  bool is_different = false;
  for_each_field(after, [&](const auto& value, const auto& field) {
    const bool is_same = static_cast<double>(value) == values[field_index++];
    is_different |= !is_same && field.effect == effect;
  });
  return is_different;
}

/// Whether the film has to be cleared. Shading, which needs a new scene first, is not looked at.
inline bool is_new_picture(const Edits& before, const Edits& after) {
  return before.model_generation != after.model_generation || before.camera != after.camera ||
         before.size_px != after.size_px || before.sky != after.sky ||
         before.environment != after.environment || before.integrator != after.integrator ||
         differs(before.render, after.render, tracer::Effect::restart) ||
         differs(before.build, after.build, tracer::Effect::restart);
}

/// Whether another tree is wanted.
inline bool is_new_tree(const Edits& before, const Edits& after) {
  return before.builder != after.builder || before.layout != after.layout ||
         differs(before.build, after.build, tracer::Effect::rebuild);
}

}  // namespace app
