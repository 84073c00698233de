// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/camera_controls.h"
#include "app/viewer/folder_listing.h"
#include "app/viewer/panels/rows.h"

namespace app {

/// Chooses an OBJ file: type to narrow the list, arrows and Enter or the mouse to choose,
/// Backspace on an empty filter for the parent folder.
class OpenDialog {
 public:
  void open(const std::filesystem::path& folder);
  void close() { is_open_ = false; }
  bool is_open() const { return is_open_; }
  /// GLFW's key. A file chosen by it closes the dialog and is returned.
  std::optional<std::filesystem::path> press_key(int key);
  /// The same for the mouse.
  std::optional<std::filesystem::path> draw(const Ui& ui, const PictureArea& area);

 private:
  void show_folder(const std::filesystem::path& folder);
  void apply_filter();
  std::optional<std::filesystem::path> choose(const FolderEntry& entry);
  std::optional<std::filesystem::path> draw_entries(const Ui& ui, float height);
  bool draw_entry(const Ui& ui, size_t entry_index);

  bool is_open_ = false;
  bool has_moved_ = false;  // the selection is to be scrolled to
  bool takes_focus_ = false;
  FolderListing listing_;
  std::vector<FolderEntry> shown_;
  size_t selected_ = 0;
  std::array<char, 256> filter_{};
};

}  // namespace app
