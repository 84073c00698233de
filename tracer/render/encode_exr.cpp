// SPDX-License-Identifier: MIT
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "tracer/render/image_formats.h"

namespace tracer {

std::string encode_exr(const Image& image, double /*exposure*/, const Metadata& metadata) {
  Imf::Header header(image.size_px.x, image.size_px.y);
  for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer frame;
  // The library reads only; its interface has no const.
  char* base = reinterpret_cast<char*>(const_cast<Vec3f*>(image.pixels.data()));
  const char* names[3] = {"R", "G", "B"};
  for (size_t i = 0; i < 3; ++i) {
    header.channels().insert(names[i], Imf::Channel(Imf::FLOAT));
    frame.insert(names[i], Imf::Slice(Imf::FLOAT, base + i * sizeof(float), sizeof(Vec3f),
                                      sizeof(Vec3f) * static_cast<size_t>(image.size_px.x)));
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
