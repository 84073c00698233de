// SPDX-License-Identifier: MIT
// Writes the Utah teapot as triangles: Newell's 32 bicubic Bézier patches, y up, the spout along
// +x, in his units. The published table repeats itself by symmetry; here each of its rows stands
// once.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace {

struct Vector {
  double x = 0, y = 0, z = 0;
};

Vector operator-(const Vector& a) {
  return {-a.x, -a.y, -a.z};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator*(double s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vector& a) {
  return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

using Row = std::array<Vector, 4>;
using Patch = std::array<Row, 4>;  // along x around: the cross product of the two points outward

// A row of control points of a surface of revolution: a quarter of a circle, nearly.
struct Ring {
  double radius, height;
  double tangent = 0.56;  // length of the tangents, in radii
};

// A row of a tube that the plane z = 0 halves: one arc from its inner to its outer edge.
struct Arc {
  double inner_x, inner_y, outer_x, outer_y, half_width;
};

constexpr Ring lid_rings[] = {{0, 3.15},   {0.8, 3.15, 0.5625}, {0, 2.85}, {0.2, 2.7},
                              {0.4, 2.55}, {1.3, 2.55},         {1.3, 2.4}};

constexpr Ring body_rings[] = {{1.4, 2.4},    {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4},
                               {1.75, 1.875}, {2, 1.35},         {2, 0.9},          {2, 0.45},
                               {1.5, 0.225},  {1.5, 0.15},       {1.5, 0.075},      {1.425, 0},
                               {0, 0}};

constexpr Arc handle_arcs[] = {{-1.6, 2.025, -1.5, 2.25, 0.3}, {-2.3, 2.025, -2.5, 2.25, 0.3},
                               {-2.7, 2.025, -3, 2.25, 0.3},   {-2.7, 1.8, -3, 1.8, 0.3},
                               {-2.7, 1.575, -3, 1.35, 0.3},   {-2.5, 1.125, -2.65, 0.9375, 0.3},
                               {-2, 0.9, -1.9, 0.6, 0.3}};

constexpr Arc spout_arcs[] = {{1.7, 1.425, 1.7, 0.6, 0.66},       {2.6, 1.425, 3.1, 0.825, 0.66},
                              {2.3, 2.1, 2.4, 2.025, 0.25},       {2.7, 2.4, 3.3, 2.4, 0.25},
                              {2.8, 2.475, 3.525, 2.49375, 0.25}, {2.9, 2.475, 3.45, 2.5125, 0.15},
                              {2.8, 2.4, 3.2, 2.4, 0.15}};

Row quarter_circle(const Ring& ring, int quarter) {
  const double r = ring.radius, t = ring.tangent * ring.radius;
  Row row{{{r, ring.height, 0}, {r, ring.height, -t}, {t, ring.height, -r}, {0, ring.height, -r}}};
  for (; quarter > 0; --quarter) {
    for (Vector& point : row) point = {point.z, point.y, -point.x};
  }
  return row;
}

Row half_tube(const Arc& arc, int half) {
  const auto [ix, iy, ox, oy, w] = arc;
  if (half == 0) return {{{ix, iy, 0}, {ix, iy, -w}, {ox, oy, -w}, {ox, oy, 0}}};
  return {{{ox, oy, 0}, {ox, oy, w}, {ix, iy, w}, {ix, iy, 0}}};
}

// Consecutive patches share a row: 3k + 1 rows make k patches in each of the symmetric parts.
template <typename Section>
std::vector<Patch> make_patches(std::span<const Section> sections, int part_count,
                                Row (*make_row)(const Section&, int part)) {
  std::vector<Patch> patches;
  for (size_t first = 0; first + 3 < sections.size(); first += 3) {
    for (int part = 0; part < part_count; ++part) {
      Patch& patch = patches.emplace_back();
      for (size_t row = 0; row < 4; ++row) patch[row] = make_row(sections[first + row], part);
    }
  }
  return patches;
}

// Where a vertex lies between two ends; going the other way swaps s and t exactly.
struct Step {
  double s, t;  // s + t = 1
};

Step make_step(int index, int count) {
  return {static_cast<double>(count - index) / count, static_cast<double>(index) / count};
}

using Weights = std::array<double, 4>;

Weights bernstein(Step at) {
  const auto [s, t] = at;
  return {s * s * s, 3 * s * s * t, 3 * t * t * s, t * t * t};
}

Weights bernstein_derivative(Step at) {
  const auto [s, t] = at;
  return {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
}

// Added in pairs from both ends, so that mirrored control points give mirrored sums to the bit.
Vector blend(const Row& points, const Weights& weights) {
  return (weights[0] * points[0] + weights[3] * points[3]) +
         (weights[1] * points[1] + weights[2] * points[2]);
}

Vector blend(const Patch& patch, const Weights& along, const Weights& around) {
  Row column;
  for (size_t i = 0; i < 4; ++i) column[i] = blend(patch[i], around);
  return blend(column, along);
}

// Unit length. Where a row shrinks to a point the direction around it is taken from beside it.
Vector normal(const Patch& patch, Step u, Step v) {
  const Vector du = blend(patch, bernstein_derivative(u), bernstein(v));
  Vector dv = blend(patch, bernstein(u), bernstein_derivative(v));
  if (length(dv) < 1e-9 * length(du)) {
    const Vector mixed = blend(patch, bernstein_derivative(u), bernstein_derivative(v));
    dv = u.t == 0 ? mixed : -mixed;
  }
  const Vector outward = cross(du, dv);
  return (1 / length(outward)) * outward;
}

// Within a group, vertices are rounded before they are compared: patches that meet share them.
class Mesh {
 public:
  using Rounded = std::array<std::int64_t, 3>;
  static constexpr double position_scale = 1e5, normal_scale = 1e4;

  int add_vertex(const Vector& position, const Vector& normal) {
    const auto [vertex, is_new] =
        indices_.try_emplace(round(position, position_scale), static_cast<int>(positions_.size()));
    if (is_new) {
      positions_.push_back(vertex->first);
      normals_.push_back(round(normal, normal_scale));
    }
    return vertex->second;
  }

  void start_group(const std::string& name) {
    indices_.clear();
    faces_ += "g " + name + '\n';
  }

  // A triangle with two corners in one vertex has no area and is left out.
  void add_triangle(int a, int b, int c) {
    if (a == b || b == c || c == a) return;
    faces_ += 'f';
    for (const int vertex : {a, b, c}) {
      const std::string index = std::to_string(vertex + 1);
      faces_ += ' ' + index + "//" + index;
    }
    faces_ += '\n';
  }

  void write(std::ostream& out) const {
    for (const Rounded& position : positions_) out << line("v", position, position_scale, 5);
    for (const Rounded& normal : normals_) out << line("vn", normal, normal_scale, 4);
    out << faces_;
  }

 private:
  static Rounded round(const Vector& a, double scale) {
    return {std::llround(a.x * scale), std::llround(a.y * scale), std::llround(a.z * scale)};
  }

  static std::string line(const char* keyword, const Rounded& a, double scale, int digits) {
    const auto coordinate = [&](int axis) { return static_cast<double>(a[axis]) / scale; };
    char text[100];
    std::snprintf(text, sizeof text, "%s %.*f %.*f %.*f\n", keyword, digits, coordinate(0), digits,
                  coordinate(1), digits, coordinate(2));
    return text;
  }

  std::map<Rounded, int> indices_;
  std::vector<Rounded> positions_, normals_;
  std::string faces_;
};

constexpr int steps_along = 10, steps_around = 12;

void tessellate(const Patch& patch, Mesh& mesh) {
  std::array<std::array<int, steps_around + 1>, steps_along + 1> grid;
  for (int i = 0; i <= steps_along; ++i) {
    for (int j = 0; j <= steps_around; ++j) {
      const Step u = make_step(i, steps_along), v = make_step(j, steps_around);
      grid[i][j] = mesh.add_vertex(blend(patch, bernstein(u), bernstein(v)), normal(patch, u, v));
    }
  }
  for (int i = 0; i < steps_along; ++i) {
    for (int j = 0; j < steps_around; ++j) {
      mesh.add_triangle(grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]);
      mesh.add_triangle(grid[i][j], grid[i + 1][j + 1], grid[i][j + 1]);
    }
  }
}

void add_part(const std::string& name, const std::vector<Patch>& patches, Mesh& mesh) {
  mesh.start_group(name);
  for (const Patch& patch : patches) tessellate(patch, mesh);
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::cerr << "usage: make_teapot OUT.obj\n";
    return 2;
  }
  Mesh mesh;
  add_part("lid", make_patches<Ring>(lid_rings, 4, quarter_circle), mesh);
  add_part("body", make_patches<Ring>(body_rings, 4, quarter_circle), mesh);
  add_part("handle", make_patches<Arc>(handle_arcs, 2, half_tube), mesh);
  add_part("spout", make_patches<Arc>(spout_arcs, 2, half_tube), mesh);

  std::ofstream file(arguments[1], std::ios::binary);
  file << "# Utah teapot, made by make_teapot from Newell's control points: see README.md\n";
  mesh.write(file);
  if (!file.flush()) {
    std::cerr << arguments[1] << ": cannot be written\n";
    return 1;
  }
}
