// SPDX-License-Identifier: MIT
#include "tracer/obj/join_chunks.h"

#include <limits>
#include <optional>
#include <unordered_map>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

/// How much of each array stands before a chunk.
struct Counts {
  uint64_t positions = 0;
  uint64_t texcoords = 0;
  uint64_t normals = 0;
};

/// Where a chunk's content goes.
struct Place {
  Counts before;
  uint32_t lines_before = 0;
  std::vector<uint32_t> materials;  // of the file, by material of the chunk
  uint64_t first_corner = 0;
  uint64_t first_face = 0;
};

/// What checking a chunk's faces found.
struct CheckedFaces {
  uint64_t corner_count = 0;  // kept
  uint64_t face_count = 0;
  Warnings warnings;
};

std::optional<uint64_t> resolve(int32_t written, uint64_t defined_count, uint64_t total_count) {
  if (written < 0) {
    const auto back = static_cast<uint64_t>(-static_cast<int64_t>(written));
    if (back > defined_count) return std::nullopt;
    return defined_count - back;
  }
  if (written == 0 || static_cast<uint64_t>(written) > total_count) return std::nullopt;
  return static_cast<uint64_t>(written) - 1;
}

uint32_t resolve_or_none(int32_t written, uint64_t defined_count, uint64_t total_count) {
  return static_cast<uint32_t>(resolve(written, defined_count, total_count).value_or(no_obj_index));
}

std::string missing(const char* what, int32_t written, uint64_t defined_count,
                    uint64_t total_count) {
  const std::string there = written < 0 ? std::to_string(defined_count) + " so far"
                                        : "the file has " + std::to_string(total_count);
  return std::string(what) + ' ' + std::to_string(written) + " does not exist (" + there + ')';
}

Counts defined_before(const WrittenFace& face, const Counts& before) {
  return {before.positions + face.position_count, before.texcoords + face.texcoord_count,
          before.normals + face.normal_count};
}

void warn(Warnings& warnings, uint32_t line, const std::string& what) {
  warnings.add({"", line, what});
}

/// Marks faces that name missing vertices by a corner count of 0, and says which attributes are
/// missing.
class FaceChecker {
 public:
  FaceChecker(ObjChunk& chunk, const Counts& before, const Counts& total)
      : chunk_(chunk), before_(before), total_(total) {}

  CheckedFaces check() {
    for (WrittenFace& face : chunk_.faces) {
      if (has_positions(face)) {
        check_attributes(face);
        checked_.corner_count += face.corner_count;
        ++checked_.face_count;
      } else {
        face.corner_count = 0;
        ++chunk_.dropped_faces;
      }
    }
    return std::move(checked_);
  }

 private:
  bool has_positions(const WrittenFace& face) {
    const uint64_t defined = defined_before(face, before_).positions;
    for (uint32_t i = 0; i < face.corner_count; ++i) {
      const int32_t written = chunk_.corners[face.first_corner + i].position;
      if (resolve(written, defined, total_.positions)) continue;
      warn(checked_.warnings, face.line, missing("vertex", written, defined, total_.positions));
      return false;
    }
    return true;
  }

  void check_attributes(const WrittenFace& face) {
    const Counts defined = defined_before(face, before_);
    check_attribute(face, &WrittenCorner::texcoord, "texture coordinate", defined.texcoords,
                    total_.texcoords);
    check_attribute(face, &WrittenCorner::normal, "normal", defined.normals, total_.normals);
  }

  /// One message a face is enough.
  void check_attribute(const WrittenFace& face, int32_t WrittenCorner::*member, const char* what,
                       uint64_t defined_count, uint64_t total_count) {
    for (uint32_t i = 0; i < face.corner_count; ++i) {
      const int32_t written = chunk_.corners[face.first_corner + i].*member;
      if (written == 0 || resolve(written, defined_count, total_count)) continue;
      warn(checked_.warnings, face.line, missing(what, written, defined_count, total_count));
      return;
    }
  }

  ObjChunk& chunk_;
  const Counts before_;
  const Counts total_;
  CheckedFaces checked_;
};

/// Materials in the order in which the file first uses them.
class MaterialTable {
 public:
  explicit MaterialTable(std::vector<ObjName>& names) : names_(names) { find_or_add({}, 0); }

  /// The file's indices of a chunk's materials.
  std::vector<uint32_t> add(const ObjChunk& chunk, uint32_t lines_before) {
    std::vector<uint32_t> indices{current_};
    for (size_t i = 1; i < chunk.material_names.size(); ++i) {
      indices.push_back(find_or_add(chunk.material_names[i], lines_before));
    }
    current_ = indices[chunk.last_material];
    return indices;
  }

 private:
  uint32_t find_or_add(const ObjName& name, uint32_t lines_before) {
    const auto [entry, is_new] =
        indices_.try_emplace(name.text, static_cast<uint32_t>(names_.size()));
    if (is_new) names_.push_back({name.text, name.line + lines_before});
    return entry->second;
  }

  std::vector<ObjName>& names_;
  std::unordered_map<std::string, uint32_t> indices_;
  uint32_t current_ = 0;
};

