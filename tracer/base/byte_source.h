// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tracer/base/progress.h"

namespace tracer {

/// Bytes in order, wherever they come from.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Fills the front of `to` and returns how much of it: all, unless the bytes end. Throws
  /// LoadError in words for the user, and Cancelled.
  virtual size_t read(std::span<char> to) = 0;
  /// Part of everything that has been read, 0 to 1; 0 where the end is not known.
  virtual double fraction() const = 0;
  /// Bytes taken so far from the file, or from what else there is.
  virtual uint64_t bytes_taken() const = 0;
};

/// Bytes that are in memory, and stay there as long as this is used.
class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
  size_t read(std::span<char> to) override {
    const size_t count = std::min(to.size(), bytes_.size() - taken_);
    if (count > 0) std::memcpy(to.data(), bytes_.data() + taken_, count);
    taken_ += count;
    return count;
  }
  double fraction() const override {
    return bytes_.empty() ? 1 : static_cast<double>(taken_) / static_cast<double>(bytes_.size());
  }
  uint64_t bytes_taken() const override { return taken_; }

 private:
  std::string_view bytes_;
  size_t taken_ = 0;
};

/// Whether the path, "-", stands for standard input, which can be read only once.
bool is_standard_input(const std::filesystem::path& path);
/// How messages call the file at `path`.
std::string name_of_input(const std::filesystem::path& path);
/// The same without the folder.
std::string short_name_of_input(const std::filesystem::path& path);

/// A regular file, or standard input for the path "-"; what gzip or zstd packed is unpacked,
/// whatever its name. Waiting for standard input ends when `progress` is asked to stop. Throws
/// LoadError.
std::unique_ptr<ByteSource> open_byte_source(const std::filesystem::path& path,
                                             const Progress& progress);

}  // namespace tracer
