// SPDX-License-Identifier: MIT
#include "app/build_accel.h"

#include <utility>
#include <vector>

#include "app/session_changes.h"
#include "tracer/bvh/build/reinsertion.h"

namespace app {

bool is_same_tree(const TreeKey& a, const TreeKey& b) {
  if (a.builder == nullptr && b.builder == nullptr) return true;
  return a.builder == b.builder && a.layout == b.layout &&
         a.improvement_rounds == b.improvement_rounds &&
         !differs(a.settings, b.settings, tracer::Effect::rebuild);
}

BuiltAccel build_accel(const std::shared_ptr<const tracer::Mesh>& mesh, const TreeKey& key,
                       tracer::Progress& progress) {
  std::optional<tracer::BvhTree> tree;
  if (key.builder != nullptr) {
    progress.start_stage("building the tree");
    const auto boxes = primitive_boxes(*mesh);
    tree = key.builder->build(mesh_primitives(*mesh, boxes), key.settings, progress);
    if (key.improvement_rounds > 0) progress.start_stage("improving the tree");
    for (int round = 0; round < key.improvement_rounds; ++round) {
      *tree = reinsert(*tree, key.settings, progress);
    }
  }
  return lay_out(mesh, std::move(tree), *key.layout, progress);
}

BuiltAccel lay_out(const std::shared_ptr<const tracer::Mesh>& mesh,
                   std::optional<tracer::BvhTree> tree, const tracer::Layout& layout,
                   tracer::Progress& progress) {
  auto shared = tree ? std::make_shared<const tracer::BvhTree>(*std::move(tree)) : nullptr;
  auto accel = std::make_shared<const tracer::Accel>(make_accel(mesh, shared, layout, progress));
  return {std::move(accel), std::move(shared)};
}

}  // namespace app
