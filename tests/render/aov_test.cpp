// SPDX-License-Identifier: MIT
#include "tracer/render/aov.h"

#include <cmath>
#include <limits>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/worlds.h"
#include "tracer/base/error.h"
#include "tracer/base/parallel.h"
#include "tracer/render/film_error.h"
#include "tracer/render/write_image.h"

namespace tracer {
namespace {

constexpr Vec2i size_px{16, 8};

/// A wall across the left half of the view, 5 away, seen along -Z, and nothing at the right.
World make_wall() {
  test::Triangles triangles;
  triangles.add_quad({-6, -3, -5}, {6, 0, 0}, {0, 6, 0}, 0);
  World world = test::make_world(triangles, {test::diffuse(0.25)}, Vec3d(1));
  test::set_camera(world, {.eye = {0, 0, 0}, .target = {0, 0, -1}, .fov_degrees = 60}, size_px);
  return world;
}

std::vector<const Aov*> all_aovs() {
  std::vector<const Aov*> all;
  for (const Aov& aov : aovs()) all.push_back(&aov);
  return all;
}

std::vector<ImageLayer> layers_of(const World& world, Vec2i size, uint32_t samples = 4) {
  const Film film = test::render(world, integrators().front(), {}, size, samples);
  return render_aovs(all_aovs(), world, {}, film, samples);
}

/// The first channel's value at a pixel.
double value_at(const ImageLayer& layer, int x, int y, size_t channel = 0) {
  const size_t index = (static_cast<size_t>(y) * size_px.x + x) * layer.channels.size() + channel;
  return std::visit([index](const auto& values) { return static_cast<double>(values.at(index)); },
                    layer.values);
}

TEST(Aov, table_lists_each_name_once_with_a_channel_a_letter) {
  std::set<std::string_view> names;
  for (const Aov& aov : aovs()) {
    EXPECT_TRUE(names.insert(aov.name).second) << aov.name;
    EXPECT_EQ(find_aov(aov.name), &aov);
    EXPECT_FALSE(aov.channels.empty());
  }
  EXPECT_EQ(find_aov("no such"), nullptr);
}

TEST(Aov, of_a_wall_are_its_colour_normal_distance_along_the_axis_and_triangles) {
  const std::vector<ImageLayer> layers = layers_of(make_wall(), size_px);
  ASSERT_EQ(layers.size(), aovs().size());
  const auto layer = [&](std::string_view name) -> const ImageLayer& {
    return layers[find_aov(name) - aovs().data()];
  };
  for (const int y : {0, 3, 7}) {
    for (const int x : {0, 3, 6}) {
      EXPECT_FLOAT_EQ(value_at(layer("albedo"), x, y, 1), 0.25);
      EXPECT_NEAR(value_at(layer("normal"), x, y, 2), 1, 1e-6);
      EXPECT_NEAR(value_at(layer("normal"), x, y, 0), 0, 1e-6);
      EXPECT_NEAR(value_at(layer("depth"), x, y), 5, 1e-5);
      EXPECT_LE(value_at(layer("primitive"), x, y), 1);
      EXPECT_EQ(value_at(layer("samples"), x, y), 4);
    }
    EXPECT_EQ(value_at(layer("albedo"), 12, y), 0);
    EXPECT_EQ(value_at(layer("normal"), 12, y, 2), 0);
    EXPECT_EQ(value_at(layer("depth"), 12, y), std::numeric_limits<double>::infinity());
    EXPECT_EQ(value_at(layer("primitive"), 12, y), 0xffffffff);
    EXPECT_EQ(value_at(layer("error"), 12, y), 0);
  }
  // Both triangles of the wall are seen.
  EXPECT_NE(value_at(layer("primitive"), 0, 0), value_at(layer("primitive"), 6, 7));
}

TEST(Aov, have_the_same_bits_without_a_tree_and_on_one_thread) {
  const Vec2i size{40, 30};
  const World with_tree = test::make_room(size);
  const World without = test::make_room(size, test::Tracing::brute_force);
  const std::vector<ImageLayer> expected = layers_of(with_tree, size);
  const auto expect_same = [&](const std::vector<ImageLayer>& layers) {
    for (size_t i = 0; i < layers.size(); ++i) {
      EXPECT_TRUE(layers[i].values == expected[i].values) << layers[i].name;
    }
  };
  expect_same(layers_of(without, size));
  on_one_thread([&] { expect_same(layers_of(with_tree, size)); });
}

TEST(Aov, errors_and_counts_are_the_films_own) {
  const World room = test::make_room(size_px);
  const Film film = test::render(room, *find_integrator("path"), {}, size_px, 8);
  const Aov* wanted[] = {find_aov("error"), find_aov("samples")};
  const auto layers = render_aovs(wanted, room, {}, film, 8);
  EXPECT_EQ(value_at(layers[0], 5, 4), static_cast<float>(pixel_error(film, 5, 4)));
  EXPECT_GT(value_at(layers[0], 5, 4), 0);
  EXPECT_EQ(value_at(layers[1], 5, 4), 8);
}

TEST(Aov, an_exr_holds_them_beside_the_picture) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "layers.exr";
  const std::vector<ImageLayer> layers = layers_of(make_wall(), size_px);
  const Image image{size_px, std::vector<Vec3f>(16 * 8, Vec3f(0.5f))};
  write_image(path, image, 0, {}, layers);

  Imf::InputFile file(path.c_str());
  const Imf::ChannelList& channels = file.header().channels();
  for (const char* name :
       {"R", "G", "B", "albedo.R", "albedo.B", "normal.X", "normal.Z", "depth.Z", "error.X"}) {
    ASSERT_NE(channels.findChannel(name), nullptr) << name;
    EXPECT_EQ(channels.findChannel(name)->type, Imf::FLOAT) << name;
  }
  for (const char* name : {"primitive.X", "samples.X"}) {
    ASSERT_NE(channels.findChannel(name), nullptr) << name;
    EXPECT_EQ(channels.findChannel(name)->type, Imf::UINT) << name;
  }
  std::vector<float> normals(16 * 8);
  std::vector<uint32_t> primitives(16 * 8);
  Imf::FrameBuffer frame;
  frame.insert("normal.Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(normals.data()), 4, 64));
  frame.insert("primitive.X",
               Imf::Slice(Imf::UINT, reinterpret_cast<char*>(primitives.data()), 4, 64));
  file.setFrameBuffer(frame);
  file.readPixels(0, 7);
  EXPECT_NEAR(normals[3], 1, 1e-6);
  EXPECT_EQ(primitives[12], 0xffffffff);
}

TEST(Aov, other_files_refuse_layers) {
  const TemporaryFolder folder;
  const std::vector<ImageLayer> layers = layers_of(make_wall(), size_px);
  const Image image{size_px, std::vector<Vec3f>(16 * 8)};
  EXPECT_THROW(write_image(folder.path() / "a.png", image, 0, {}, layers), LoadError);
  EXPECT_FALSE(can_hold_layers("a.pfm"));
  EXPECT_TRUE(can_hold_layers("a.EXR"));
}

}  // namespace
}  // namespace tracer
