// SPDX-License-Identifier: MIT
// What `boxwood render` says about a picture it made.
#pragma once

#include <map>
#include <string>

#include "app/render_command.h"
#include "app/render_view.h"
#include "tracer/bvh/quality.h"
#include "tracer/render/film_error.h"
#include "tracer/render/render.h"
#include "tracer/scene/import_obj.h"

namespace app {

struct StageSeconds {
  double load = 0;
  double build = 0;
  double render = 0;
  double write = 0;
};

struct RenderReport {
  ResolvedView view;
  tracer::TreeMetrics tree;                // node_count 0 without one; measured, as is the next,
  tracer::TreeQuality tree_quality;        // where a stats file is asked for
  size_t tree_bytes = 0;                   // that rays are traced through
  tracer::PassStats passes;                // of all passes together
  uint32_t whole_sample_count = 0;         // samples that the pixels of rate 1 have
  std::optional<tracer::FilmError> error;  // of the picture, where it was asked for
  StageSeconds seconds;
};

/// For the picture's file: what it takes to make the same picture again, and nothing of where or
/// when.
std::map<std::string, std::string> picture_metadata(const RenderOptions& options,
                                                    const RenderReport& report);

/// "cow.png: 1280x720, 64 samples a pixel, 12.3 s, 4.56 Mray/s".
std::string summary(const RenderOptions& options, const RenderReport& report);

/// Counts, seconds of each stage, rays and settings as JSON. Throws LoadError.
void write_stats(const std::filesystem::path& path, const RenderOptions& options,
                 const tracer::ImportedScene& imported, const RenderReport& report);

}  // namespace app
