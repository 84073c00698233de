// SPDX-License-Identifier: MIT
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "tracer/render/image_formats.h"

namespace tracer {

namespace {

/// A channel of interleaved values, each `channel_count` beyond the one before.
struct Channel {
  Imf::PixelType type;
  const void* first;  // four bytes each
  size_t channel_count;
};

void insert(const std::string& name, const Channel& channel, int width, Imf::Header& header,
            Imf::FrameBuffer& frame) {
  const size_t stride = 4 * channel.channel_count;
  // The library reads only; its interface has no const.
  auto* base = const_cast<char*>(static_cast<const char*>(channel.first));
  header.channels().insert(name, Imf::Channel(channel.type));
  frame.insert(name, Imf::Slice(channel.type, base, stride, stride * static_cast<size_t>(width)));
}

Channel channel_of(const ImageLayer& layer, size_t index) {
  const size_t count = layer.channels.size();
  if (const auto* whole = std::get_if<std::vector<uint32_t>>(&layer.values)) {
    return {Imf::UINT, whole->data() + index, count};
  }
  return {Imf::FLOAT, std::get<std::vector<float>>(layer.values).data() + index, count};
}

}  // namespace

std::string encode_exr(const Image& image, const Metadata& metadata,
                       std::span<const ImageLayer> layers) {
  Imf::Header header(image.size_px.x, image.size_px.y);
  for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer frame;
  const auto* values = reinterpret_cast<const float*>(image.pixels.data());
  const char* names[3] = {"R", "G", "B"};
  for (size_t i = 0; i < 3; ++i) {
    insert(names[i], {Imf::FLOAT, values + i, 3}, image.size_px.x, header, frame);
  }
  for (const ImageLayer& layer : layers) {
    for (size_t i = 0; i < layer.channels.size(); ++i) {
      insert(layer.name + '.' + layer.channels[i], channel_of(layer, i), image.size_px.x, header,
             frame);
    }
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.size_px.y);
  }
  return stream.str();
}

}  // namespace tracer
