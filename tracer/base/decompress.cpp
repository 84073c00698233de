// SPDX-License-Identifier: MIT
#include "tracer/base/decompress.h"

#include <new>
#include <vector>

#include <zlib.h>
#include <zstd.h>

#include "tracer/base/error.h"

namespace tracer {
namespace {

constexpr size_t input_bytes = size_t{1} << 17;

/// What both formats share: `Decoder::decode` takes some of the input, fills some of the output,
/// and says whether a member ended there.
template <class Decoder>
class UnpackedSource : public ByteSource {
 public:
  UnpackedSource(std::unique_ptr<ByteSource> packed, const std::string& name)
      : packed_(std::move(packed)), name_(name), input_(input_bytes) {}

  size_t read(std::span<char> to) override {
    std::span<char> rest = to;
    while (!rest.empty()) {
      if (left_.empty()) refill();
      if (left_.empty() && is_between_members_) break;
      const size_t rest_before = rest.size();
      is_between_members_ = decoder_.decode(left_, rest, name_);
      if (left_.empty() && is_at_end_ && rest.size() == rest_before && !is_between_members_) {
        throw LoadError({name_, 0, std::string("the ") + Decoder::name + " data ends early"});
      }
    }
    return to.size() - rest.size();
  }
  double fraction() const override { return packed_->fraction(); }
  uint64_t bytes_taken() const override { return packed_->bytes_taken(); }

 private:
  void refill() {
    if (is_at_end_) return;
    const size_t count = packed_->read(input_);
    is_at_end_ = count < input_.size();
    left_ = std::span<const char>(input_).first(count);
  }

  std::unique_ptr<ByteSource> packed_;
  const std::string name_;
  std::vector<char> input_;
  std::span<const char> left_;
  bool is_at_end_ = false;
  bool is_between_members_ = true;
  Decoder decoder_;
};

[[noreturn]] void fail_damaged(const std::string& name, const char* format) {
  throw LoadError({name, 0, std::string("the ") + format + " data is damaged"});
}

class GzipDecoder {
 public:
  static constexpr const char* name = "gzip";

  GzipDecoder() {
    constexpr int gzip_only = 16;
    if (inflateInit2(&stream_, MAX_WBITS + gzip_only) != Z_OK) throw std::bad_alloc();
  }
  ~GzipDecoder() { inflateEnd(&stream_); }
  GzipDecoder(const GzipDecoder&) = delete;
  GzipDecoder& operator=(const GzipDecoder&) = delete;

  bool decode(std::span<const char>& input, std::span<char>& output, const std::string& path) {
    constexpr size_t most = size_t{1} << 30;  // what zlib's counters hold
    const size_t input_size = std::min(input.size(), most);
    const size_t output_size = std::min(output.size(), most);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(input.data()));
    stream_.avail_in = static_cast<uInt>(input_size);
    stream_.next_out = reinterpret_cast<Bytef*>(output.data());
    stream_.avail_out = static_cast<uInt>(output_size);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) {
      fail_damaged(path, name);
    }
    input = input.subspan(input_size - stream_.avail_in);
    output = output.subspan(output_size - stream_.avail_out);
    if (result == Z_STREAM_END) inflateReset(&stream_);
    return result == Z_STREAM_END;
  }

 private:
  z_stream stream_{};
};

class ZstdDecoder {
 public:
  static constexpr const char* name = "zstd";

  ZstdDecoder() : stream_(ZSTD_createDStream()) {
    if (!stream_) throw std::bad_alloc();
  }

  bool decode(std::span<const char>& input, std::span<char>& output, const std::string& path) {
    ZSTD_inBuffer in{input.data(), input.size(), 0};
    ZSTD_outBuffer out{output.data(), output.size(), 0};
    const size_t result = ZSTD_decompressStream(stream_.get(), &out, &in);
    if (ZSTD_isError(result)) fail_damaged(path, name);
    input = input.subspan(in.pos);
    output = output.subspan(out.pos);
    return result == 0;
  }

 private:
  struct Free {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };
  std::unique_ptr<ZSTD_DStream, Free> stream_;
};

}  // namespace

Packing packing_of(std::string_view first_bytes) {
  if (first_bytes.starts_with("\x1f\x8b")) return Packing::gzip;
  if (first_bytes.starts_with("\x28\xb5\x2f\xfd")) return Packing::zstd;
  return Packing::none;
}

std::unique_ptr<ByteSource> unpack(Packing packing, std::unique_ptr<ByteSource> packed,
                                   const std::string& name) {
  switch (packing) {
    case Packing::gzip:
      return std::make_unique<UnpackedSource<GzipDecoder>>(std::move(packed), name);
    case Packing::zstd:
      return std::make_unique<UnpackedSource<ZstdDecoder>>(std::move(packed), name);
    default:
      return packed;
  }
}

}  // namespace tracer
