// SPDX-License-Identifier: MIT
#include "tracer/base/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <span>

#include <sys/mman.h>
#include <unistd.h>

#include "tracer/base/huge_pages.h"
#include "tracer/base/open_file.h"
#include "tracer/base/parallel.h"

namespace tracer {
namespace {

constexpr size_t piece_bytes = size_t{1} << 23;

/// The bytes from `offset` on, until `to` is full.
void read_piece(const Descriptor& file, const std::string& name, std::span<char> to,
                size_t offset) {
  while (!to.empty()) {
    const ssize_t count = pread(file.get(), to.data(), to.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(name, std::strerror(errno));
    if (count == 0) fail_to_read(name, file_changed);
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
  const std::string name = path.string();
  const Descriptor file = open_regular_file(path);
  const struct stat before = status_of(file, name);
  if (before.st_size == 0) return;

  const auto size = static_cast<size_t>(before.st_size);
  void* address = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (address == MAP_FAILED) fail_to_read(name, std::strerror(errno));
  pages_.data = static_cast<char*>(address);
  pages_.size = size;
  prefer_huge_pages(address, size);

  const std::span<char> bytes(pages_.data, size);
  const size_t piece_count = (size + piece_bytes - 1) / piece_bytes;
  std::atomic<size_t> done{0};
  parallel_in_order(piece_count, [&](size_t i) {
    progress.throw_if_stopped();
    const size_t begin = i * piece_bytes;
    read_piece(file, name, bytes.subspan(begin, std::min(piece_bytes, size - begin)), begin);
    progress.set_fraction(static_cast<double>(++done) / static_cast<double>(piece_count));
  });
  if (!is_unchanged(before, status_of(file, name))) fail_to_read(name, file_changed);
}

}  // namespace tracer
