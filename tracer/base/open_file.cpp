// SPDX-License-Identifier: MIT
#include "tracer/base/open_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "tracer/base/error.h"

namespace tracer {

Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}

void fail_to_read(const std::string& name, const char* what) {
  throw LoadError({name, 0, what});
}

struct stat status_of(const Descriptor& file, const std::string& name) {
  struct stat status;
  if (fstat(file.get(), &status) != 0) fail_to_read(name, std::strerror(errno));
  return status;
}

bool is_unchanged(const struct stat& before, const struct stat& after) {
  return before.st_size == after.st_size && before.st_mtim.tv_sec == after.st_mtim.tv_sec &&
         before.st_mtim.tv_nsec == after.st_mtim.tv_nsec;
}

Descriptor open_regular_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  // O_NONBLOCK: opening a FIFO must not wait for its writer.
  Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) fail_to_read(name, std::strerror(errno));
  const struct stat status = status_of(file, name);
  if (S_ISDIR(status.st_mode)) fail_to_read(name, "this is a directory, not a file");
  if (!S_ISREG(status.st_mode)) fail_to_read(name, "this is not a regular file");
  return file;
}

}  // namespace tracer
