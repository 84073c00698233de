// SPDX-License-Identifier: MIT
#include "tracer/obj/used_bounds.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <optional>

#include "tracer/base/large_vector.h"
#include "tracer/base/parallel.h"

namespace tracer {
namespace {

enum Mark : uint8_t { unused, used, unusable };

class UseFinder {
 public:
  explicit UseFinder(ObjFile& file) : file_(file), marks_(file.counts.positions) {
    for_each_chunk([&](size_t i) { mark_unusable(file_.chunks[i]); });
  }

  void mark_used(std::vector<Warnings>& faults) {
    for_each_chunk([&](size_t i) {
      ObjChunk& chunk = file_.chunks[i].chunk;
      for (const FaceRun& run : chunk.runs) {
        mark_run(chunk.indices.data() + run.first_index, run, faults[i]);
      }
    });
  }

  WorldBounds bounds() {
    std::vector<WorldBounds> parts(file_.chunks.size());
    for_each_chunk([&](size_t i) { parts[i] = bounds_of(file_.chunks[i]); });
    WorldBounds bounds;
    for (const WorldBounds& part : parts) bounds.extend(part);
    return bounds;
  }

 private:
  template <class F>
  void for_each_chunk(F&& f) {
    parallel_for_each_index(0, file_.chunks.size(), f);
  }

  void mark_unusable(const PlacedChunk& placed) {
    const PageArray<Vec3d>& positions = placed.chunk.positions;
    uint8_t* const marks = marks_.data() + placed.before.positions;
    if (!positions.empty()) std::memset(marks, unused, positions.size());
    if (!placed.chunk.has_unusable_position) return;
    has_unusable_ = true;
    for (size_t i = 0; i < positions.size(); ++i) {
      if (!fits_float(positions[i])) marks[i] = unusable;
    }
  }

  void mark_run(int32_t* face, const FaceRun& run, Warnings& faults) {
    const uint32_t stride = indices_a_corner(run.form);
    const uint64_t face_size = run.indices_a_face();
    for (uint32_t i = 0; i < run.face_count; ++i, face += face_size) {
      if (*face == 0) continue;
      if (has_unusable_ && is_unusable(face, face_size, stride)) {
        faults.add({"", run.line + i, "a vertex of the face is not finite, or too large"});
        *face = 0;
        continue;
      }
      for (uint64_t k = 0; k < face_size; k += stride) mark(face[k]).store(used, relaxed);
    }
  }

  bool is_unusable(const int32_t* face, uint64_t face_size, uint32_t stride) {
    for (uint64_t k = 0; k < face_size; k += stride) {
      if (mark(face[k]).load(relaxed) == unusable) return true;
    }
    return false;
  }

  WorldBounds bounds_of(const PlacedChunk& placed) const {
    const PageArray<Vec3d>& positions = placed.chunk.positions;
    const uint8_t* const marks = marks_.data() + placed.before.positions;
    if (std::all_of(marks, marks + positions.size(), [](uint8_t mark) { return mark == used; })) {
      return placed.chunk.bounds;
    }
    WorldBounds bounds;
    for (size_t i = 0; i < positions.size(); ++i) {
      if (marks[i] == used) bounds.extend(positions[i]);
    }
    return bounds;
  }

  static constexpr std::memory_order relaxed = std::memory_order_relaxed;
  // Threads mark the same position at once.
  std::atomic_ref<uint8_t> mark(int32_t index) {
    return std::atomic_ref(marks_[static_cast<size_t>(index) - 1]);
  }

  ObjFile& file_;
  LargeVector<uint8_t> marks_;
  std::atomic<bool> has_unusable_{false};
};

bool names_position(const FaceRun& run, const int32_t* indices, int32_t position) {
  const uint32_t stride = indices_a_corner(run.form);
  const uint64_t face_size = run.indices_a_face();
  const uint64_t size = run.face_count * face_size;
  for (uint64_t i = 0; i < size; i += stride) {
    if (indices[i] != position) continue;
    const bool is_dropped = indices[i / face_size * face_size] == 0;
    if (!is_dropped) return true;
  }
  return false;
}

/// Whether a face names the position, which counts from 1. Most models name theirs about in order:
/// the first chunk that may name it does.
bool is_used(const ObjFile& file, uint64_t position) {
  return std::any_of(file.chunks.begin(), file.chunks.end(), [&](const PlacedChunk& placed) {
    const ObjChunk& chunk = placed.chunk;
    if (chunk.largest.position < position) return false;
    return std::any_of(chunk.runs.begin(), chunk.runs.end(), [&](const FaceRun& run) {
      return names_position(run, chunk.indices.data() + run.first_index,
                            static_cast<int32_t>(position));
    });
  });
}

/// The first position, from 1, that has the coordinate.
template <Vec3d WorldBounds::*corner>
uint64_t find_on_side(const ObjFile& file, int axis, double coordinate) {
  for (const PlacedChunk& placed : file.chunks) {
    if ((placed.chunk.bounds.*corner)[axis] != coordinate) continue;
    const PageArray<Vec3d>& positions = placed.chunk.positions;
    const auto found = std::find_if(positions.begin(), positions.end(), [&](const Vec3d& position) {
      return position[axis] == coordinate;
    });
    return placed.before.positions + static_cast<uint64_t>(found - positions.begin()) + 1;
  }
  return 0;
}

/// The bounds of all positions, where faces use one on each side of them: then it does not matter
/// which others they use.
std::optional<WorldBounds> bounds_if_reached(const ObjFile& file) {
  WorldBounds bounds;
  for (const PlacedChunk& placed : file.chunks) {
    if (placed.chunk.has_unusable_position) return std::nullopt;
    bounds.extend(placed.chunk.bounds);
  }
  if (file.counts.positions == 0) return std::nullopt;
  std::atomic<bool> is_reached{true};
  parallel_for_each_index(0, 6, [&](size_t side) {
    const auto axis = static_cast<int>(side / 2);
    const uint64_t position = side % 2 == 0
                                  ? find_on_side<&WorldBounds::min>(file, axis, bounds.min[axis])
                                  : find_on_side<&WorldBounds::max>(file, axis, bounds.max[axis]);
    if (is_reached && !is_used(file, position)) is_reached = false;
  });
  return is_reached ? std::optional(bounds) : std::nullopt;
}

}  // namespace

WorldBounds find_used_bounds(ObjFile& file, std::vector<Warnings>& faults) {
  if (const auto bounds = bounds_if_reached(file)) return *bounds;
  UseFinder finder(file);
  finder.mark_used(faults);
  return finder.bounds();
}

}  // namespace tracer
