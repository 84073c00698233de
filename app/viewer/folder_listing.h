// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct FolderEntry {
  std::string name;
  bool is_folder = false;
  uint64_t size_bytes = 0;  // of a file
};

/// What the open dialog shows of a folder: its folders, then its OBJ files, by name.
struct FolderListing {
  std::filesystem::path folder;  // absolute
  std::vector<FolderEntry> entries;
  std::string error;  // in words, when the folder cannot be read
};

FolderListing list_folder(const std::filesystem::path& folder);

/// Entries whose names contain `filter`, in any case of ASCII letters. Names with a leading dot
/// are left out unless the filter has one too.
std::vector<FolderEntry> filter_entries(const std::vector<FolderEntry>& entries,
                                        std::string_view filter);

}  // namespace app
