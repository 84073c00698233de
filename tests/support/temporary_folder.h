// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace tracer {

/// An empty folder of a test's own, removed with all in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "boxwood_XXXXXX").string();
    if (const char* made = mkdtemp(name.data())) path_ = made;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file, with its folders, and returns its full path.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path full_path = path_ / name;
    std::filesystem::create_directories(full_path.parent_path());
    std::ofstream(full_path, std::ios::binary) << bytes;
    return full_path;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace tracer
