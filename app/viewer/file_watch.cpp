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
  files_.clear();
  add(path);
}

void FileWatch::add(const std::filesystem::path& path) {
  const Stamp stamp = stamp_of(path);
  files_.push_back({path, stamp, stamp});
}

bool FileWatch::has_changed(double now_seconds) {
  if (files_.empty() || now_seconds < next_look_seconds_) return false;
  next_look_seconds_ = now_seconds + 1;
  bool has_any_changed = false;
  for (File& file : files_) has_any_changed |= has_changed(file);
  return has_any_changed;
}

bool FileWatch::has_changed(File& file) {
  const Stamp stamp = stamp_of(file.path);
  const bool is_settled = stamp == file.seen;
  file.seen = stamp;
  if (!is_settled || stamp == file.known || stamp == Stamp{}) return false;
  file.known = stamp;
  return true;
}

}  // namespace app
