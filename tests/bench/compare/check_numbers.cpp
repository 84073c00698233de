// SPDX-License-Identifier: MIT
#include "tests/bench/compare/check_numbers.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace bench {
namespace {

constexpr uint64_t most_triangles = 1'000'000 / 9;

/// Where each vertex and each face stands in the text, after its keyword.
struct Places {
  std::vector<size_t> vertices;
  std::vector<size_t> faces;
};

Places find_places(const std::string& text) {
  Places places;
  for (size_t line = 0; line < text.size();) {
    if (text.compare(line, 2, "v ") == 0) places.vertices.push_back(line + 2);
    if (text.compare(line, 2, "f ") == 0) places.faces.push_back(line + 2);
    const size_t end = text.find('\n', line);
    line = end == text.npos ? text.size() : end + 1;
  }
  return places;
}

/// The indices, from 1, of the vertices of a face "1/2/3 4 5//6".
void read_corners(const char* at, unsigned long (&corners)[3]) {
  for (unsigned long& corner : corners) {
    char* end = nullptr;
    corner = std::strtoul(at, &end, 10);
    for (at = end; *at != ' ' && *at != '\n' && *at != '\0';) ++at;
  }
}

float expected(const char* text, char** end, double origin) {
  if (origin == 0) return std::strtof(text, end);
  return static_cast<float>(std::strtod(text, end) - origin);
}

bool are_same_bits(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

// -0 and 0 are the same place; what an origin is subtracted from has one zero.
bool is_right(float value, float wanted, double origin) {
  return are_same_bits(value, wanted) || (origin != 0 && value == 0 && wanted == 0);
}

}  // namespace

NumberCheck check_numbers(const std::filesystem::path& path, const LoadedModel& model) {
  std::string text(std::filesystem::file_size(path), '\0');
  std::ifstream(path, std::ios::binary)
      .read(text.data(), static_cast<std::streamsize>(text.size()));
  const Places places = find_places(text);
  NumberCheck check;
  const uint64_t step = std::max<uint64_t>(1, places.faces.size() / most_triangles);
  for (uint64_t face = 0; face < std::min<uint64_t>(places.faces.size(), model.triangle_count);
       face += step) {
    unsigned long corners[3];
    read_corners(text.data() + places.faces[face], corners);
    for (int i = 0; i < 3; ++i) {
      const tracer::Vec3f position = model.corner(face, i);
      const char* at = text.data() + places.vertices.at(corners[i] - 1);
      for (int axis = 0; axis < 3; ++axis) {
        char* end = nullptr;
        const float wanted = expected(at, &end, model.origin[axis]);
        at = end;
        ++check.checked;
        if (!is_right(position[axis], wanted, model.origin[axis])) ++check.wrong;
      }
    }
  }
  return check;
}

}  // namespace bench
