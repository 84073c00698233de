// SPDX-License-Identifier: MIT
#include "tests/support/read_pfm.h"

#include <fstream>
#include <string>

namespace tests {

Pfm read_pfm(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  Pfm picture;
  double scale = 0;
  file >> magic >> picture.size_px.x >> picture.size_px.y >> scale;
  file.get();
  if (!file || magic != "PF" || scale != -1.0) return {};
  const auto width = static_cast<size_t>(picture.size_px.x);
  picture.pixels.resize(width * picture.size_px.y);
  for (int y = picture.size_px.y - 1; y >= 0; --y) {
    file.read(reinterpret_cast<char*>(&picture.pixels[y * width]),
              static_cast<std::streamsize>(width * sizeof(tracer::Vec3f)));
  }
  return file && file.peek() == EOF ? picture : Pfm{};
}

}  // namespace tests
