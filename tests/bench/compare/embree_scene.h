// SPDX-License-Identifier: MIT
// Embree, where it is installed: the measure of speed.
#pragma once

#ifdef BOXWOOD_EMBREE
#include <atomic>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

#include "tests/bench/compare/tracers.h"

namespace bench {

enum class EmbreeMode { standard, robust };

/// A mesh in Embree, which shares the mesh's indices and a copy of its positions.
class EmbreeScene {
 public:
  EmbreeScene(const tracer::Mesh& mesh, RTCBuildQuality quality, EmbreeMode mode);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Builds the tree; once.
  void build() { rtcCommitScene(scene_); }
  /// What Embree holds now, beside the mesh.
  int64_t bytes() const { return bytes_; }
  RTCScene scene() const { return scene_; }

 private:
  tracer::LargeVector<tracer::Vec3f> positions_;  // one more: Embree reads 16 bytes of each
  std::atomic<int64_t> bytes_{0};
  RTCDevice device_;
  RTCScene scene_;
};

/// For rtcIntersect1.
RTCRayHit make_query(const tracer::Ray& ray);

/// Both scenes are built and outlive the tracers.
std::vector<Tracer> embree_tracers(const EmbreeScene& standard, const EmbreeScene& robust);

/// As in "Embree 3.13.5".
std::string embree_version();

}  // namespace bench
#endif
