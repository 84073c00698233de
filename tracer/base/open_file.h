// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include <sys/stat.h>

namespace tracer {

inline constexpr const char* file_changed = "the file changed while it was read";

/// An open file of the system's, closed in the end.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Opens a regular file for reading. Throws LoadError in words for the user when it is missing, a
/// directory, no regular file, or unreadable.
Descriptor open_regular_file(const std::filesystem::path& path);

/// Throws LoadError in the name of `name`.
struct stat status_of(const Descriptor& file, const std::string& name);

/// Whether nobody wrote to the file between the two.
bool is_unchanged(const struct stat& before, const struct stat& after);

[[noreturn]] void fail_to_read(const std::string& name, const char* what);

}  // namespace tracer
