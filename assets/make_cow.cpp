// SPDX-License-Identifier: MIT
// Writes cow.obj and cow.mtl into the folder it is given.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/cow_shape.h"
#include "assets/outline.h"
#include "assets/polygonise.h"
#include "assets/simplify.h"

namespace assets {
namespace {

constexpr double fine_step = 0.0125;  // metres; an ear is 0.03 thick
constexpr size_t triangle_count = 6000;

PaintedSurface make_cow() {
  const Vec3d lower(cow_lower[0], cow_lower[1], cow_lower[2]);
  const Vec3d upper(cow_upper[0], cow_upper[1], cow_upper[2]);
  Surface fine = polygonise(cow_distance, lower, upper, fine_step);
  relax(fine, cow_distance);
  std::vector<Field> outlines;
  for (const Region& region : cow_regions) outlines.emplace_back(region.distance);
  PaintedSurface cow = simplify(paint(std::move(fine), outlines), triangle_count, cow_importance);
  for (Vec3d& point : cow.points) point = project(cow_distance, point);
  return cow;
}

/// The gradient's direction; the mean of the facets' where they are too coarse to follow it.
std::vector<Vec3d> normals(const PaintedSurface& cow) {
  std::vector<Vec3d> result(cow.points.size(), Vec3d(0.0));
  for (const auto& corners : cow.triangles) {
    const Vec3d& first = cow.points[corners[0]];
    const Vec3d doubled_area =
        glm::cross(cow.points[corners[1]] - first, cow.points[corners[2]] - first);
    for (const uint32_t corner : corners) result[corner] += doubled_area;
  }
  for (size_t i = 0; i < result.size(); ++i) {
    const Vec3d mean = glm::normalize(result[i]);
    const Vec3d smooth = glm::normalize(gradient(cow_distance, cow.points[i]));
    result[i] = glm::dot(mean, smooth) > 0.8 ? smooth : mean;
  }
  return result;
}

/// Four decimals, tenths of a millimetre, with no difference between 0 and -0.
std::string text(const char* keyword, const Vec3d& value) {
  std::string line = keyword;
  for (int axis = 0; axis < 3; ++axis) {
    char number[32];
    std::snprintf(number, sizeof number, " %.4f", value[axis]);
    line += std::string_view(number) == " -0.0000" ? " 0.0000" : number;
  }
  return line + '\n';
}

std::string_view material_name(size_t material) {
  return material == 0 ? cow_hide : cow_regions[material - 1].material;
}

void write_obj(std::ostream& out, const PaintedSurface& cow) {
  out << "# A cow, in metres: y up, facing +x, standing on y = 0. Made by make_cow; MIT licence.\n"
         "mtllib cow.mtl\no cow\n";
  for (const Vec3d& point : cow.points) out << text("v", point);
  for (const Vec3d& normal : normals(cow)) out << text("vn", normal);
  for (size_t material = 0; material <= cow_regions.size(); ++material) {
    out << "usemtl " << material_name(material) << '\n';
    for (size_t i = 0; i < cow.triangles.size(); ++i) {
      if (cow.materials[i] != material) continue;
      out << 'f';
      for (const uint32_t corner : cow.triangles[i]) out << ' ' << corner + 1 << "//" << corner + 1;
      out << '\n';
    }
  }
}

void write_mtl(std::ostream& out) {
  out << "# Colours of cow.obj in linear RGB. Made by make_cow; MIT licence.\n";
  out << "newmtl " << cow_hide << '\n' << text("Kd", cow_hide_color);
  for (const Region& region : cow_regions) {
    out << "newmtl " << region.material << '\n' << text("Kd", region.color);
  }
}

}  // namespace
}  // namespace assets

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::cerr << "usage: make_cow FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::ofstream obj(folder / "cow.obj"), mtl(folder / "cow.mtl");
  assets::write_obj(obj, assets::make_cow());
  assets::write_mtl(mtl);
  if (!obj.flush() || !mtl.flush()) {
    std::cerr << "make_cow: cannot write into " << folder.string() << '\n';
    return 2;
  }
}
