// SPDX-License-Identifier: MIT
#include "tracer/base/byte_source.h"

#include <cerrno>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "tracer/base/decompress.h"
#include "tracer/base/error.h"
#include "tracer/base/open_file.h"

namespace tracer {
namespace {

constexpr const char* standard_input = "-";
constexpr int milliseconds_between_looks = 20;

/// Reads until `to` is full or nothing is left; `wait` is called before each read.
template <class Wait>
size_t read_fully(const Descriptor& file, const std::string& name, std::span<char> to,
                  Wait&& wait) {
  size_t filled = 0;
  while (filled < to.size()) {
    wait();
    const ssize_t count = read(file.get(), to.data() + filled, to.size() - filled);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) fail_to_read(name, std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<size_t>(count);
  }
  return filled;
}

/// Read in order, not mapped: a mapped file that shrinks would end the program with SIGBUS.
class FileSource : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path)
      : name_(path.string()), file_(open_regular_file(path)), before_(status_of(file_, name_)) {
    posix_fadvise(file_.get(), 0, 0, POSIX_FADV_SEQUENTIAL);
  }

  size_t read(std::span<char> to) override {
    const size_t count = read_fully(file_, name_, to, [] {});
    taken_ += count;
    if (count < to.size()) check_end();
    return count;
  }
  double fraction() const override {
    const auto size = static_cast<double>(before_.st_size);
    return size > 0 ? std::min(static_cast<double>(taken_) / size, 1.0) : 1;
  }
  uint64_t bytes_taken() const override { return taken_; }

 private:
  void check_end() const {
    const bool is_whole = taken_ == static_cast<uint64_t>(before_.st_size);
    if (!is_whole || !is_unchanged(before_, status_of(file_, name_))) {
      fail_to_read(name_, file_changed);
    }
  }

  const std::string name_;
  const Descriptor file_;
  const struct stat before_;
  uint64_t taken_ = 0;
};

class StandardInput : public ByteSource {
 public:
  explicit StandardInput(const Progress& progress)
      : name_(name_of_input(standard_input)), file_(dup(STDIN_FILENO)), progress_(progress) {
    if (file_.get() < 0) fail_to_read(name_, std::strerror(errno));
    if (isatty(file_.get())) fail_to_read(name_, "this is a terminal, not a file or a pipe");
  }

  size_t read(std::span<char> to) override {
    const size_t count = read_fully(file_, name_, to, [this] { wait_for_bytes(); });
    taken_ += count;
    return count;
  }
  double fraction() const override { return 0; }
  uint64_t bytes_taken() const override { return taken_; }

 private:
  void wait_for_bytes() const {
    pollfd wanted{file_.get(), POLLIN, 0};
    while (poll(&wanted, 1, milliseconds_between_looks) == 0) progress_.throw_if_stopped();
  }

  const std::string name_;
  const Descriptor file_;
  const Progress& progress_;
  uint64_t taken_ = 0;
};

/// Another source, whose first bytes were looked at.
class PeekedSource : public ByteSource {
 public:
  explicit PeekedSource(std::unique_ptr<ByteSource> rest) : rest_(std::move(rest)) {
    size_ = rest_->read(first_);
  }

  std::string_view first() const { return {first_, size_}; }
  size_t read(std::span<char> to) override {
    const size_t count = std::min(size_ - taken_, to.size());
    std::memcpy(to.data(), first_ + taken_, count);
    taken_ += count;
    return count + (count < to.size() ? rest_->read(to.subspan(count)) : 0);
  }
  double fraction() const override { return rest_->fraction(); }
  uint64_t bytes_taken() const override { return rest_->bytes_taken(); }

 private:
  std::unique_ptr<ByteSource> rest_;
  char first_[4] = {};
  size_t size_ = 0;
  size_t taken_ = 0;
};

std::unique_ptr<ByteSource> open_as_it_is(const std::filesystem::path& path,
                                          const Progress& progress) {
  if (is_standard_input(path)) return std::make_unique<StandardInput>(progress);
  return std::make_unique<FileSource>(path);
}

}  // namespace

bool is_standard_input(const std::filesystem::path& path) {
  return path == standard_input;
}

std::string name_of_input(const std::filesystem::path& path) {
  return is_standard_input(path) ? "standard input" : path.string();
}

std::string short_name_of_input(const std::filesystem::path& path) {
  return name_of_input(path.filename());
}

std::unique_ptr<ByteSource> open_byte_source(const std::filesystem::path& path,
                                             const Progress& progress) {
  auto bytes = std::make_unique<PeekedSource>(open_as_it_is(path, progress));
  const Packing packing = packing_of(bytes->first());
  return unpack(packing, std::move(bytes), name_of_input(path));
}

}  // namespace tracer