/// With path and line of the file.
void append_moved(Warnings& to, const Warnings& from, const std::string& path,
                  uint32_t lines_before) {
  for (const Message& message : from.messages()) {
    to.add({path, message.line + lines_before, message.what});
  }
  to.add_uncounted(from.count() - static_cast<int64_t>(from.messages().size()));
}

template <class T>
void copy_to(const std::vector<T>& from, std::vector<T>& to, uint64_t first) {
  if (from.empty()) return;
  std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(first));
}

class Joiner {
 public:
  Joiner(std::vector<ObjChunk> chunks, const std::string& path, Progress& progress)
      : chunks_(std::move(chunks)), places_(chunks_.size()), path_(path), progress_(progress) {}

  ObjFile join() {
    place_vertices();
    std::vector<CheckedFaces> checked(chunks_.size());
    parallel_for_each_index(0, chunks_.size(), [&](size_t i) {
      progress_.throw_if_stopped();
      checked[i] = FaceChecker(chunks_[i], places_[i].before, total_).check();
    });
    place_faces(checked);
    parallel_for_each_index(0, chunks_.size(), [&](size_t i) {
      progress_.throw_if_stopped();
      copy_vertices(chunks_[i], places_[i]);
      copy_faces(chunks_[i], places_[i]);
      chunks_[i] = {};
    });
    return std::move(file_);
  }

 private:
  void place_vertices() {
    MaterialTable materials(file_.material_names);
    uint32_t line_count = 0;
    bool has_colors = false;
    for (size_t i = 0; i < chunks_.size(); ++i) {
      ObjChunk& chunk = chunks_[i];
      places_[i].before = total_;
      places_[i].lines_before = line_count;
      places_[i].materials = materials.add(chunk, line_count);
      total_.positions += chunk.positions.size();
      total_.texcoords += chunk.texcoords.size();
      total_.normals += chunk.normals.size();
      has_colors = has_colors || !chunk.colors.empty();
      file_.object_count += chunk.object_count;
      file_.group_count += chunk.group_count;
      for (ObjName& name : chunk.material_libraries) {
        file_.material_libraries.push_back({std::move(name.text), name.line + line_count});
      }
      line_count += chunk.line_count;
    }
    file_.positions.resize(total_.positions);
    file_.texcoords.resize(total_.texcoords);
    file_.normals.resize(total_.normals);
    if (has_colors) {
      file_.colors.resize(total_.positions, Vec3f(std::numeric_limits<float>::quiet_NaN()));
    }
  }

  void place_faces(const std::vector<CheckedFaces>& checked) {
    uint64_t corner_count = 0;
    uint64_t face_count = 0;
    for (size_t i = 0; i < chunks_.size(); ++i) {
      ObjChunk& chunk = chunks_[i];
      append_moved(file_.warnings, merged_by_line(chunk.warnings, checked[i].warnings), path_,
                   places_[i].lines_before);
      file_.dropped_faces += chunk.dropped_faces;
      if (corner_count + checked[i].corner_count >= no_obj_index) {
        drop_all_faces(chunk, checked[i].face_count);
        continue;
      }
      places_[i].first_corner = corner_count;
      places_[i].first_face = face_count;
      corner_count += checked[i].corner_count;
      face_count += checked[i].face_count;
    }
    file_.corners.resize(corner_count);
    file_.faces.resize(face_count);
  }

  void drop_all_faces(ObjChunk& chunk, uint64_t face_count) {
    chunk.faces.clear();
    file_.dropped_faces += static_cast<int64_t>(face_count);
    file_.warnings.add({path_, 0, "more face corners than 32-bit indices can count"});
  }

  void copy_vertices(const ObjChunk& chunk, const Place& place) {
    copy_to(chunk.positions, file_.positions, place.before.positions);
    copy_to(chunk.colors, file_.colors, place.before.positions);
    copy_to(chunk.texcoords, file_.texcoords, place.before.texcoords);
    copy_to(chunk.normals, file_.normals, place.before.normals);
  }

  void copy_faces(const ObjChunk& chunk, const Place& place) {
    auto corner_index = static_cast<uint32_t>(place.first_corner);
    uint64_t face_index = place.first_face;
    for (const WrittenFace& face : chunk.faces) {
      if (face.corner_count == 0) continue;
      file_.faces[face_index++] = {corner_index, face.corner_count, place.materials[face.material],
                                   face.line + place.lines_before};
      const Counts defined = defined_before(face, place.before);
      for (uint32_t i = 0; i < face.corner_count; ++i) {
        const WrittenCorner& written = chunk.corners[face.first_corner + i];
        file_.corners[corner_index++] = {
            resolve_or_none(written.position, defined.positions, total_.positions),
            resolve_or_none(written.texcoord, defined.texcoords, total_.texcoords),
            resolve_or_none(written.normal, defined.normals, total_.normals)};
      }
    }
  }

  std::vector<ObjChunk> chunks_;
  std::vector<Place> places_;
  const std::string& path_;
  Progress& progress_;
  Counts total_;
  ObjFile file_;
};

}  // namespace

ObjFile join_chunks(std::vector<ObjChunk> chunks, const std::string& path, Progress& progress) {
  return Joiner(std::move(chunks), path, progress).join();
}

}  // namespace tracer
