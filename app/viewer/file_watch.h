// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace app {

/// Notices when a file's contents were replaced. Looks at its time and size when asked, at most
/// once a second; a change counts when it has stayed the same for one look, so that a file that is
/// still being written is left alone.
class FileWatch {
 public:
  void watch(const std::filesystem::path& path);
  bool has_changed(double now_seconds);

 private:
  struct Stamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t size_bytes = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  static Stamp stamp_of(const std::filesystem::path& path);

  std::filesystem::path path_;
  Stamp known_;
  Stamp seen_;
  double next_look_seconds_ = 0;
};

}  // namespace app
