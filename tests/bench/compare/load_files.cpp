// SPDX-License-Identifier: MIT
#include "tests/bench/compare/load_files.h"

#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/support/large_meshes.h"

namespace bench {
namespace {

using Path = std::filesystem::path;

/// Text that goes to a file a megabyte at a time.
class TextFile {
 public:
  explicit TextFile(const Path& path) : file_(std::fopen(path.c_str(), "w")) {}
  ~TextFile() {
    if (file_ != nullptr) std::fclose(file_);
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    if (text_.size() > (1 << 20)) write();
  }
  void finish() {
    write();
    if (file_ == nullptr || std::fflush(file_) != 0) fail();
  }

 private:
  void write() {
    if (file_ == nullptr || std::fwrite(text_.data(), 1, text_.size(), file_) != text_.size()) {
      fail();
    }
    text_.clear();
  }
  [[noreturn]] static void fail() {
    throw std::runtime_error("the file to be loaded cannot be written; is the disk full?");
  }

  std::FILE* file_;
  fmt::memory_buffer text_;
};

std::optional<Path> find_bunny(const tracer::TemporaryFolder&) {
  const Path path = BOXWOOD_SHARED_DIR "/models/stanford-bunny.obj";
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

template <int cells_a_side, CornerContent content>
std::optional<Path> make_terrain(const tracer::TemporaryFolder& folder) {
  const Path path = folder / fmt::format("terrain{}.obj", cells_a_side);
  write_obj(path, tracer::terrain(cells_a_side, 1), content);
  return path;
}

constexpr LoadFile table[] = {
    {"bunny", "2.4 MB, v and f", true, 4, find_bunny},
    {"12MB", "12 MB, 131,000 triangles of v/vt/vn", true, 4,
     make_terrain<256, CornerContent::positions_texcoords_normals>},
    {"100MB", "100 MB, 1.0 M triangles of v/vt/vn", false, 3,
     make_terrain<710, CornerContent::positions_texcoords_normals>},
    {"400MB", "400 MB, 10 M triangles of v", false, 1,
     make_terrain<2236, CornerContent::positions>},
};

}  // namespace

std::span<const LoadFile> load_files() {
  return table;
}

void write_obj(const Path& path, const tracer::Mesh& mesh, CornerContent content) {
  TextFile file(path);
  for (const tracer::Vec3f& p : mesh.positions) file.add("v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
  const bool has_attributes = content == CornerContent::positions_texcoords_normals;
  if (has_attributes) {
    for (const tracer::Vec3f& p : mesh.positions) {
      file.add("vt {:.6f} {:.6f}\n", 0.5f + 0.5f * p.x, 0.5f + 0.5f * p.z);
    }
    for (const tracer::Vec3f& p : mesh.positions) {
      const tracer::Vec3f normal = glm::normalize(tracer::Vec3f(p.y, 1 + p.x * p.z, -p.y));
      file.add("vn {:.6f} {:.6f} {:.6f}\n", normal.x, normal.y, normal.z);
    }
  }
  for (const tracer::Vec3u& t : mesh.triangles) {
    const tracer::Vec3u i = t + 1u;
    if (has_attributes) {
      file.add("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", i.x, i.y, i.z);
    } else {
      file.add("f {} {} {}\n", i.x, i.y, i.z);
    }
  }
  file.finish();
}

}  // namespace bench
