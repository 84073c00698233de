// SPDX-License-Identifier: MIT
#include "tracer/base/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <span>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tracer/base/error.h"
#include "tracer/base/huge_pages.h"
#include "tracer/base/parallel.h"

namespace tracer {
namespace {

constexpr size_t piece_bytes = size_t{1} << 23;

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw LoadError({path.string(), 0, what});
}

struct stat status_of(const Descriptor& file, const std::filesystem::path& path) {
  struct stat status;
  if (fstat(file.get(), &status) != 0) fail(path, std::strerror(errno));
  return status;
}

bool is_same(const struct stat& before, const struct stat& after) {
  return before.st_size == after.st_size && before.st_mtim.tv_sec == after.st_mtim.tv_sec &&
         before.st_mtim.tv_nsec == after.st_mtim.tv_nsec;
}

constexpr const char* changed = "the file changed while it was read";

/// The bytes from `offset` on, until `to` is full.
void read_piece(const Descriptor& file, const std::filesystem::path& path, std::span<char> to,
                size_t offset) {
  while (!to.empty()) {
    const ssize_t count = pread(file.get(), to.data(), to.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, std::strerror(errno));
    if (count == 0) fail(path, changed);
    to = to.subspan(static_cast<size_t>(count));
    offset += static_cast<size_t>(count);
  }
}

}  // namespace

FileBytes::Pages::~Pages() {
  if (data) munmap(data, size);
}

FileBytes::FileBytes(const std::filesystem::path& path) {
  Progress unwatched;
  read(path, unwatched);
}

FileBytes::FileBytes(const std::filesystem::path& path, Progress& progress) {
  read(path, progress);
}

void FileBytes::read(const std::filesystem::path& path, Progress& progress) {
  // O_NONBLOCK: opening a FIFO must not wait for its writer.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) fail(path, std::strerror(errno));
  const struct stat before = status_of(file, path);
  if (S_ISDIR(before.st_mode)) fail(path, "this is a directory, not a file");
  if (!S_ISREG(before.st_mode)) fail(path, "this is not a regular file");
  if (before.st_size == 0) return;

  const auto size = static_cast<size_t>(before.st_size);
  void* address = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (address == MAP_FAILED) fail(path, std::strerror(errno));
  pages_.data = static_cast<char*>(address);
  pages_.size = size;
  prefer_huge_pages(address, size);

  const std::span<char> bytes(pages_.data, size);
  const size_t piece_count = (size + piece_bytes - 1) / piece_bytes;
  std::atomic<size_t> done{0};
  parallel_in_order(piece_count, [&](size_t i) {
    progress.throw_if_stopped();
    const size_t begin = i * piece_bytes;
    read_piece(file, path, bytes.subspan(begin, std::min(piece_bytes, size - begin)), begin);
    progress.set_fraction(static_cast<double>(++done) / static_cast<double>(piece_count));
  });
  if (!is_same(before, status_of(file, path))) fail(path, changed);
}

}  // namespace tracer
