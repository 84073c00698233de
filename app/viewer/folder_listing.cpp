// SPDX-License-Identifier: MIT
#include "app/viewer/folder_listing.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <tuple>

namespace app {
namespace {

namespace fs = std::filesystem;

std::string to_lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return lower;
}

bool is_before(const FolderEntry& a, const FolderEntry& b) {
  const std::string a_lower = to_lower(a.name);
  const std::string b_lower = to_lower(b.name);
  return std::tie(b.is_folder, a_lower, a.name) < std::tie(a.is_folder, b_lower, b.name);
}

}  // namespace

FolderListing list_folder(const fs::path& folder) {
  FolderListing listing;
  std::error_code error;
  listing.folder = fs::weakly_canonical(fs::absolute(folder, error), error);
  if (listing.folder.empty()) listing.folder = folder;
  fs::directory_iterator entry(listing.folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const std::string name = entry->path().filename().string();
    if (entry->is_directory(ignored)) {
      listing.entries.push_back({name, true, 0});
    } else if (to_lower(entry->path().extension().string()) == ".obj") {
      const uintmax_t size_bytes = entry->file_size(ignored);
      listing.entries.push_back({name, false, ignored ? 0 : size_bytes});
    }
  }
  if (error) listing.error = error.message();
  std::sort(listing.entries.begin(), listing.entries.end(), is_before);
  return listing;
}

std::vector<FolderEntry> filter_entries(const std::vector<FolderEntry>& entries,
                                        std::string_view filter) {
  const std::string wanted = to_lower(filter);
  std::vector<FolderEntry> kept;
  for (const FolderEntry& entry : entries) {
    if (entry.name.starts_with('.') && !wanted.starts_with('.')) continue;
    if (to_lower(entry.name).find(wanted) != std::string::npos) kept.push_back(entry);
  }
  return kept;
}

}  // namespace app
