// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include "tracer/base/fields.h"

namespace tracer {

/// What every traversal's stack has room for; builders go no deeper, whatever the settings say.
inline constexpr int max_tree_depth = 64;

struct BuildSettings {
  int max_depth = 30;  // no leaf lies deeper; the root has depth 0
  int leaf_size = 4;   // a node of at most this many primitives is not split
  // What the surface area cost of a tree charges, relative to each other. Above the leaf size all
  // is split, so they weigh trees against each other and do not change one.
  double traversal_cost = 1;     // a node entered
  double intersection_cost = 1;  // a primitive tested
  int bins = 16;                 // along each axis, of builders that bin centres
  int block_size = 1;            // primitives that are tested at once
  double split_budget = 0.5;  // spatial splits: references beyond the primitives, as part of them
};

template <class Settings, class F>
requires std::same_as<std::remove_const_t<Settings>, BuildSettings>
void for_each_field(Settings& settings, F&& f) {
  f(settings.max_depth,
    Field<int>{"max-depth", 1, max_tree_depth, "levels of the tree at most", Effect::rebuild});
  f(settings.leaf_size,
    Field<int>{"leaf-size", 1, 64, "nodes of so few triangles are not split", Effect::rebuild});
  f(settings.traversal_cost,
    Field<double>{"traversal-cost", 0.1, 10, "of a node, in the SAH cost that is shown",
                  Effect::rebuild});
  f(settings.intersection_cost,
    Field<double>{"intersection-cost", 0.1, 10, "of a triangle, in the SAH cost that is shown",
                  Effect::rebuild});
  f(settings.bins,
    Field<int>{"bins", 4, 64, "along each axis, where centres are binned", Effect::rebuild});
  f(settings.block_size,
    Field<int>{"block-size", 1, 16, "triangles the SAH counts as one", Effect::rebuild});
  f(settings.split_budget,
    Field<double>{"split-budget", 0, 2, "references that spatial splits may add, a triangle",
                  Effect::rebuild});
}

}  // namespace tracer
