// SPDX-License-Identifier: MIT
// Without the library's exp, acos and tan: their last bits differ from one system to the next.
#include "tracer/scene/sun_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracer/base/parallel.h"
#include "tracer/base/trigonometry.h"

namespace tracer {
namespace {

constexpr double candela_per_unit = 20000;
constexpr double ground_albedo = 0.2;
constexpr int map_width = 512;
constexpr int map_height = 256;

/// CIE XYZ to linear Rec. 709.
Vec3d rgb_of_xyz(const Vec3d& xyz) {
  return {3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
          -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
          0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
}

/// Brightness or a chromaticity by angle [Perez 1993].
struct Perez {
  double a, b, c, d, e;
  /// cos_zenith above 0; `apart` is the angle to the sun in radians.
  double operator()(double cos_zenith, double apart, double cos_apart) const {
    return (1 + a * exp_of(b / cos_zenith)) *
           (1 + c * exp_of(d * apart) + e * cos_apart * cos_apart);
  }
};

/// [Preetham 1999] A.2: Y in kcd/m^2, x and y.
class PreethamSky {
 public:
  PreethamSky(double turbidity, double sun_zenith, double cos_sun) {
    const double t = turbidity;
    luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                  0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
    x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
          -0.0033 * t + 0.0452};
    y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
          -0.0109 * t + 0.0529};
    const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * sun_zenith);
    const CosSin turned = cos_sin_of_turns(chi / (2 * std::numbers::pi));
    const double z = sun_zenith;
    const double zenith_luminance =
        (4.0453 * t - 4.9710) * (turned.sin / turned.cos) - 0.2155 * t + 2.4192;
    const double zenith_x = t * t * (0.00166 * z * z * z - 0.00375 * z * z + 0.00209 * z) +
                            t * (-0.02903 * z * z * z + 0.06377 * z * z - 0.03202 * z + 0.00394) +
                            (0.11693 * z * z * z - 0.21196 * z * z + 0.06052 * z + 0.25886);
    const double zenith_y = t * t * (0.00275 * z * z * z - 0.00610 * z * z + 0.00317 * z) +
                            t * (-0.04214 * z * z * z + 0.08970 * z * z - 0.04153 * z + 0.00516) +
                            (0.15346 * z * z * z - 0.26756 * z * z + 0.06670 * z + 0.26688);
    scale_ = {zenith_luminance / luminance_(1, sun_zenith, cos_sun),
              zenith_x / x_(1, sun_zenith, cos_sun), zenith_y / y_(1, sun_zenith, cos_sun)};
  }

  /// Linear RGB in kcd/m^2.
  Vec3d operator()(double cos_zenith, double apart, double cos_apart) const {
    const double luminance = std::max(0.0, scale_.x * luminance_(cos_zenith, apart, cos_apart));
    const double x = scale_.y * x_(cos_zenith, apart, cos_apart);
    const double y = scale_.z * y_(cos_zenith, apart, cos_apart);
    const Vec3d rgb = rgb_of_xyz({x / y * luminance, luminance, (1 - x - y) / y * luminance});
    return glm::max(rgb, Vec3d(0));
  }

 private:
  Perez luminance_{}, x_{}, y_{};
  Vec3d scale_{};
};

/// What the air leaves of sunlight at 610, 550 and 465 nm: molecules, aerosols and ozone
/// [Preetham 1999] A.1, through an air mass by [Young 1994].
Vec3d sunlight_left(double turbidity, double cos_sun) {
  const double c = cos_sun;
  const double air_mass = (1.002432 * c * c + 0.148386 * c + 0.0096467) /
                          (c * c * c + 0.149864 * c * c + 0.0102963 * c + 0.000303978);
  const double aerosols = 0.04608365822050 * turbidity - 0.04586025928522;
  // Wavelengths in um to the powers of -4.08 and -1.3, and ozone's absorption by 0.35 cm.
  constexpr Vec3d molecular = 0.008735 * Vec3d(7.514, 11.462, 22.735);
  constexpr Vec3d aerosol(1.9014, 2.1754, 2.7058);
  constexpr Vec3d ozone = 0.35 * Vec3d(0.120, 0.085, 0.012);
  const Vec3d depth = air_mass * (molecular + aerosols * aerosol + ozone);
  return {exp_of(-depth.x), exp_of(-depth.y), exp_of(-depth.z)};
}

Sun make_sun(const Vec3d& direction, double turbidity) {
  constexpr double luminance_in_space = 1.88e6;  // kcd/m^2, 128 klx by its solid angle
  constexpr double radius_turns = 0.2666 / 360;
  return {.direction = direction,
          .cos_radius = cos_sin_of_turns(radius_turns).cos,
          .radiance = luminance_in_space * sunlight_left(turbidity, direction.y)};
}

Vec3d direction_of(const SunPosition& position) {
  const CosSin height = cos_sin_of_turns(position.elevation_degrees / 360);
  const CosSin around = cos_sin_of_turns(position.azimuth_degrees / 360);
  return {height.cos * around.cos, height.sin, -height.cos * around.sin};
}

/// Directions of the texels' centres.
Vec3d direction_of_texel(int column, int row) {
  const CosSin descent = cos_sin_of_turns(0.5 * (row + 0.5) / map_height);
  const CosSin around = cos_sin_of_turns((column + 0.5) / map_width);
  return {-descent.sin * around.cos, descent.cos, -descent.sin * around.sin};
}

/// Of the upper half of the image, on level ground.
Vec3d irradiance_of_sky(const LatLongImage& image) {
  Vec3d sum(0);
  for (int row = 0; row < map_height / 2; ++row) {
    const CosSin descent = cos_sin_of_turns(0.5 * (row + 0.5) / map_height);
    const double weight = descent.cos * descent.sin;
    for (int column = 0; column < map_width; ++column) {
      sum += weight * Vec3d(image.texels[static_cast<size_t>(row) * map_width + column]);
    }
  }
  return sum * (2 * std::numbers::pi * std::numbers::pi / (map_width * map_height));
}

}  // namespace

std::shared_ptr<const Environment> make_sun_sky(const SunPosition& position, double turbidity) {
  constexpr double unit = 1000 / candela_per_unit;
  const Vec3d to_sun = direction_of(position);
  const double sun_zenith = (90 - position.elevation_degrees) * std::numbers::pi / 180;
  const PreethamSky sky(turbidity, sun_zenith, to_sun.y);
  Sun sun = make_sun(to_sun, turbidity);
  sun.radiance *= unit;

  LatLongImage image{map_width, map_height, {}};
  image.texels.resize(size_t{map_width} * map_height);
  parallel_for_ranges(0, map_height / 2, 8, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row) {
      for (int column = 0; column < map_width; ++column) {
        const Vec3d towards = direction_of_texel(column, static_cast<int>(row));
        const double cos_apart = std::clamp(glm::dot(towards, to_sun), -1.0, 1.0);
        const double apart = angle_of(cos_apart, std::sqrt(1 - cos_apart * cos_apart));
        image.texels[row * map_width + column] = Vec3f(unit * sky(towards.y, apart, cos_apart));
      }
    }
  });
  const Vec3d on_ground = irradiance_of_sky(image) + sun.radiance * sun.solid_angle() * to_sun.y;
  std::fill(image.texels.begin() + map_width * (map_height / 2), image.texels.end(),
            Vec3f(on_ground * (ground_albedo / std::numbers::pi)));
  return std::make_shared<const Environment>(SkyMap(std::move(image)), sun);
}

}  // namespace tracer
