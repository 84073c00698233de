// SPDX-License-Identifier: MIT
#include "app/viewer/file_watch.h"

#include <system_error>

namespace app {

FileWatch::Stamp FileWatch::stamp_of(const std::filesystem::path& path) {
  std::error_code error;
  Stamp stamp;
  stamp.time = std::filesystem::last_write_time(path, error);
  if (error) return {};
  stamp.size_bytes = std::filesystem::file_size(path, error);
  return error ? Stamp{} : stamp;
}

void FileWatch::watch(const std::filesystem::path& path) {
  path_ = path;
  known_ = seen_ = stamp_of(path);
}

bool FileWatch::has_changed(double now_seconds) {
  if (path_.empty() || now_seconds < next_look_seconds_) return false;
  next_look_seconds_ = now_seconds + 1;
  const Stamp stamp = stamp_of(path_);
  const bool is_settled = stamp == seen_;
  seen_ = stamp;
  if (!is_settled || stamp == known_ || stamp == Stamp{}) return false;
  known_ = stamp;
  return true;
}

}  // namespace app
