// SPDX-License-Identifier: MIT
#include "tests/bench/compare/load_memory.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/support/run_program.h"
#include "tracer/base/parallel.h"

namespace bench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NumberCheck, checked, wrong)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadOnce, triangles, mesh_bytes, peak_bytes, held_bytes, numbers)

namespace {

/// Of this process, without what is mapped of files.
size_t own_bytes(int status_file) {
  char text[4096];
  const ssize_t size = pread(status_file, text, sizeof text - 1, 0);
  text[std::max<ssize_t>(0, size)] = '\0';
  const char* const line = std::strstr(text, "RssAnon:");
  return line == nullptr ? 0 : 1024 * std::strtoull(line + 8, nullptr, 10);
}

/// Looks many times a millisecond, from a thread of its own, as the system keeps no such maximum.
class PeakWatch {
 public:
  PeakWatch()
      : status_(open("/proc/self/status", O_RDONLY | O_CLOEXEC)), before_(own_bytes(status_)) {
    watch_ = std::thread([this] {
      while (!is_done_) {
        peak_ = std::max(peak_, own_bytes(status_));
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    });
  }
  ~PeakWatch() {
    stop();
    close(status_);
  }
  PeakWatch(const PeakWatch&) = delete;
  PeakWatch& operator=(const PeakWatch&) = delete;

  size_t held() const { return above(own_bytes(status_)); }
  size_t stop() {
    is_done_ = true;
    if (watch_.joinable()) watch_.join();
    return above(peak_);
  }

 private:
  size_t above(size_t bytes) const { return bytes - std::min(bytes, before_); }

  int status_;
  size_t before_;
  size_t peak_ = 0;
  std::atomic<bool> is_done_{false};
  std::thread watch_;
};

LoadOnce load_watched(const ObjLoader& loader, const std::filesystem::path& path) {
  LoadOnce once;
  PeakWatch watch;
  const LoadedModel model = loader.load(path);
  once.held_bytes = watch.held();
  once.peak_bytes = std::max(watch.stop(), once.held_bytes);
  once.triangles = model.triangle_count;
  once.mesh_bytes = model.bytes;
  once.numbers = check_numbers(path, model);
  return once;
}

}  // namespace

LoadOnce load_in_child(const ObjLoader& loader, const std::filesystem::path& path,
                       int thread_count) {
  const tests::ProgramResult result =
      tests::ChildProgram("/proc/self/exe", {"load-once", "--loader", loader.name, "--threads",
                                             std::to_string(thread_count), "--file", path.string()})
          .wait();
  if (result.exit_code != 0) {
    throw std::runtime_error(fmt::format("{} ends with {} on {}: {}", loader.name, result.exit_code,
                                         path.string(), result.err));
  }
  return nlohmann::json::parse(result.out).get<LoadOnce>();
}

int load_once(const Options& options) {
  const auto loader = std::ranges::find(obj_loaders(), options.loader, &ObjLoader::name);
  if (loader == obj_loaders().end()) {
    throw std::invalid_argument("there is no loader '" + options.loader + "'");
  }
  const LoadOnce once = tracer::with_thread_count(
      options.thread_count, [&] { return load_watched(*loader, options.file); });
  fmt::print("{}\n", nlohmann::json(once).dump());
  return 0;
}

}  // namespace bench
