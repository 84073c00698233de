// SPDX-License-Identifier: MIT
// Rows of a table that a user chooses by name. A row has a name, what it is, and is_in_quick:
// whether a quick run takes it unasked.
#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/bench/compare/options.h"

namespace bench {

template <class Row>
std::string list_of(std::span<const Row> table) {
  std::string list;
  for (const Row& row : table) list += fmt::format("  {:<12} {}\n", row.name, row.what);
  return list;
}

/// In the table's order. Throws std::invalid_argument for a name that is not in it.
template <class Row>
std::vector<const Row*> chosen_from(std::span<const Row> table, const Options& options) {
  for (const std::string& name : options.scenes) {
    if (std::ranges::find(table, name, &Row::name) != table.end()) continue;
    throw std::invalid_argument(
        fmt::format("there is no '{}'; there are:\n{}", name, list_of(table)));
  }
  std::vector<const Row*> chosen;
  for (const Row& row : table) {
    const bool is_default = options.effort == Effort::full || row.is_in_quick;
    const bool is_named = std::ranges::find(options.scenes, row.name) != options.scenes.end();
    if (options.scenes.empty() ? is_default : is_named) chosen.push_back(&row);
  }
  return chosen;
}

}  // namespace bench
