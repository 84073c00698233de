// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <stb_image.h>

#include "tracer/base/error.h"
#include "tracer/base/file_bytes.h"
#include "tracer/scene/environment.h"

namespace tracer {
namespace {

constexpr int64_t max_texels = int64_t{1} << 26;

/// Bytes in memory, as OpenEXR reads them.
class ByteStream : public Imf::IStream {
 public:
  ByteStream(const std::string& name, std::string_view bytes)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

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

class Loader {
 public:
  explicit Loader(const std::filesystem::path& path) : path_(path.string()), file_(path) {}

  LatLongImage load() {
    LatLongImage image = is_exr() ? load_exr() : load_hdr();
    if (image.width != 2 * image.height) {
      fail("an environment map is twice as wide as it is high; this one is " +
           std::to_string(image.width) + " x " + std::to_string(image.height));
    }
    for (Vec3f& texel : image.texels) texel = usable(texel);
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw LoadError({.path = path_, .what = what});
  }

  bool is_exr() const { return file_.bytes().starts_with(std::string_view("\x76\x2f\x31\x01", 4)); }

  void check_size(int64_t width, int64_t height) const {
    if (width < 1 || height < 1) fail("the image has no pixels");
    if (width > max_texels || width * height > max_texels) fail("the image has too many pixels");
  }

  // Radiance, in [0, 1e30].
  static Vec3f usable(const Vec3f& texel) {
    const auto channel = [](float value) { return value > 0 ? std::min(value, 1e30f) : 0.0f; };
    return {channel(texel.x), channel(texel.y), channel(texel.z)};
  }

  LatLongImage load_hdr() const {
    const std::string_view bytes = file_.bytes();
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const auto size =
        static_cast<int>(std::min<size_t>(bytes.size(), std::numeric_limits<int>::max()));
    if (!stbi_is_hdr_from_memory(data, size)) {
      fail("neither a Radiance .hdr nor an OpenEXR picture");
    }
    LatLongImage image;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels)) {
      check_size(image.width, image.height);
    }
    float* pixels = stbi_loadf_from_memory(data, size, &image.width, &image.height, &channels, 3);
    if (!pixels) fail(std::string("a damaged Radiance picture: ") + stbi_failure_reason());
    image.texels.resize(static_cast<size_t>(image.width) * image.height);
    std::memcpy(image.texels.data(), pixels, image.texels.size() * sizeof(Vec3f));
    stbi_image_free(pixels);
    return image;
  }

  LatLongImage load_exr() const {
    try {
      ByteStream stream(path_, file_.bytes());
      Imf::InputFile file(stream);
      return read_exr(file);
    } catch (const LoadError&) {
      throw;
    } catch (const std::exception& error) {
      fail(std::string("an OpenEXR picture that cannot be read: ") + error.what());
    }
  }

  LatLongImage read_exr(Imf::InputFile& file) const {
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    check_size(width, height);
    const Imf::ChannelList& channels = file.header().channels();
    const bool is_grey = channels.findChannel("Y") && !channels.findChannel("R");
    if (!is_grey &&
        !(channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B"))) {
      fail("an OpenEXR picture without channels R, G and B");
    }
    LatLongImage image{static_cast<int>(width), static_cast<int>(height), {}};
    image.texels.resize(static_cast<size_t>(width * height));
    Imf::FrameBuffer frame;
    const char* names[3] = {"R", "G", "B"};
    const auto row_bytes = static_cast<size_t>(width) * sizeof(Vec3f);
    for (size_t i = 0; i < (is_grey ? 1u : 3u); ++i) {
      // OpenEXR counts from the pixel (0, 0), wherever the window is.
      char* base = reinterpret_cast<char*>(image.texels.data()) + i * sizeof(float) -
                   (static_cast<int64_t>(window.min.x) * static_cast<int64_t>(sizeof(Vec3f)) +
                    window.min.y * static_cast<int64_t>(row_bytes));
      frame.insert(is_grey ? "Y" : names[i],
                   Imf::Slice(Imf::FLOAT, base, sizeof(Vec3f), row_bytes));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    if (is_grey) {
      for (Vec3f& texel : image.texels) texel = Vec3f(texel.x);
    }
    return image;
  }

  std::string path_;
  FileBytes file_;
};

}  // namespace

std::shared_ptr<const Environment> load_environment(const std::filesystem::path& path) {
  return std::make_shared<const Environment>(SkyMap(Loader(path).load()));
}

bool is_environment_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension == ".hdr" || extension == ".exr";
}

}  // namespace tracer
