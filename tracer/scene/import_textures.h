// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/progress.h"
#include "tracer/scene/texture.h"

namespace tracer {

/// Colours are sRGB where 8-bit; numbers are linear; normals too, and heights become normals.
enum class TextureUse { colors, numbers, normals };

/// The textures of a model, each read once a use.
class TextureImporter {
 public:
  struct Request {
    std::filesystem::path path;
    TextureUse use = TextureUse::colors;
    // Where it is asked for.
    std::string library;
    int64_t line = 0;
    std::string keyword;
  };

  /// An index to ask index_of with, once all are read.
  uint32_t add(Request request);

  /// Reads all of them on all threads. Throws Cancelled.
  void read(Progress& progress, Warnings& warnings);

  /// Of a request in textures(); the checker's for a colour that cannot be read, no_texture for
  /// anything else that cannot.
  uint32_t index_of(uint32_t request) const { return indices_[request]; }
  /// The checker's, which is there from the first call on.
  uint32_t checker();

  std::vector<Texture>& textures() { return textures_; }

 private:
  std::vector<Request> requests_;
  std::unordered_map<std::string, uint32_t> known_;  // by use and path
  std::vector<uint32_t> indices_;
  std::vector<Texture> textures_;
  uint32_t checker_ = no_texture;
};

}  // namespace tracer
