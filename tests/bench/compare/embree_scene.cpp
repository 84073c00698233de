// SPDX-License-Identifier: MIT
#include "tests/bench/compare/embree_scene.h"

#ifdef BOXWOOD_EMBREE
#include <algorithm>
#include <memory>

#include <fmt/format.h>

namespace bench {

EmbreeScene::EmbreeScene(const tracer::Mesh& mesh, RTCBuildQuality quality, EmbreeMode mode)
    : positions_(mesh.positions), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  positions_.emplace_back();
  const auto count_bytes = [](void* bytes, ssize_t change, bool) {
    *static_cast<std::atomic<int64_t>*>(bytes) += change;
    return true;
  };
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             positions_.data(), 0, sizeof(tracer::Vec3f), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(tracer::Vec3u),
                             mesh.triangles.size());
  rtcSetGeometryBuildQuality(geometry, quality);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(scene_, quality);
  if (mode == EmbreeMode::robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

namespace {

/// What a ray query needs; the rest of Embree's own structure is filled in while tracing.
struct CompactRay {
  float origin[3];
  float near_distance;
  float direction[3];
  float far_distance;
};

RTCRay make_ray(const CompactRay& ray) {
  return {ray.origin[0],
          ray.origin[1],
          ray.origin[2],
          ray.near_distance,
          ray.direction[0],
          ray.direction[1],
          ray.direction[2],
          0,
          ray.far_distance,
          0xffffffffu,
          0,
          0};
}

CompactRay compact(const tracer::Ray& ray) {
  return {{ray.origin.x, ray.origin.y, ray.origin.z},
          static_cast<float>(ray.t_min),
          {ray.direction.x, ray.direction.y, ray.direction.z},
          static_cast<float>(ray.t_max)};
}

RTCRayHit make_query(const CompactRay& ray) {
  RTCRayHit query;
  query.ray = make_ray(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

template <Query query>
void trace_one(RTCScene scene, RTCIntersectContext& context, const CompactRay& ray,
               Answer& answer) {
  if constexpr (query == Query::occluded) {
    RTCRay occlusion = make_ray(ray);
    rtcOccluded1(scene, &context, &occlusion);
    answer = occlusion.tfar < 0 ? is_occluded : tracer::no_primitive;
  } else {
    RTCRayHit hit = make_query(ray);
    rtcIntersect1(scene, &context, &hit);
    answer = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? tracer::no_primitive : hit.hit.primID;
  }
}

template <Query query>
TraceRange prepare_query(RTCScene scene, const RaySet& set) {
  auto rays = std::make_shared<std::vector<CompactRay>>(set.rays.size());
  std::ranges::transform(set.rays, rays->begin(), compact);
  return [scene, rays](size_t first, size_t last, std::span<Answer> answers) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = first; i < last; ++i) {
      trace_one<query>(scene, context, (*rays)[i], answers[i]);
    }
  };
}

TraceRange prepare_single(RTCScene scene, const RaySet& set) {
  return set.kind->query == Query::occluded ? prepare_query<Query::occluded>(scene, set)
                                            : prepare_query<Query::closest_hit>(scene, set);
}

constexpr size_t packet_size = 16;

RTCRay16 make_packet(std::span<const tracer::Ray> rays) {
  RTCRay16 packet{};
  for (size_t lane = 0; lane < packet_size; ++lane) {
    const RTCRay ray = make_ray(compact(rays[std::min(lane, rays.size() - 1)]));
    packet.org_x[lane] = ray.org_x, packet.org_y[lane] = ray.org_y, packet.org_z[lane] = ray.org_z;
    packet.dir_x[lane] = ray.dir_x, packet.dir_y[lane] = ray.dir_y, packet.dir_z[lane] = ray.dir_z;
    packet.tnear[lane] = ray.tnear, packet.tfar[lane] = ray.tfar, packet.mask[lane] = ray.mask;
  }
  return packet;
}

void trace_packet(RTCScene scene, RTCIntersectContext& context, const RTCRay16& rays,
                  std::span<Answer> answers) {
  alignas(64) int valid[packet_size];
  for (size_t lane = 0; lane < packet_size; ++lane) valid[lane] = lane < answers.size() ? -1 : 0;
  RTCRayHit16 packet;
  packet.ray = rays;
  std::ranges::fill(packet.hit.geomID, RTC_INVALID_GEOMETRY_ID);
  std::ranges::fill(packet.hit.instID[0], RTC_INVALID_GEOMETRY_ID);
  rtcIntersect16(valid, scene, &context, &packet);
  for (size_t lane = 0; lane < answers.size(); ++lane) {
    const bool is_hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    answers[lane] = is_hit ? packet.hit.primID[lane] : tracer::no_primitive;
  }
}

// Packets of neighbours, for camera rays.
TraceRange prepare_packets(RTCScene scene, const RaySet& set) {
  if (set.kind->name != "P") return {};
  auto packets = std::make_shared<std::vector<RTCRay16>>();
  const std::span all(set.rays);
  for (size_t first = 0; first < all.size(); first += packet_size) {
    packets->push_back(make_packet(all.subspan(first, std::min(packet_size, all.size() - first))));
  }
  return [scene, packets](size_t first, size_t last, std::span<Answer> answers) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t i = first; i < last; i += packet_size) {
      trace_packet(scene, context, (*packets)[i / packet_size],
                   answers.subspan(i, std::min(packet_size, last - i)));
    }
  };
}

}  // namespace

RTCRayHit make_query(const tracer::Ray& ray) {
  return make_query(compact(ray));
}

std::vector<Tracer> embree_tracers(const EmbreeScene& standard, const EmbreeScene& robust) {
  const auto with = [](const EmbreeScene& scene, auto prepare) {
    return [&scene, prepare](const RaySet& set) { return prepare(scene.scene(), set); };
  };
  return {{"embree", with(standard, prepare_single)},
          {"embree robust", with(robust, prepare_single)},
          {"embree 16", with(standard, prepare_packets)}};
}

std::string embree_version() {
  RTCDevice device = rtcNewDevice(nullptr);
  const auto part = [&](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(device, property);
  };
  std::string version =
      fmt::format("Embree {}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                  part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
  rtcReleaseDevice(device);
  return version;
}

}  // namespace bench
#endif
