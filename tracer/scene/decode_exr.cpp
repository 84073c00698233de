// SPDX-License-Identifier: MIT
#include "tracer/scene/decode_exr.h"

#include <cstring>
#include <stdexcept>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>

namespace tracer {
namespace {

/// Bytes in memory, as OpenEXR reads them.
class ByteStream : public Imf::IStream {
 public:
  explicit ByteStream(std::string_view bytes) : Imf::IStream("image"), bytes_(bytes) {}

  bool read(char out[], int count) override {
    const auto wanted = static_cast<size_t>(std::max(count, 0));
    if (place_ > bytes_.size() || wanted > bytes_.size() - place_) {
      throw std::runtime_error("the file ends early");
    }
    std::memcpy(out, bytes_.data() + place_, wanted);
    place_ += wanted;
    return place_ < bytes_.size();
  }
  uint64_t tellg() override { return place_; }
  void seekg(uint64_t place) override { place_ = place; }

 private:
  std::string_view bytes_;
  uint64_t place_ = 0;
};

/// The channels to read, in a texture's order.
std::vector<const char*> channels_of(const Imf::Header& header) {
  const auto has = [&](const char* name) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    return channel && channel->xSampling == 1 && channel->ySampling == 1;
  };
  if (has("R") && has("G") && has("B")) {
    return has("A") ? std::vector{"R", "G", "B", "A"} : std::vector{"R", "G", "B"};
  }
  if (has("Y")) return {"Y"};
  throw std::runtime_error("neither R, G, B nor Y among its channels");
}

// No compression makes more than some thousand texels of a byte; headers may promise anything.
void check_size(int64_t width, int64_t height, size_t byte_count) {
  if (width < 1 || height < 1) throw std::runtime_error("the image has no pixels");
  if (width > max_texels / height) throw std::runtime_error("the image has too many pixels");
  if (width * height > 4096 * static_cast<int64_t>(byte_count)) {
    throw std::runtime_error("the file ends early");
  }
}

}  // namespace

bool is_exr(std::string_view bytes) {
  return bytes.starts_with("\x76\x2f\x31\x01");
}

Texture decode_exr(std::string_view bytes) {
  ByteStream stream(bytes);
  Imf::InputFile file(stream);
  const auto& window = file.header().dataWindow();
  check_size(int64_t{window.max.x} - window.min.x + 1, int64_t{window.max.y} - window.min.y + 1,
             bytes.size());
  const std::vector<const char*> channels = channels_of(file.header());

  Texture texture;
  texture.width = window.max.x - window.min.x + 1;
  texture.height = window.max.y - window.min.y + 1;
  texture.channel_count = static_cast<int>(channels.size());
  texture.encoding = TexelEncoding::linear;
  texture.values.resize(static_cast<size_t>(texture.width) * texture.height * channels.size());
  const size_t texel_bytes = channels.size() * sizeof(float);
  Imf::FrameBuffer frame;
  for (size_t i = 0; i < channels.size(); ++i) {
    char* first = reinterpret_cast<char*>(texture.values.data() + i);
    frame.insert(channels[i], Imf::Slice::Make(Imf::FLOAT, first, window, texel_bytes,
                                               texel_bytes * static_cast<size_t>(texture.width)));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return texture;
}

}  // namespace tracer
