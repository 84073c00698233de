// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "app/session_tiles.h"
#include "tracer/render/develop.h"
#include "tracer/render/film.h"

namespace app {

/// The viewer's own copy of the picture, linear and developed, and which areas changed since they
/// were last taken.
class Picture {
 public:
  /// Takes in finished tiles of a picture of `size_px`. For another size than before, what was
  /// shown is stretched, so that something is seen until its tiles come.
  void update(tracer::Vec2i size_px, std::span<const FinishedTile> tiles);
  /// Stops that all is developed with; a change traces nothing.
  void set_exposure(double exposure);

  bool is_empty() const { return linear_.pixels.empty(); }
  tracer::Vec2i size_px() const { return linear_.size_px; }
  const tracer::Image& linear() const { return linear_; }
  std::span<const tracer::Rgba8> developed() const { return developed_; }
  bool has_changes() const { return !changed_.empty(); }
  std::vector<tracer::Tile> take_changes();

 private:
  void stretch(tracer::Vec2i size_px);
  void develop_all();

  double exposure_ = 0;
  tracer::Image linear_;
  std::vector<tracer::Rgba8> developed_;
  std::vector<tracer::Tile> changed_;
};

}  // namespace app
