// SPDX-License-Identifier: MIT
// Finished tiles on their way from the rendering threads to whoever shows them.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "tracer/render/film.h"

namespace app {

/// A rectangle of the picture as it stands, linear radiance, rows of tile.width().
struct FinishedTile {
  tracer::Tile tile;
  std::vector<tracer::Vec3f> pixels;
};

/// Holds the newest state of each tile of one generation of the picture; what belongs to an older
/// generation is dropped, so a reader that lags sees no more than one picture.
class TileQueue {
 public:
  struct Taken {
    tracer::Vec2i size_px{0, 0};  // of the picture the tiles belong to
    std::vector<FinishedTile> tiles;
  };

  /// Drops all tiles; from now on `generation` alone is let in.
  void start_generation(uint64_t generation, tracer::Vec2i size_px);
  /// Takes the place of an earlier state of the same tile.
  void push(uint64_t generation, FinishedTile tile);
  Taken take();

 private:
  std::mutex mutex_;
  uint64_t generation_ = 0;
  tracer::Vec2i size_px_{0, 0};
  std::map<std::pair<int, int>, FinishedTile> tiles_;  // by upper left corner
};

}  // namespace app
