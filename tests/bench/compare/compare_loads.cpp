// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/load_files.h"
#include "tests/bench/compare/load_in_child.h"
#include "tests/bench/compare/load_records.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/obj_loaders.h"
#include "tests/bench/compare/pinned_threads.h"
#include "tests/bench/compare/report_files.h"

namespace bench {
namespace {

using Path = std::filesystem::path;

struct Contestant {
  const ObjLoader* loader = nullptr;
  int threads = 1;
  std::vector<double> seconds{};  // one a round
  uint64_t triangles = 0;
};

std::vector<Contestant> contestants() {
  const int most_threads = std::min(2, processor_count());
  std::vector<Contestant> all;
  for (const ObjLoader& loader : obj_loaders()) {
    for (int threads = 1; threads <= std::min(most_threads, loader.most_threads); ++threads) {
      all.push_back({&loader, threads});
    }
  }
  return all;
}

// Round by round, so that noise meets all of them. The first round, untimed, brings the file into
// memory and must agree on its triangles.
void run_rounds(const Path& path, int round_count, std::vector<Contestant>& all) {
  uint64_t expected_triangles = 0;
  for (int round = -1; round < round_count; ++round) {
    for (Contestant& contestant : all) {
      const auto [seconds, triangles] = time_load(*contestant.loader, path, contestant.threads);
      if (round >= 0) contestant.seconds.push_back(seconds);
      contestant.triangles = triangles;
      if (expected_triangles == 0) expected_triangles = triangles;
      if (triangles != expected_triangles) {
        throw std::runtime_error(fmt::format("{} loads {} triangles of {}, boxwood {}",
                                             contestant.loader->name, triangles, path.string(),
                                             expected_triangles));
      }
    }
  }
}

const Contestant* find(const std::vector<Contestant>& all, const char* loader, int threads) {
  const auto found = std::ranges::find_if(all, [&](const Contestant& contestant) {
    return contestant.loader->name == loader && contestant.threads == threads;
  });
  return found == all.end() ? nullptr : &*found;
}

double speed_ratio(const Contestant* reference, const Contestant& contestant) {
  return reference == nullptr ? 0 : paired_ratio(reference->seconds, contestant.seconds);
}

LoadRecord make_record(const LoadFile& file, const Path& path, const Contestant& contestant,
                       const std::vector<Contestant>& all) {
  LoadRecord record;
  record.file = file.name;
  record.file_bytes = std::filesystem::file_size(path);
  record.loader = contestant.loader->name;
  record.threads = contestant.threads;
  record.rounds = static_cast<int>(contestant.seconds.size());
  std::vector<double> speeds;
  for (const double seconds : contestant.seconds) {
    speeds.push_back(1e-6 * static_cast<double>(record.file_bytes) / seconds);
  }
  record.megabytes_a_second = spread_of(speeds);
  record.ratio_to_tinyobjloader = speed_ratio(find(all, "tinyobjloader", 1), contestant);
  if (contestant.threads > 1) {
    record.ratio_to_one_thread = speed_ratio(find(all, record.loader.c_str(), 1), contestant);
  }
  const LoadMemory memory = watch_load(*contestant.loader, path, contestant.threads);
  record.peak_bytes = memory.peak_bytes;
  record.mesh_bytes = memory.mesh_bytes;
  record.triangles = contestant.triangles;
  record.numbers = memory.numbers;
  return record;
}

std::vector<LoadRecord> compare_file(const LoadFile& file, const Path& path, int repeat_count) {
  std::vector<Contestant> all = contestants();
  const double rounds = std::ceil(repeat_count * file.rounds_a_repeat);
  run_rounds(path, static_cast<int>(rounds), all);
  std::vector<LoadRecord> records;
  for (const Contestant& contestant : all) {
    records.push_back(make_record(file, path, contestant, all));
    records.back().mesh_bytes = records.front().mesh_bytes;
    fmt::print("{}\n", table_line(records.back()));
    std::fflush(stdout);
  }
  return records;
}

}  // namespace

int compare_loads(const Options& options) {
  const std::string machine = machine_line();
  fmt::print("{}\n", machine);
  for (const std::string& name : missing_obj_loaders()) fmt::print("{}: not found\n", name);
  std::vector<LoadRecord> records;
  for (const LoadFile* file : chosen_from(load_files(), options)) {
    const tracer::TemporaryFolder folder;  // the file goes with it before the next is written
    const auto path = file->make(folder);
    if (!path) {
      fmt::print("{}: SKIPPED, it is missing\n", file->name);
      continue;
    }
    const auto measured = compare_file(*file, *path, options.repeat_count);
    records.insert(records.end(), measured.begin(), measured.end());
  }
  if (records.empty()) return 1;
  write_report(options.folder / "load", records, load_chart(records, machine));
  return std::ranges::all_of(records,
                             [](const LoadRecord& record) {
                               return !record.is_ours() || record.numbers.wrong == 0;
                             })
             ? 0
             : 1;
}

}  // namespace bench
