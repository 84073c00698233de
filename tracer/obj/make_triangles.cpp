// SPDX-License-Identifier: MIT
#include "tracer/obj/make_triangles.h"

#include <atomic>

#include "tracer/base/parallel.h"
#include "tracer/obj/triangulate.h"

namespace tracer {
namespace {

/// Where a chunk's triangles stand, and which optional arrays they use.
struct TriangleRange {
  uint64_t first = 0;
  uint64_t count = 0;
  bool uses_normals = false;
  bool uses_texcoords = false;
  bool uses_materials = false;
};

bool has_area(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3d origin(a);
  const Vec3d along = Vec3d(b) - origin;
  const Vec3d across = Vec3d(c) - origin;
  // The cross product's coordinates: mostly, the first tells.
  return along.y * across.z - across.y * along.z != 0 ||
         along.z * across.x - across.z * along.x != 0 ||
         along.x * across.y - across.x * along.y != 0;
}

/// Writes one chunk's triangles into the mesh's arrays.
class ChunkTriangles {
 public:
  ChunkTriangles(const PlacedChunk& placed, bool has_zero_normal, Mesh& mesh, TriangleRange& range)
      : placed_(placed), has_zero_normal_(has_zero_normal), mesh_(mesh), range_(range) {}

  Warnings make() {
    for (const FaceRun& run : placed_.chunk.runs) make_run(run);
    return std::move(warnings_);
  }

 private:
  void make_run(const FaceRun& run) {
    form_ = run.form;
    stride_ = indices_a_corner(run.form);
    material_ = placed_.materials[run.material];
    const int32_t* face = placed_.chunk.indices.data() + run.first_index;
    for (uint32_t i = 0; i < run.face_count; ++i, face += run.indices_a_face()) {
      if (*face == 0) continue;
      const bool is_made =
          run.corner_count == 3 ? make_triangle(face) : make_polygon(face, run.corner_count);
      if (!is_made) warnings_.add({"", run.line + i, "the face has no area"});
    }
  }

  bool make_triangle(const int32_t* face) {
    if (!has_area(position(face, 0), position(face, 1), position(face, 2))) return false;
    write(face, {0, 1, 2});
    return true;
  }

  /// False, with nothing written, where no triangle of the polygon has an area.
  bool make_polygon(const int32_t* face, uint32_t corner_count) {
    points_.clear();
    for (uint32_t i = 0; i < corner_count; ++i) points_.emplace_back(position(face, i));
    triangles_.clear();
    triangulator_.triangulate(points_, triangles_);
    const auto has_any_area = [&](const Vec3u& corners) {
      return has_area(position(face, corners.x), position(face, corners.y),
                      position(face, corners.z));
    };
    if (std::none_of(triangles_.begin(), triangles_.end(), has_any_area)) return false;
    for (const Vec3u& corners : triangles_) write(face, corners);
    return true;
  }

  const Vec3f& position(const int32_t* face, uint32_t corner) const {
    return mesh_.positions[static_cast<size_t>(face[corner * stride_]) - 1];
  }

  void write(const int32_t* face, const Vec3u& corners) {
    const uint64_t at = range_.first + range_.count++;
    const Vec3u places = corners * stride_;
    mesh_.triangles[at] = gather(face, places);
    if (!mesh_.texcoord_indices.empty()) {
      Vec3u& indices = mesh_.texcoord_indices[at];
      indices = has_texcoord(form_) ? gather(face + 1, places) : Vec3u(no_index);
      range_.uses_texcoords |= indices != Vec3u(no_index);
    }
    if (!mesh_.normal_indices.empty()) {
      Vec3u& indices = mesh_.normal_indices[at];
      indices = has_normal(form_) ? gather(face + stride_ - 1, places) : Vec3u(no_index);
      if (has_zero_normal_) drop_zero_normals(indices);
      range_.uses_normals |= indices != Vec3u(no_index);
    }
    if (!mesh_.materials.empty()) {
      mesh_.materials[at] = material_;
      range_.uses_materials |= material_ != 0;
    }
  }

  /// From 0; what the file counts as 0, none, becomes no_index.
  static Vec3u gather(const int32_t* indices, const Vec3u& places) {
    return Vec3u(static_cast<uint32_t>(indices[places.x]), static_cast<uint32_t>(indices[places.y]),
                 static_cast<uint32_t>(indices[places.z])) -
           1u;
  }

