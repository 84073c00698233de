// SPDX-License-Identifier: MIT
#include "tests/fuzz/check_against_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/fuzz/check_obj.h"
#include "tests/support/reference_obj.h"
#include "tracer/obj/triangulate.h"

namespace tracer {
namespace {

/// A triangle of the mesh that is to be, from the reference.
struct ExpectedTriangle {
  ReferenceCorner corners[3];
  const ReferenceFace* face = nullptr;
};

bool has_area(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return glm::cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a)) != Vec3d(0.0);
}

/// The triangles of a face whose rounded positions are `points`; none where none has an area.
std::vector<Vec3u> triangulate_face(const std::vector<Vec3f>& points) {
  std::vector<Vec3u> triangles{{0, 1, 2}};
  if (points.size() > 3) {
    triangles.clear();
    Triangulator().triangulate(std::vector<Vec3d>(points.begin(), points.end()), triangles);
  }
  const bool is_kept = std::any_of(triangles.begin(), triangles.end(), [&](const Vec3u& t) {
    return has_area(points[t.x], points[t.y], points[t.z]);
  });
  return is_kept ? triangles : std::vector<Vec3u>();
}

/// What Mesh promises of positions: the one rounding is of the difference.
Vec3f rounded(const Vec3d& position, const Vec3d& origin) {
  const Vec3d offset = position - origin;
  constexpr double largest = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(offset[axis]) <= largest)) return Vec3f(0.0f);
  }
  return Vec3f(offset);
}

struct Expected {
  std::vector<ExpectedTriangle> triangles;
  int64_t dropped_faces = 0;
};

Expected expect(const ReferenceObj& reference, const Vec3d& origin) {
  Expected expected;
  expected.dropped_faces = static_cast<int64_t>(reference.lines_of_dropped_faces.size());
  for (const ReferenceFace& face : reference.faces) {
    std::vector<Vec3f> points;
    for (const ReferenceCorner& corner : face.corners) {
      points.push_back(rounded(reference.positions[static_cast<size_t>(corner.position)], origin));
    }
    const std::vector<Vec3u> triangles = triangulate_face(points);
    if (triangles.empty()) ++expected.dropped_faces;
    for (const Vec3u& triangle : triangles) {
      expected.triangles.push_back(
          {{face.corners[triangle.x], face.corners[triangle.y], face.corners[triangle.z]}, &face});
    }
  }
  return expected;
}

/// The middle of the bounds of all positions that faces use: the origin of a mesh of them.
Vec3d center_of_faces(const ReferenceObj& reference) {
  Vec3d min(std::numeric_limits<double>::infinity());
  Vec3d max = -min;
  for (const ReferenceFace& face : reference.faces) {
    for (const ReferenceCorner& corner : face.corners) {
      const Vec3d& position = reference.positions[static_cast<size_t>(corner.position)];
      min = glm::min(min, position);
      max = glm::max(max, position);
    }
  }
  return reference.faces.empty() ? Vec3d(0.0) : 0.5 * min + 0.5 * max;
}

int64_t written_index(uint32_t index) {
  return index == no_index ? -1 : static_cast<int64_t>(index);
}

// A normal without a direction counts as none, and what nothing uses is let go: the reference's
// index, or none where the vector is of no use.
void check_attribute(int64_t index, int64_t expected, bool is_usable, const char* what) {
  require(index == expected || (index == -1 && !is_usable), what);
}

bool is_direction(const Vec3d& normal) {
  const double length = glm::length(normal);
  return length > 1e-30 && length < 1e30;
}

void check_triangle(const Mesh& mesh, size_t i, const ReferenceObj& reference,
                    const ExpectedTriangle& expected) {
  for (int corner = 0; corner < 3; ++corner) {
    const ReferenceCorner& want = expected.corners[corner];
    const uint32_t position = mesh.triangles[i][corner];
    require(position == want.position, "the corner is the reference's");
    require(mesh.positions[position] == rounded(reference.positions[position], mesh.origin),
            "the position is the nearest float to the reference's");
    if (!mesh.normal_indices.empty() || want.normal >= 0) {
      const int64_t normal =
          mesh.normal_indices.empty() ? -1 : written_index(mesh.normal_indices[i][corner]);
      check_attribute(
          normal, want.normal,
          want.normal >= 0 && is_direction(reference.normals[static_cast<size_t>(want.normal)]),
          "the normal is the reference's");
    }
    const int64_t texcoord =
        mesh.texcoord_indices.empty() ? -1 : written_index(mesh.texcoord_indices[i][corner]);
    check_attribute(texcoord, want.texcoord, want.texcoord >= 0,
                    "the texture coordinate is the reference's");
  }
}

}  // namespace

void check_against_reference(std::string_view bytes) {
  const ReferenceObj reference = read_reference_obj(bytes);
  Progress progress;
  ObjFile file = parse_obj(bytes, "x.obj", progress);
  const int64_t dropped_while_parsing = file.dropped_faces;
  const std::vector<ObjName> material_names = file.material_names;
  try {
    const ObjMesh made = make_mesh(file, "x.obj", progress);
    const Mesh& mesh = made.mesh;
    const Expected expected = expect(reference, mesh.origin);
    require(mesh.triangles.size() == expected.triangles.size(), "there are as many triangles");
    for (size_t i = 0; i < expected.triangles.size(); ++i) {
      check_triangle(mesh, i, reference, expected.triangles[i]);
      require(material_names[mesh.material_of(static_cast<uint32_t>(i))].text ==
                  expected.triangles[i].face->material,
              "the material is the reference's");
    }
    require(dropped_while_parsing + made.dropped_faces == expected.dropped_faces,
            "as many faces are left out");
  } catch (const LoadError&) {
    require(expect(reference, center_of_faces(reference)).triangles.empty(),
            "there is nothing to show");
  }
}

}  // namespace tracer
