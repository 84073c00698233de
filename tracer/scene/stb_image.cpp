// SPDX-License-Identifier: MIT
// stb_image, with memory that begins as zeros: a damaged JPEG may use tables that it never defined,
// which are then empty instead of indices to anywhere, and is read alike every time.
#include <cstdlib>
#include <cstring>
#include <limits>

#include "tracer/scene/stb_growth.h"

namespace {

constexpr size_t no_limit = std::numeric_limits<size_t>::max();
thread_local size_t most_bytes = no_limit;
thread_local bool is_limit_reached = false;

void* grow_zeroed(void* memory, size_t old_size, size_t size) {
  if (size > most_bytes) {
    is_limit_reached = true;
    return nullptr;
  }
  void* const grown = std::realloc(memory, size);
  if (grown && size > old_size) {
    std::memset(static_cast<char*>(grown) + old_size, 0, size - old_size);
  }
  return grown;
}

}  // namespace

namespace tracer {

StbGrowthLimit::StbGrowthLimit(size_t most) {
  most_bytes = most;
  is_limit_reached = false;
}
StbGrowthLimit::~StbGrowthLimit() {
  most_bytes = no_limit;
}
bool StbGrowthLimit::is_reached() const {
  return is_limit_reached;
}

}  // namespace tracer

#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC_SIZED(memory, old_size, size) grow_zeroed(memory, old_size, size)
#define STBI_FREE(memory) std::free(memory)
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
