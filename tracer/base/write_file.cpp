// SPDX-License-Identifier: MIT
#include "tracer/base/write_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <unistd.h>

#include "tracer/base/error.h"

namespace tracer {

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  namespace fs = std::filesystem;
  const auto fail = [&](const std::string& why) {
    throw LoadError({.path = path.string(), .what = "cannot write: " + why});
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail("it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail("it is not a regular file");
  // A link stays a link: what it points to is replaced.
  fs::path target =
      fs::is_symlink(fs::symlink_status(path, error)) ? fs::canonical(path, error) : path;
  if (target.empty()) target = path;

  const fs::path part = target.string() + "." + std::to_string(getpid()) + ".part";
  errno = 0;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  if (out) out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    const std::string why = errno != 0 ? std::strerror(errno) : "writing failed";
    fs::remove(part, error);
    fail(why);
  }
  fs::rename(part, target, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(part, error);
    fail(why);
  }
}

}  // namespace tracer
