// SPDX-License-Identifier: MIT
#include "tracer/obj/join_chunks.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "tracer/base/parallel.h"
#include "tracer/obj/check_faces.h"

namespace tracer {
namespace {

/// Materials in the order in which the file first uses them.
class MaterialTable {
 public:
  explicit MaterialTable(std::vector<ObjName>& names) : names_(names) { find_or_add({}, 0); }

  /// The file's indices of a chunk's materials.
  std::vector<uint32_t> add(const ObjChunk& chunk, int64_t lines_before) {
    std::vector<uint32_t> indices{current_};
    for (size_t i = 1; i < chunk.material_names.size(); ++i) {
      indices.push_back(find_or_add(chunk.material_names[i], lines_before));
    }
    current_ = indices[chunk.last_material];
    return indices;
  }

 private:
  uint32_t find_or_add(const ObjName& name, int64_t lines_before) {
    const auto [entry, is_new] =
        indices_.try_emplace(name.text, static_cast<uint32_t>(names_.size()));
    if (is_new) names_.push_back({name.text, name.line + lines_before});
    return entry->second;
  }

  std::vector<ObjName>& names_;
  std::unordered_map<std::string, uint32_t> indices_;
  uint32_t current_ = 0;
};

class Joiner {
 public:
  Joiner(std::deque<ObjChunk> chunks, const std::string& path, Progress& progress)
      : path_(path), progress_(progress), materials_(file_.material_names) {
    file_.chunks.reserve(chunks.size());
    for (ObjChunk& chunk : chunks) place(std::move(chunk));
  }

  ObjFile join() {
    file_.lacks_texcoords =
        std::any_of(file_.chunks.begin(), file_.chunks.end(),
                    [&](const PlacedChunk& placed) { return lacks_texcoords(placed.chunk); });
    check_all_faces();
    warn_of_free_forms();
    paint();
    return std::move(file_);
  }

 private:
  void place(ObjChunk&& chunk) {
    const ObjCounts counts = chunk.counts();
    OtherElements& others = file_.others;
    if (others.free_forms == 0 && chunk.others.free_forms > 0) {
      others.first_free_form_line = chunk.others.first_free_form_line + line_count_;
    }
    others.points += chunk.others.points;
    others.lines += chunk.others.lines;
    others.free_forms += chunk.others.free_forms;
    file_.object_count += chunk.object_count;
    file_.group_count += chunk.group_count;
    file_.has_colors = file_.has_colors || !chunk.colors.empty();
    for (ObjName& name : chunk.material_libraries) {
      file_.material_libraries.push_back({std::move(name.text), name.line + line_count_});
    }
    std::vector<uint32_t> materials = materials_.add(chunk, line_count_);
    const int64_t lines_before = line_count_;
    line_count_ += chunk.line_count;
    file_.chunks.push_back({std::move(chunk), file_.counts, lines_before, std::move(materials)});
    file_.counts.positions += counts.positions;
    file_.counts.texcoords += counts.texcoords;
    file_.counts.normals += counts.normals;
  }

  /// What was dropped may be of use, or has a fault to tell of.
  bool lacks_texcoords(const ObjChunk& chunk) const {
    return chunk.has_dropped_texcoords &&
           (!file_.material_libraries.empty() || chunk.largest.texcoord > file_.counts.texcoords);
  }

  void check_all_faces() {
    std::vector<Warnings> found(file_.chunks.size());
    parallel_for_each_index(0, found.size(), [&](size_t i) {
      progress_.throw_if_stopped();
      found[i] = check_faces(file_.chunks[i].chunk, file_.chunks[i].before, file_.counts);
    });
    for (size_t i = 0; i < found.size(); ++i) {
      const PlacedChunk& placed = file_.chunks[i];
      file_.warnings.append_moved(merged_by_line(placed.chunk.warnings, found[i]), path_,
                                  placed.lines_before);
      file_.dropped_faces += placed.chunk.dropped_faces;
      file_.face_count += placed.chunk.face_count;
    }
  }

  void warn_of_free_forms() {
    const OtherElements& others = file_.others;
    if (others.free_forms == 0) return;
    Warnings free_forms;
    free_forms.add({path_, others.first_free_form_line,
                    std::to_string(others.free_forms) +
                        " free-form curves and surfaces from here on are passed over"});
    file_.warnings = merged_by_line(file_.warnings, free_forms);
  }

  /// ZBrush's colours, where no vertex has one in its own line.
  void paint() {
    std::vector<uint32_t> painted;
    for (const PlacedChunk& placed : file_.chunks) {
      painted.insert(painted.end(), placed.chunk.painted.begin(), placed.chunk.painted.end());
    }
    if (painted.empty() || file_.has_colors) return;
    file_.has_colors = true;
    PageArena arena;
    for (PlacedChunk& placed : file_.chunks) {
      std::vector<Vec3f> colors(placed.chunk.positions.size(),
                                Vec3f(std::numeric_limits<float>::quiet_NaN()));
      for (size_t i = 0; i < colors.size() && placed.before.positions + i < painted.size(); ++i) {
        const uint32_t mrgb = painted[placed.before.positions + i];
        colors[i] = Vec3f(mrgb >> 16 & 255, mrgb >> 8 & 255, mrgb & 255) / 255.0f;
      }
      placed.chunk.colors = arena.copy(std::span<const Vec3f>(colors));
    }
  }

  const std::string& path_;
  Progress& progress_;
  ObjFile file_;
  MaterialTable materials_;
  int64_t line_count_ = 0;
};

}  // namespace

ObjFile join_chunks(std::deque<ObjChunk> chunks, const std::string& path, Progress& progress) {
  return Joiner(std::move(chunks), path, progress).join();
}

}  // namespace tracer
