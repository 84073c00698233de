// SPDX-License-Identifier: MIT
#include "tracer/scene/surface_maps.h"

#include <cmath>
#include <optional>

#include "tracer/base/directions.h"
#include "tracer/geometry/ray.h"

namespace tracer {
namespace {

/// A triangle's corners in texture space.
struct TextureCorners {
  Vec2d uv0, uv1, uv2;

  Vec2d at(double u, double v) const { return (1 - u - v) * uv0 + u * uv1 + v * uv2; }
  /// Positive where the image is not mirrored.
  double twice_area() const {
    const Vec2d a = uv1 - uv0;
    const Vec2d b = uv2 - uv0;
    return a.x * b.y - a.y * b.x;
  }
};

std::optional<TextureCorners> texture_corners(const Mesh& mesh, uint32_t triangle) {
  if (mesh.texcoord_indices.empty()) return std::nullopt;
  const Vec3u& corner = mesh.texcoord_indices[triangle];
  if (corner.x == no_index || corner.y == no_index || corner.z == no_index) return std::nullopt;
  return TextureCorners{Vec2d(mesh.texcoords[corner.x]), Vec2d(mesh.texcoords[corner.y]),
                        Vec2d(mesh.texcoords[corner.z])};
}

/// Looks up the textures of a scene at a point.
class MapReader {
 public:
  /// `uv_width` is that of the ray's footprint in texture space.
  MapReader(const Scene& scene, const Vec2d& uv, double uv_width)
      : scene_(scene), uv_(uv), uv_width_(uv_width) {}

  Vec4f texel(const MaterialMap& map) const {
    const Texture& texture = (*scene_.textures)[map.texture];
    const Vec2d scale(map.scale);
    const double density = std::sqrt(std::abs(scale.x * scale.y) * texture.width * texture.height);
    const Vec4f texel =
        eval_texture(texture, scale * uv_ + Vec2d(map.offset), uv_width_ * density, map.wrapping);
    return map.base + map.gain * texel;
  }

  Vec3f color(const MaterialMap& map) const { return glm::max(Vec3f(texel(map)), 0.0f); }

  float number(const MaterialMap& map) const {
    const Vec4f value = texel(map);
    return std::clamp(channel_of(map, value), 0.0f, 1.0f);
  }

 private:
  float channel_of(const MaterialMap& map, const Vec4f& value) const {
    switch (map.channel) {
      case TexelChannel::red:
        return value.x;
      case TexelChannel::green:
        return value.y;
      case TexelChannel::blue:
        return value.z;
      case TexelChannel::alpha:
        if ((*scene_.textures)[map.texture].channel_count == 4) return value.w;
        break;
      case TexelChannel::luminance:
        break;
    }
    return static_cast<float>(luminance(Vec3d(Vec3f(value))));
  }

  const Scene& scene_;
  Vec2d uv_;
  double uv_width_;
};

/// How wide `footprint` is in texture space.
double footprint_in_texture(const TextureCorners& corners, const Triangle& triangle,
                            double footprint) {
  if (footprint == 0) return 0;
  const double twice_area = glm::length(triangle.area_normal());
  return twice_area > 0 ? footprint * std::sqrt(std::abs(corners.twice_area()) / twice_area) : 0;
}

/// Where u grows along the triangle, times its area in texture space: only the direction matters.
Vec3d tangent_of(const TextureCorners& corners, const Triangle& triangle) {
  const double rise1 = corners.uv1.y - corners.uv0.y;
  const double rise2 = corners.uv2.y - corners.uv0.y;
  const Vec3d along = rise2 * (triangle.v1 - triangle.v0) - rise1 * (triangle.v2 - triangle.v0);
  return corners.twice_area() < 0 ? -along : along;
}

/// The normal of a tangent-space texel; 8-bit codes hold 0 as 128.
Vec3d normal_of_texel(const Texture& texture, const Vec4f& texel, double strength) {
  const Vec3d value((Vec3f(texel)));
  Vec3d normal = texture.is_float() ? 2.0 * value - Vec3d(1) : (255.0 * value - Vec3d(128)) / 127.0;
  normal.x *= strength;
  normal.y *= strength;
  return normal;
}

/// `bent`, in the frame of the texture, about the shading normal; the normals stay where what the
/// texture says lies behind the triangle, or there is no frame.
void bend_normal(const TextureCorners& corners, const Triangle& triangle, const Vec3d& bent,
                 Surface& surface) {
  const Vec3d front = unit_or(triangle.area_normal(), Vec3d(0));
  const double side = glm::dot(front, surface.geometric_normal) < 0 ? -1 : 1;
  const Vec3d up = side * surface.shading_normal;
  const Vec3d along = tangent_of(corners, triangle);
  const Vec3d tangent = unit_or(along - glm::dot(along, up) * up, Vec3d(0));
  if (tangent == Vec3d(0) || corners.twice_area() == 0) return;
  const double handedness = corners.twice_area() < 0 ? -1 : 1;
  const Vec3d bitangent = handedness * glm::cross(up, tangent);
  const Vec3d normal =
      side * unit_or(bent.x * tangent + bent.y * bitangent + bent.z * up, Vec3d(0));
  if (glm::dot(normal, surface.geometric_normal) > 0) surface.shading_normal = normal;
}

void apply_numbers(const MapReader& reader, const Material& material, Principled& scattering) {
  const auto replace = [&](MapSlot slot, float& number) {
    const MaterialMap& map = material.map(slot);
    if (!map.empty()) number = reader.number(map);
  };
  replace(MapSlot::specular, scattering.specular);
  replace(MapSlot::roughness, scattering.roughness);
  replace(MapSlot::metallic, scattering.metallic);
}

void apply_colors(const MapReader& reader, const Material& material, Surface& surface) {
  if (const MaterialMap& map = material.map(MapSlot::base_color); !map.empty()) {
    Vec3f& color = surface.scattering.base_color;
    color = glm::clamp(color * reader.color(map), 0.0f, 1.0f);
  }
  if (const MaterialMap& map = material.map(MapSlot::emission); !map.empty()) {
    surface.emission *= Vec3d(reader.color(map));
  }
}

}  // namespace

void apply_maps(const Scene& scene, const Material& material, const Hit& hit,
                const Triangle& triangle, double footprint, Surface& surface) {
  const auto corners = texture_corners(*scene.mesh, hit.primitive);
  if (!corners) return;
  const MapReader reader(scene, corners->at(hit.u, hit.v),
                         footprint_in_texture(*corners, triangle, footprint));
  apply_colors(reader, material, surface);
  apply_numbers(reader, material, surface.scattering);
  if (const MaterialMap& map = material.map(MapSlot::normal); !map.empty()) {
    const Vec3d bent = normal_of_texel((*scene.textures)[map.texture], reader.texel(map),
                                       static_cast<double>(material.normal_strength));
    bend_normal(*corners, triangle, bent, surface);
  }
}

double opacity_at(const Scene& scene, const Hit& hit) {
  const Material& material = (*scene.materials)[scene.mesh->material_of(hit.primitive)];
  const MaterialMap& map = material.map(MapSlot::opacity);
  if (map.empty()) return static_cast<double>(material.opacity);
  const auto corners = texture_corners(*scene.mesh, hit.primitive);
  if (!corners) return static_cast<double>(material.opacity);
  const MapReader reader(scene, corners->at(hit.u, hit.v), 0);
  return static_cast<double>(material.opacity * reader.number(map));
}

}  // namespace tracer
