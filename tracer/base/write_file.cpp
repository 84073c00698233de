// SPDX-License-Identifier: MIT
#include "tracer/base/write_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <unistd.h>

#include "tracer/base/error.h"

namespace tracer {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw LoadError({.path = path.string(), .what = "cannot write: " + why});
}

/// The file that is replaced. A link stays a link: what it points to is replaced.
fs::path find_target(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, "it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "it is not a regular file");
  const fs::path target =
      fs::is_symlink(fs::symlink_status(path, error)) ? fs::canonical(path, error) : path;
  return target.empty() ? path : target;
}

}  // namespace

void check_writable(const fs::path& path) {
  const fs::path target = find_target(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) fail(path, "there is no folder " + folder.string());
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    fail(path, "folder " + folder.string() + ": " + std::strerror(errno));
  }
}

void write_file(const fs::path& path, std::string_view bytes) {
  const fs::path target = find_target(path);
  std::error_code error;
  const fs::path part = target.string() + "." + std::to_string(getpid()) + ".part";
  errno = 0;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  if (out) out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    const std::string why = errno != 0 ? std::strerror(errno) : "writing failed";
    fs::remove(part, error);
    fail(path, why);
  }
  fs::rename(part, target, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(part, error);
    fail(path, why);
  }
}

}  // namespace tracer
