// SPDX-License-Identifier: MIT
// A second opinion by an independent ray tracer.
#ifdef BOXWOOD_EMBREE
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include "tests/support/test_meshes.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/accel.h"

namespace tracer {
namespace {

class EmbreeScene {
 public:
  explicit EmbreeScene(const Mesh& mesh)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<Vec3f*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3f), mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    auto* triangles = static_cast<Vec3u*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Vec3u),
                                mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  Hit closest_hit(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x, query.ray.org_y = ray.origin.y, query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y;
    query.ray.dir_z = ray.direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = 0xffffffffu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// Whether a float test may decide either way at this hit: near an edge, or grazing.
bool is_delicate(const Mesh& mesh, const Ray& ray, const Hit& hit) {
  if (std::min({hit.u, hit.v, 1 - hit.u - hit.v}) < 1e-3) return true;
  const Vec3u& index = mesh.triangles[hit.primitive];
  const Vec3d edge1 = Vec3d(mesh.positions[index.y]) - Vec3d(mesh.positions[index.x]);
  const Vec3d edge2 = Vec3d(mesh.positions[index.z]) - Vec3d(mesh.positions[index.x]);
  const Vec3d normal = glm::cross(edge1, edge2);
  const Vec3d direction(ray.direction);
  return std::abs(glm::dot(normal, direction)) <
         0.05 * glm::length(normal) * glm::length(direction);
}

void expect_agreement(const Mesh& mesh) {
  const EmbreeScene embree(mesh);
  Progress progress;
  const Accel accel{
      std::make_shared<const Mesh>(mesh),
      std::make_shared<const BvhTree>(builders()[0].build(primitive_boxes(mesh), {}, progress))};
  const StopFlag stop;
  RayCaster caster(accel, stop);
  RandomSource random(1);
  const auto reach = static_cast<float>(max_abs(mesh.bounds.extent()));
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto triangle = static_cast<uint32_t>(random.integer(0, int(mesh.triangle_count()) - 1));
    const Vec3u& index = mesh.triangles[triangle];
    const Vec3f target =
        (mesh.positions[index.x] + mesh.positions[index.y] + mesh.positions[index.z]) / 3.0f;
    const Vec3f origin = mesh.bounds.center() + reach * random.vector(-1, 1);
    const Ray ray{.origin = origin, .direction = target - origin};
    const Hit hit = caster.closest_hit(ray);
    const Hit expected = embree.closest_hit(ray);
    ASSERT_TRUE(hit.is_hit()) << i;
    if (is_delicate(mesh, ray, hit)) continue;
    ASSERT_EQ(hit.primitive, expected.primitive) << i;
    EXPECT_NEAR(hit.t, expected.t, 1e-4 * hit.t);
    EXPECT_NEAR(hit.u, expected.u, 1e-2);
    EXPECT_NEAR(hit.v, expected.v, 1e-2);
    ++compared;
  }
  EXPECT_GT(compared, 10000);
}

TEST(Embree, hits_the_same_triangles_of_a_ball) {
  expect_agreement(rough_ball(20, 0.05f, 1));
}

TEST(Embree, hits_the_same_triangles_of_the_bunny) {
  const std::string path = BOXWOOD_SHARED_DIR "/models/stanford-bunny.obj";
  const Mesh mesh = read_plain_obj(path);
  if (mesh.triangles.empty()) GTEST_SKIP() << path << " is missing";
  expect_agreement(mesh);
}

}  // namespace
}  // namespace tracer
#endif
