// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace tests {

/// Pixels [x0, x1) x [y0, y1) of the screen.
struct Rectangle {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Where the viewer says in `layout_file` (BOXWOOD_UI_LAYOUT) that a widget is; nothing while there
/// is none of that name.
inline std::optional<Rectangle> find_widget(const std::filesystem::path& layout_file,
                                            const std::string& name) {
  std::ifstream file(layout_file);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains(name)) return std::nullopt;
  const auto& at = json[name];
  return Rectangle{at[0], at[1], at[2], at[3]};
}

}  // namespace tests
