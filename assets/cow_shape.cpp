// SPDX-License-Identifier: MIT
#include "assets/cow_shape.h"

#include "assets/implicit.h"

namespace assets {
namespace {

Vec3d mirrored(const Vec3d& point) {
  return {point.x, point.y, -point.z};
}

double trunk(const Vec3d& p) {
  double d = distance_to(Ball{{-0.06, 0.93, 0.0}, {0.60, 0.37, 0.325}}, p);          // barrel
  d = join(d, distance_to(Ball{{-0.14, 0.79, 0.0}, {0.44, 0.255, 0.27}}, p), 0.15);  // belly
  d = join(d, distance_to(Ball{{0.36, 0.97, 0.0}, {0.36, 0.37, 0.255}}, p), 0.20);   // chest
  d = join(d, distance_to(Ball{{-0.56, 1.06, 0.0}, {0.30, 0.26, 0.245}}, p), 0.20);
  d = join(d, distance_to(Cone{{0.38, 1.24, 0.0}, {-0.66, 1.25, 0.0}, 0.085, 0.075}, p), 0.14);
  d = join(d, distance_to(Ball{{0.30, 1.24, 0.0}, {0.20, 0.11, 0.08}}, p), 0.12);  // withers
  d = join(d, distance_to(Cone{{-0.62, 1.26, 0.0}, {-0.80, 1.27, 0.0}, 0.06, 0.045}, p), 0.10);
  return d;
}

/// Hip bone and pin bone of the side z > 0.
double pelvis(const Vec3d& p) {
  const double hook = distance_to(Ball{{-0.47, 1.19, 0.175}, {0.11, 0.085, 0.075}}, p);
  const double pin = distance_to(Ball{{-0.80, 1.165, 0.095}, {0.06, 0.06, 0.05}}, p);
  return join(hook, pin, 0.08);
}

double neck(const Vec3d& p) {
  double d = distance_to(Cone{{0.46, 1.06, 0.0}, {0.94, 1.32, 0.0}, 0.27, 0.125, 0.62}, p);
  d = join(d, distance_to(Cone{{0.36, 1.25, 0.0}, {0.92, 1.38, 0.0}, 0.09, 0.06, 0.9}, p), 0.10);
  // Brisket and dewlap.
  d = join(d, distance_to(Ball{{0.62, 0.78, 0.0}, {0.13, 0.14, 0.11}}, p), 0.12);
  d = join(d, distance_to(Cone{{0.70, 0.80, 0.0}, {1.00, 1.12, 0.0}, 0.075, 0.036, 0.40}, p), 0.10);
  return d;
}

/// From the world into the head's own frame: origin at the poll, x along the nose, y out of the
/// forehead. The head looks down by 3-4-5 and to the side by 7-24-25.
Vec3d to_head(const Vec3d& point) {
  const Vec3d offset = point - Vec3d(0.95, 1.40, 0.0);
  const double forward = offset.x * 0.96 + offset.z * 0.28;
  const double side = offset.z * 0.96 - offset.x * 0.28;
  return {forward * 0.8 - offset.y * 0.6, forward * 0.6 + offset.y * 0.8, side};
}

/// The ball that holds the head and where it blends into the neck.
bool is_near_head(const Vec3d& point) {
  return glm::length(to_head(point) - Vec3d(0.20, -0.03, 0.0)) < 0.44;
}

double skull(const Vec3d& p) {
  double d = distance_to(Ball{{0.08, -0.075, 0.0}, {0.15, 0.115, 0.105}}, p);
  d = join(d, distance_to(Cone{{0.04, -0.06, 0.0}, {0.41, -0.085, 0.0}, 0.085, 0.058, 1.0}, p),
           0.06);
  d = join(d, distance_to(Cone{{0.12, -0.165, 0.0}, {0.39, -0.145, 0.0}, 0.075, 0.045, 0.9}, p),
           0.06);
  d = join(d, distance_to(Ball{{0.02, -0.005, 0.0}, {0.06, 0.045, 0.075}}, p), 0.06);  // poll
  d = join(d, distance_to(Ball{{0.435, -0.095, 0.0}, {0.068, 0.068, 0.088}}, p), 0.05);
  d = join(d, distance_to(Ball{{0.40, -0.165, 0.0}, {0.065, 0.034, 0.062}}, p), 0.03);
  return d;
}

double face_side(const Vec3d& p) {
  double d = distance_to(Ball{{0.15, -0.15, 0.055}, {0.11, 0.09, 0.045}}, p);            // cheek
  d = join(d, distance_to(Ball{{0.145, -0.02, 0.075}, {0.05, 0.032, 0.036}}, p), 0.04);  // brow
  return d;
}

constexpr Ball eye{{0.165, -0.048, 0.097}, {0.028, 0.024, 0.019}};
constexpr Ball pupil{{0.170, -0.050, 0.118}, {0.016, 0.011, 0.014}};
constexpr Ball nostril{{0.492, -0.075, 0.048}, {0.022, 0.014, 0.022}};

/// How deep the line of the mouth is cut.
double mouth(const Vec3d& p) {
  const double across = std::min(1.0, std::abs(p.y + 0.140) / 0.016);
  const double along = std::clamp((p.x - 0.36) / 0.05, 0.0, 1.0);
  const double rounded = 1.0 - across * across;
  return 0.014 * rounded * rounded * along;
}

double horn(const Vec3d& p) {
  double d = distance_to(Cone{{0.01, 0.0, 0.065}, {-0.005, 0.03, 0.135}, 0.032, 0.026}, p);
  d = join(d, distance_to(Cone{{-0.005, 0.03, 0.135}, {0.01, 0.09, 0.185}, 0.026, 0.019}, p),
           0.012);
  return join(d, distance_to(Cone{{0.01, 0.09, 0.185}, {0.045, 0.170, 0.175}, 0.019, 0.010}, p),
              0.012);
}

/// From the head's frame into an ear's own, which leans out, down and back: z along the ear.
Vec3d to_ear(const Vec3d& p) {
  const Vec3d offset = p - Vec3d(-0.03, -0.085, 0.19);
  const double along = offset.z * 0.96 - offset.y * 0.28;
  const double upward = offset.y * 0.96 + offset.z * 0.28;
  return {offset.x * 0.8 + upward * 0.6, upward * 0.8 - offset.x * 0.6, along};
}

double inner_ear(const Vec3d& p) {
  return distance_to(Ball{{0.026, 0.0, 0.02}, {0.024, 0.036, 0.085}}, to_ear(p));
}

double ear(const Vec3d& p) {
  const Vec3d leaf = to_ear(p);
  double d = distance_to(Ball{{0.0, 0.0, 0.0}, {0.022, 0.058, 0.125}}, leaf);
  d = carve(d, inner_ear(p), 0.015);
  return join(d, distance_to(Cone{{-0.01, 0.0, -0.13}, {0.0, 0.0, -0.06}, 0.03, 0.026}, leaf),
              0.03);
}

double head(const Vec3d& p) {
  const Vec3d left = to_head(p);
  const Vec3d right = mirrored(left);
  double d = skull(left);
  for (const Vec3d& side : {left, right}) {
    d = join(d, face_side(side), 0.04);
    d = carve(d, distance_to(nostril, side), 0.012);
    d = join(d, distance_to(eye, side), 0.008);
    d = join(d, ear(side), 0.02);
    d = join(d, horn(side), 0.015);
  }
  return d + mouth(left);
}

/// A hoof whose coronet is at `p` = 0, cut flat at the ground by the caller.
double hoof(const Vec3d& p) {
  double d = distance_to(Cone{{0.0, 0.055, 0.0}, {0.03, 0.0, 0.0}, 0.046, 0.062, 0.92}, p);
  return carve(d, distance_to(Ball{{0.10, 0.03, 0.0}, {0.045, 0.08, 0.012}}, p), 0.020);
}

double fore_leg(const Vec3d& p, double stride) {
  const Vec3d elbow(0.43, 0.62, 0.165);
  double d = distance_to(Ball{{0.45, 0.96, 0.165}, {0.16, 0.30, 0.085}}, p);  // shoulder
  d = join(d, distance_to(Cone{{0.49, 0.84, 0.15}, elbow, 0.13, 0.09}, p), 0.14);
  const Vec3d knee(0.445 + 0.6 * stride, 0.385, 0.155);
  const Vec3d fetlock(0.44 + stride, 0.135, 0.15);
  d = join(d, distance_to(Cone{elbow, knee, 0.088, 0.05}, p), 0.08);
  d = join(d, distance_to(Ball{knee + Vec3d(0.008, 0.0, 0.0), {0.056, 0.068, 0.053}}, p), 0.04);
  d = join(d, distance_to(Cone{knee, fetlock, 0.045, 0.037}, p), 0.03);
  d = join(d, distance_to(Ball{fetlock, {0.05, 0.045, 0.046}}, p), 0.03);
  d = join(d, distance_to(Cone{fetlock, fetlock + Vec3d(0.02, -0.07, 0.0), 0.040, 0.042}, p), 0.02);
  return join(d, hoof(p - Vec3d(fetlock.x + 0.015, 0.02, fetlock.z)), 0.02);
}

double hind_leg(const Vec3d& p, double stride) {
  double d = distance_to(Ball{{-0.60, 0.92, 0.155}, {0.225, 0.32, 0.115}}, p);         // thigh
  d = join(d, distance_to(Ball{{-0.44, 0.76, 0.185}, {0.13, 0.15, 0.075}}, p), 0.14);  // stifle
  const Vec3d stifle(-0.52, 0.75, 0.175);
  const Vec3d hock(-0.75 + 0.7 * stride, 0.485, 0.165);
  const Vec3d fetlock(-0.70 + stride, 0.14, 0.16);
  d = join(d, distance_to(Cone{stifle, hock, 0.145, 0.058, 0.8}, p), 0.14);
  d = join(d, distance_to(Ball{hock + Vec3d(-0.025, 0.03, 0.0), {0.05, 0.07, 0.042}}, p), 0.05);
  d = join(d, distance_to(Cone{hock, fetlock, 0.056, 0.040, 0.85}, p), 0.03);
  d = join(d, distance_to(Ball{fetlock, {0.052, 0.047, 0.048}}, p), 0.03);
  d = join(d, distance_to(Cone{fetlock, fetlock + Vec3d(0.02, -0.07, 0.0), 0.042, 0.043}, p), 0.02);
  return join(d, hoof(p - Vec3d(fetlock.x + 0.015, 0.02, fetlock.z)), 0.02);
}

double udder(const Vec3d& p) {
  const Vec3d side(p.x, p.y, std::abs(p.z));
  double d = distance_to(Ball{{-0.41, 0.61, 0.0}, {0.19, 0.17, 0.14}}, p);
  for (const double x : {-0.34, -0.47}) {
    d = join(d, distance_to(Cone{{x, 0.48, 0.065}, {x, 0.395, 0.07}, 0.022, 0.018}, side), 0.03);
  }
  return d;
}

double tail(const Vec3d& p) {
  double d = distance_to(Cone{{-0.77, 1.265, 0.0}, {-0.885, 1.17, 0.01}, 0.05, 0.036}, p);
  d = join(d, distance_to(Cone{{-0.885, 1.17, 0.01}, {-0.92, 0.92, 0.03}, 0.036, 0.024}, p), 0.015);
  d = join(d, distance_to(Cone{{-0.92, 0.92, 0.03}, {-0.92, 0.64, 0.06}, 0.024, 0.021}, p), 0.015);
  d = join(d, distance_to(Ball{{-0.925, 0.53, 0.072}, {0.045, 0.13, 0.042}}, p), 0.05);
  return join(d, distance_to(Cone{{-0.925, 0.50, 0.075}, {-0.91, 0.37, 0.085}, 0.035, 0.01}, p),
              0.05);
}

/// Black patches of a Friesian, with the white of the forehead and of the tail's root left out.
double patches(const Vec3d& p) {
  const double rump = join(distance_to(Ball{{-0.66, 1.20, 0.10}, {0.21, 0.32, 0.42}}, p),
                           distance_to(Ball{{-0.48, 0.98, 0.32}, {0.15, 0.13, 0.16}}, p), 0.12);
  const double saddle = join(distance_to(Ball{{0.05, 1.26, 0.10}, {0.24, 0.25, 0.36}}, p),
                             distance_to(Ball{{0.16, 0.99, 0.33}, {0.15, 0.19, 0.14}}, p), 0.12);
  const double flank = join(distance_to(Ball{{-0.20, 0.92, -0.34}, {0.22, 0.20, 0.16}}, p),
                            distance_to(Ball{{-0.36, 0.76, -0.30}, {0.11, 0.13, 0.16}}, p), 0.10);
  const double neck = join(distance_to(Ball{{0.68, 1.22, 0.0}, {0.19, 0.34, 0.30}}, p),
                           distance_to(Ball{{0.55, 0.98, 0.24}, {0.11, 0.15, 0.14}}, p), 0.12);
  const double tuft = distance_to(Ball{{-0.935, 0.49, 0.075}, {0.06, 0.15, 0.12}}, p);
  const Vec3d face = to_head(p);
  double mask = distance_to(Ball{{0.06, -0.08, 0.0}, {0.26, 0.26, 0.36}}, face);
  mask = carve(mask, distance_to(Ball{{0.20, 0.04, 0.0}, {0.30, 0.10, 0.036}}, face), 0.05);
  return std::min({rump, saddle, flank, join(neck, mask, 0.08), tuft});
}

double skin(const Vec3d& p) {
  const Vec3d face = to_head(p);
  const Vec3d side(face.x, face.y, std::abs(face.z));
  const double muzzle = distance_to(Ball{{0.47, -0.12, 0.0}, {0.09, 0.12, 0.13}}, face);
  const double bag = distance_to(Ball{{-0.42, 0.48, 0.0}, {0.22, 0.165, 0.17}}, p);
  return std::min({muzzle, bag, inner_ear(side) - 0.004});
}

double horns(const Vec3d& p) {
  const Vec3d face = to_head(p);
  const Vec3d side(face.x, face.y, std::abs(face.z));
  return std::max(horn(side) - 0.012, 0.105 - side.z);
}

double hooves(const Vec3d& p) {
  return p.y - 0.068;
}

double eyes(const Vec3d& p) {
  const Vec3d face = to_head(p);
  return distance_to(eye, Vec3d(face.x, face.y, std::abs(face.z))) - 0.0015;
}

double pupils(const Vec3d& p) {
  const Vec3d face = to_head(p);
  return distance_to(pupil, Vec3d(face.x, face.y, std::abs(face.z)));
}

double nostrils(const Vec3d& p) {
  const Vec3d face = to_head(p);
  return distance_to(nostril, Vec3d(face.x, face.y, std::abs(face.z))) - 0.003;
}

}  // namespace

double cow_distance(const Vec3d& point) {
  const Vec3d other = mirrored(point);
  double d = trunk(point);
  d = join(d, neck(point), 0.14);
  d = join(join(d, pelvis(point), 0.13), pelvis(other), 0.13);
  d = join(join(d, fore_leg(point, 0.05), 0.14), fore_leg(other, -0.03), 0.14);
  d = join(join(d, hind_leg(point, -0.06), 0.14), hind_leg(other, 0.07), 0.14);
  d = join(d, udder(point), 0.05);
  d = join(d, tail(point), 0.03);
  if (is_near_head(point)) d = join(d, head(point), 0.06);
  return carve(d, point.y, 0.01);
}

double cow_importance(const Vec3d& point) {
  const Vec3d face = to_head(point);
  if (glm::length(Vec3d(face.x, face.y, std::abs(face.z)) - eye.center) < 0.05) return 4.0;
  if (is_near_head(point)) return 2.2;
  if (udder(point) < 0.02) return 1.5;
  return point.y < 0.10 ? 2.0 : 1.0;
}

const std::array<Region, 7> cow_regions = {{
    {"hide_black", {0.022, 0.018, 0.016}, patches},
    {"skin", {0.62, 0.33, 0.27}, skin},
    {"horn", {0.55, 0.47, 0.34}, horns},
    {"hoof", {0.06, 0.045, 0.035}, hooves},
    {"eye", {0.22, 0.10, 0.04}, eyes},
    {"pupil", {0.008, 0.006, 0.006}, pupils},
    {"nostril", {0.10, 0.035, 0.03}, nostrils},
}};

}  // namespace assets
