// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace app {

/// Notices when the contents of a file, or of one of those it depends on, were replaced. Looks at
/// their times and sizes when asked, at most once a second; a change counts when it has stayed the
/// same for one look, so that a file that is still being written is left alone.
class FileWatch {
 public:
  /// From now on this file, and no other.
  void watch(const std::filesystem::path& path);
  /// This one too.
  void add(const std::filesystem::path& path);
  bool has_changed(double now_seconds);

 private:
  struct Stamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t size_bytes = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct File {
    std::filesystem::path path;
    Stamp known;
    Stamp seen;
  };
  static Stamp stamp_of(const std::filesystem::path& path);
  static bool has_changed(File& file);

  std::vector<File> files_;
  double next_look_seconds_ = 0;
};

}  // namespace app
