// SPDX-License-Identifier: MIT
// The command that shows how one sample of a picture came about.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/render_view.h"
#include "tracer/render/render.h"

namespace app {

/// Of `boxwood`: they print the path of the sample, whatever view file lies beside the model, from
/// the same bits.
std::vector<std::string> replay_arguments(const std::filesystem::path& model,
                                          const ResolvedView& view,
                                          const tracer::Integrator& integrator,
                                          const tracer::RenderSettings& settings,
                                          const tracer::SampleId& id);

/// "3 samples were not finite and count as black".
std::string count_of_dropped(uint64_t dropped_samples);

/// A line for a shell: "boxwood render 'my cow.obj' ...".
std::string replay_command(const std::vector<std::string>& arguments);

}  // namespace app
