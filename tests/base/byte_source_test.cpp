// SPDX-License-Identifier: MIT
#include "tracer/base/byte_source.h"

#include <cstdlib>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"

namespace tracer {
namespace {

std::string text_of(size_t size) {
  std::string text(size, '\0');
  for (size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * 7 + i / 251 + i / 70'001);
  return text;
}

std::string gzip(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

std::string zstd(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  packed.resize(ZSTD_compress2(context, packed.data(), packed.size(), text.data(), text.size()));
  ZSTD_freeCCtx(context);
  return packed;
}

std::string read_all(ByteSource& source, size_t piece_size = 100'000) {
  std::string all;
  std::string piece(piece_size, '\0');
  for (;;) {
    const size_t count = source.read(piece);
    all.append(piece, 0, count);
    if (count < piece.size()) return all;
  }
}

std::string read_path(const std::filesystem::path& path) {
  Progress progress;
  return read_all(*open_byte_source(path, progress));
}

std::string error_of(const std::filesystem::path& path) {
  try {
    read_path(path);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ByteSource, gives_every_byte_of_a_file_of_any_size) {
  const TemporaryFolder folder;
  for (const size_t size : {0, 1, 3, 4, 5, 100'000, 3'000'001}) {
    const std::string text = text_of(size);
    EXPECT_TRUE(read_path(folder.write("x", text)) == text) << size;
  }
}

TEST(ByteSource, unpacks_gzip_and_zstd_whatever_the_name_and_however_many_members) {
  const TemporaryFolder folder;
  const std::string text = text_of(1'000'003);
  EXPECT_TRUE(read_path(folder.write("a.obj.gz", gzip(text))) == text);
  EXPECT_TRUE(read_path(folder.write("a.obj.zst", zstd(text))) == text);
  EXPECT_TRUE(read_path(folder.write("x", gzip(text) + gzip("") + gzip("b"))) == text + "b");
  EXPECT_TRUE(read_path(folder.write("x", zstd(text) + zstd("") + zstd("b"))) == text + "b");
  EXPECT_EQ(read_path(folder.write("x", gzip(""))), "");
}

TEST(ByteSource, pieces_of_any_size_give_the_same_bytes) {
  const std::string text = text_of(10'007);
  const TemporaryFolder folder;
  for (const std::string& bytes : {text, gzip(text), zstd(text)}) {
    const auto path = folder.write("x", bytes);
    for (const size_t piece : {1, 2, 3, 5, 1000}) {
      Progress progress;
      EXPECT_TRUE(read_all(*open_byte_source(path, progress), piece) == text) << piece;
    }
  }
}

TEST(ByteSource, damaged_and_cut_data_is_told) {
  const TemporaryFolder folder;
  const std::string text = text_of(300'000);
  const struct {
    const char* name;
    std::string packed;
  } formats[] = {{"gzip", gzip(text)}, {"zstd", zstd(text)}};
  for (const auto& [name, packed] : formats) {
    for (const size_t size : {packed.size() - 1, packed.size() / 2, size_t{5}}) {
      const auto path = folder.write("x", packed.substr(0, size));
      EXPECT_EQ(error_of(path), path.string() + ": the " + name + " data ends early");
    }
    std::string damaged = packed;
    for (size_t i = 20; i < 60; ++i) damaged[i] = static_cast<char>(~damaged[i]);
    const auto path = folder.write("x", damaged);
    EXPECT_EQ(error_of(path), path.string() + ": the " + name + " data is damaged");
  }
}

TEST(ByteSource, a_file_that_changes_while_it_is_read_is_told) {
  const TemporaryFolder folder;
  const std::string text = text_of(400'000);
  for (const size_t new_size : {size_t{1000}, size_t{150'000}, size_t{500'000}}) {
    const auto path = folder.write("x", text);
    Progress progress;
    const auto source = open_byte_source(path, progress);
    std::string piece(100'000, '\0');
    EXPECT_EQ(source->read(piece), piece.size());
    std::filesystem::resize_file(path, new_size);
    try {
      read_all(*source);
      ADD_FAILURE() << new_size;
    } catch (const LoadError& error) {
      EXPECT_EQ(error.what(), path.string() + ": the file changed while it was read");
    }
  }
}

TEST(ByteSource, a_file_that_is_removed_while_it_is_read_is_read_whole) {
  const TemporaryFolder folder;
  const std::string text = text_of(400'000);
  const auto path = folder.write("x", text);
  Progress progress;
  const auto source = open_byte_source(path, progress);
  std::filesystem::remove(path);
  EXPECT_TRUE(read_all(*source) == text);
}

TEST(ByteSource, what_is_no_file_is_told_in_words) {
  const TemporaryFolder folder;
  const std::string fifo = folder / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(error_of(fifo), fifo + ": this is not a regular file");
  EXPECT_EQ(error_of("/dev/zero"), "/dev/zero: this is not a regular file");
  EXPECT_EQ(error_of(folder.path()), folder.path().string() + ": this is a directory, not a file");
  EXPECT_EQ(error_of(folder / "none"), (folder / "none") + ": No such file or directory");
}

/// Puts a pipe in the place of standard input while it lives.
class PipedInput {
 public:
  PipedInput() : saved_(dup(STDIN_FILENO)) {
    EXPECT_EQ(pipe(ends_), 0);
    dup2(ends_[0], STDIN_FILENO);
  }
  ~PipedInput() {
    dup2(saved_, STDIN_FILENO);
    close(saved_);
    close(ends_[0]);
    close_writer();
  }
  PipedInput(const PipedInput&) = delete;
  PipedInput& operator=(const PipedInput&) = delete;

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(ends_[1], text.data(), text.size());
      ASSERT_GT(count, 0);
      text.remove_prefix(static_cast<size_t>(count));
    }
  }
  void close_writer() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int saved_;
  int ends_[2] = {-1, -1};
};

TEST(ByteSource, a_dash_is_standard_input_packed_or_not) {
  const std::string text = text_of(300'000);
  for (const std::string& bytes : {text, gzip(text), zstd(text)}) {
    PipedInput input;
    std::thread writer([&] {
      input.write(bytes);
      input.close_writer();
    });
    EXPECT_TRUE(read_path("-") == text);
    writer.join();
  }
}

TEST(ByteSource, waiting_for_standard_input_ends_with_a_stop) {
  const PipedInput input;
  input.write("v 0 0 0\n");
  Progress progress;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.request_stop();
  });
  EXPECT_THROW(read_all(*open_byte_source("-", progress)), Cancelled);
  stopper.join();
}

}  // namespace
}  // namespace tracer
