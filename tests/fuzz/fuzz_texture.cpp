// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <stb_image.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/fuzz/check_obj.h"
#include "tracer/scene/jpeg_tables.h"
#include "tracer/scene/pnm_header.h"
#include "tracer/scene/texture.h"

namespace {

/// A file in memory, which has a path.
class MemoryFile {
 public:
  MemoryFile(const uint8_t* data, size_t size) : descriptor_(memfd_create("texture", 0)) {
    tracer::require(write(descriptor_, data, size) == static_cast<ssize_t>(size), "it is written");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

// stb is asked for no more than the loader asks it for. A header may promise 2^27 pixels, which
// would be the slowest and the most boring of inputs.
bool is_large(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!tracer::has_sound_huffman_tables(bytes) || !tracer::has_sound_pnm_header(bytes))
    return false;
  int width = 0, height = 0, channels = 0;
  return stbi_info_from_memory(data, static_cast<int>(size), &width, &height, &channels) != 0 &&
         int64_t{width} * height > (1 << 18);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (is_large(data, size)) return 0;
  const MemoryFile file(data, size);
  try {
    const tracer::Texture texture = tracer::load_texture(file.path());
    tracer::require(texture.width > 0 && texture.height > 0, "a texture has texels");
    const size_t texel_count = static_cast<size_t>(texture.width) * texture.height;
    tracer::require(texture.codes.size() + texture.values.size() >=
                        texel_count * static_cast<size_t>(texture.channel_count),
                    "there are as many texels as pixels");
    const tracer::Vec4f texel =
        tracer::eval_texture(texture, {0.3, 0.7}, 3, tracer::Wrapping::repeat);
    tracer::require(std::isfinite(texel.x + texel.w), "texels are finite");
  } catch (const tracer::LoadError&) {
  }
  return 0;
}
