// SPDX-License-Identifier: MIT
#include "app/session_tiles.h"

namespace app {

void TileQueue::start_generation(uint64_t generation, tracer::Vec2i size_px) {
  const std::lock_guard lock(mutex_);
  generation_ = generation;
  size_px_ = size_px;
  tiles_.clear();
}

void TileQueue::push(uint64_t generation, FinishedTile tile) {
  const std::lock_guard lock(mutex_);
  if (generation != generation_) return;
  tiles_.insert_or_assign({tile.tile.y0, tile.tile.x0}, std::move(tile));
}

TileQueue::Taken TileQueue::take() {
  std::map<std::pair<int, int>, FinishedTile> tiles;
  Taken taken;
  {
    const std::lock_guard lock(mutex_);
    tiles.swap(tiles_);
    taken.size_px = size_px_;
  }
  taken.tiles.reserve(tiles.size());
  for (auto& [corner, tile] : tiles) taken.tiles.push_back(std::move(tile));
  return taken;
}

}  // namespace app
