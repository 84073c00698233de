// SPDX-License-Identifier: MIT
#include "tests/bench/compare/load_in_child.h"

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
#include <sys/mman.h>
#include <unistd.h>

#include "app/stopwatch.h"
#include "tests/support/run_program.h"
#include "tracer/base/parallel.h"

namespace bench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NumberCheck, checked, wrong)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadTime, seconds, triangles)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadMemory, mesh_bytes, peak_bytes, held_bytes, numbers)

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

/// Takes so much memory, as the largest loaders do, and gives it back. The host of a virtual
/// machine may have to find memory that its guest has not used for a while, half a second a
/// gigabyte: no loader can help it, and it comes to one at random.
void warm_memory(size_t bytes) {
  constexpr int rights = PROT_READ | PROT_WRITE;
  void* const memory = mmap(nullptr, bytes, rights, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  madvise(memory, bytes, MADV_HUGEPAGE);
  std::memset(memory, 1, bytes);
  munmap(memory, bytes);
}

/// Has all threads run for a while: the system may begin a new one on a core that is taken, and
/// move it milliseconds later.
void warm_threads() {
  tracer::parallel_workers([] {
    const app::Stopwatch stopwatch;
    while (stopwatch.seconds() < 0.02) {
    }
  });
}

template <class Record>
Record in_child(const char* command, const ObjLoader& loader, const std::filesystem::path& path,
                int thread_count) {
  const tests::ProgramResult result =
      tests::ChildProgram("/proc/self/exe", {command, "--loader", loader.name, "--threads",
                                             std::to_string(thread_count), "--file", path.string()})
          .wait();
  if (result.exit_code != 0) {
    throw std::runtime_error(fmt::format("{} ends with {} on {}: {}", loader.name, result.exit_code,
                                         path.string(), result.err));
  }
  return nlohmann::json::parse(result.out).get<Record>();
}

/// Prints what `measure` makes of the loader that the options name.
template <class Measure>
int as_child(const Options& options, const Measure& measure) {
  const auto loader = std::ranges::find(obj_loaders(), options.loader, &ObjLoader::name);
  if (loader == obj_loaders().end()) {
    throw std::invalid_argument("there is no loader '" + options.loader + "'");
  }
  const auto record =
      tracer::with_thread_count(options.thread_count, [&] { return measure(*loader); });
  fmt::print("{}\n", nlohmann::json(record).dump());
  return 0;
}

}  // namespace

LoadTime time_load(const ObjLoader& loader, const std::filesystem::path& path, int thread_count) {
  return in_child<LoadTime>("load-once", loader, path, thread_count);
}

LoadMemory watch_load(const ObjLoader& loader, const std::filesystem::path& path,
                      int thread_count) {
  return in_child<LoadMemory>("load-watched", loader, path, thread_count);
}

int load_once(const Options& options) {
  return as_child(options, [&](const ObjLoader& loader) {
    warm_memory(5 * std::filesystem::file_size(options.file));
    warm_threads();
    const app::Stopwatch stopwatch;
    const LoadedModel model = loader.load(options.file);
    return LoadTime{stopwatch.seconds(), model.triangle_count};
  });
}

int load_watched(const Options& options) {
  return as_child(options, [&](const ObjLoader& loader) {
    LoadMemory memory;
    PeakWatch watch;
    const LoadedModel model = loader.load(options.file);
    memory.held_bytes = watch.held();
    memory.peak_bytes = std::max(watch.stop(), memory.held_bytes);
    memory.mesh_bytes = model.bytes;
    memory.numbers = check_numbers(options.file, model);
    return memory;
  });
}

}  // namespace bench
