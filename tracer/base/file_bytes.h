// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "tracer/base/progress.h"

namespace tracer {

/// A regular file's bytes, read whole into memory of their own: were they mapped, a file that
/// shrinks meanwhile would end the program with SIGBUS. Throws LoadError, in words for the user,
/// when the path is missing, a directory, no regular file, or unreadable, and when the file
/// changes while it is read.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& path);
  /// Sets `progress`'s fraction. Throws Cancelled too.
  FileBytes(const std::filesystem::path& path, Progress& progress);

  std::string_view bytes() const { return {pages_.data, pages_.size}; }

 private:
  /// Let go even where the constructor throws.
  struct Pages {
    Pages() = default;
    ~Pages();
    Pages(const Pages&) = delete;
    Pages& operator=(const Pages&) = delete;

    char* data = nullptr;
    size_t size = 0;
  };

  void read(const std::filesystem::path& path, Progress& progress);

  Pages pages_;
};

}  // namespace tracer
