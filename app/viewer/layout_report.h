// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tracer/base/vectors.h"

namespace app {

/// Where each widget is, in window coordinates, for whoever drives the window from outside: tests,
/// macro tools, aids for people. A JSON object of name: [x0, y0, x1, y1].
class LayoutReport {
 public:
  /// Writes nothing when the path is empty.
  explicit LayoutReport(std::filesystem::path path) : path_(std::move(path)) {}

  void note(const std::string& name, const tracer::Vec2f& min, const tracer::Vec2f& max);
  /// The rectangle of the widget that was last submitted.
  void note_last_item(const std::string& name);
  /// Ends a frame; writes the file when anything moved, whole or not at all.
  void finish_frame();

 private:
  struct Rectangle {
    int x0, y0, x1, y1;
    friend bool operator==(const Rectangle&, const Rectangle&) = default;
  };
  std::filesystem::path path_;
  std::map<std::string, Rectangle> noted_;
  std::map<std::string, Rectangle> written_;
};

}  // namespace app