  void drop_zero_normals(Vec3u& indices) const {
    for (int i = 0; i < 3; ++i) {
      if (indices[i] != no_index && mesh_.normals[indices[i]] == Vec3f(0.0f)) indices[i] = no_index;
    }
  }

  const PlacedChunk& placed_;
  const bool has_zero_normal_;
  Mesh& mesh_;
  TriangleRange& range_;
  CornerForm form_ = CornerForm::position;
  uint32_t stride_ = 1;
  uint32_t material_ = 0;
  Triangulator triangulator_;
  std::vector<Vec3d> points_;
  std::vector<Vec3u> triangles_;
  Warnings warnings_;
};

/// Moves the ranges together, where faces were left out, as they are from then on.
template <class T>
void close_gaps(const std::vector<TriangleRange>& ranges, LargeVector<T>& values) {
  if (values.empty()) return;
  auto to = values.begin();
  for (const TriangleRange& range : ranges) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(range.first);
    if (to != from) std::copy_n(from, range.count, to);
    to += static_cast<std::ptrdiff_t>(range.count);
  }
  values.resize(static_cast<size_t>(to - values.begin()));
}

void make_room(const ObjFile& file, uint64_t triangle_count, Mesh& mesh) {
  int forms = 0;
  for (const PlacedChunk& placed : file.chunks) {
    for (const FaceRun& run : placed.chunk.runs) forms |= static_cast<int>(run.form);
  }
  const auto form = static_cast<CornerForm>(forms);
  mesh.triangles.resize(triangle_count);
  mesh.normal_indices.resize(has_normal(form) ? triangle_count : 0);
  mesh.texcoord_indices.resize(has_texcoord(form) && !mesh.texcoords.empty() ? triangle_count : 0);
  mesh.materials.resize(file.material_names.size() > 1 ? triangle_count : 0);
}

bool has_zero_normal(const Mesh& mesh) {
  const auto first = mesh.normals.begin();
  return parallel_any_of_ranges(0, mesh.normals.size(), 1 << 15, [&](size_t begin, size_t end) {
    const auto last = first + static_cast<std::ptrdiff_t>(end);
    return std::find(first + static_cast<std::ptrdiff_t>(begin), last, Vec3f(0.0f)) != last;
  });
}

void drop_unused(const std::vector<TriangleRange>& ranges, Mesh& mesh) {
  const auto uses = [&](bool TriangleRange::*member) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const auto& range) { return range.*member; });
  };
  if (!uses(&TriangleRange::uses_normals)) mesh.normals = {}, mesh.normal_indices = {};
  if (!uses(&TriangleRange::uses_texcoords)) mesh.texcoords = {}, mesh.texcoord_indices = {};
  if (!uses(&TriangleRange::uses_materials)) mesh.materials = {};
}

}  // namespace

void make_triangles(ObjFile& file, Mesh& mesh, std::vector<Warnings>& faults, Progress& progress) {
  std::vector<TriangleRange> ranges(file.chunks.size());
  uint64_t triangle_count = 0;
  for (size_t i = 0; i < ranges.size(); ++i) {
    ranges[i].first = triangle_count;
    triangle_count += file.chunks[i].chunk.triangle_count;
  }
  make_room(file, triangle_count, mesh);
  const bool has_zero_normal = tracer::has_zero_normal(mesh);
  std::atomic<size_t> done{0};
  parallel_for_each_index(0, ranges.size(), [&](size_t i) {
    progress.throw_if_stopped();
    PlacedChunk& placed = file.chunks[i];
    faults[i] = ChunkTriangles(placed, has_zero_normal, mesh, ranges[i]).make();
    placed.chunk.indices = {};
    placed.chunk.runs = {};
    progress.set_fraction(static_cast<double>(++done) / static_cast<double>(ranges.size()));
  });
  close_gaps(ranges, mesh.triangles);
  close_gaps(ranges, mesh.normal_indices);
  close_gaps(ranges, mesh.texcoord_indices);
  close_gaps(ranges, mesh.materials);
  drop_unused(ranges, mesh);
}

}  // namespace tracer
