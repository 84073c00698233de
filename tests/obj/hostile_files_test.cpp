// SPDX-License-Identifier: MIT
// Files that are no models, or that would hang or exhaust a careless loader.
#include <atomic>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/obj/faulty_file.h"
#include "tests/support/random_source.h"

namespace tests {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double processor_seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

/// What a process holds at the moment beside what it has mapped of files; 0 when it is gone.
double own_megabytes(pid_t pid) {
  // Before it becomes the program, a child has this test's memory.
  std::error_code gone;
  const auto program = std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", gone);
  if (gone || program.filename() != std::filesystem::path(BOXWOOD_PROGRAM).filename()) return 0;
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("RssAnon:")) return std::stod(line.substr(8)) / 1024;
  }
  return 0;
}

struct WatchedRun {
  ProgramResult result;
  double processor_seconds = 0;
  double most_megabytes = 0;
};

WatchedRun run_watched(const std::string& model) {
  WatchedRun run;
  const double seconds_before = processor_seconds_of_children();
  ChildProgram program(BOXWOOD_PROGRAM, {"info", model, "--bvh", "off"});
  std::atomic<bool> is_done{false};
  std::thread watch([&, pid = program.pid()] {
    while (!is_done) {
      run.most_megabytes = std::max(run.most_megabytes, own_megabytes(pid));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  run.result = program.wait();
  is_done = true;
  watch.join();
  run.processor_seconds = processor_seconds_of_children() - seconds_before;
  return run;
}

/// Writes `megabytes` of `piece`, over and over.
void write_many(std::ofstream& file, const std::string& piece, int megabytes) {
  std::string block;
  while (block.size() < 1000000) block += piece;
  for (int i = 0; i < megabytes; ++i) file << block;
}

TEST(HostileFiles, an_empty_file_is_one_line_and_exit_code_2) {
  expect_as_described({"empty", "", 0, 0, {{0, "the file is empty"}}});
  expect_as_described({"a newline", "\n", 0, 0, {{0, "no triangles to show"}}});
  expect_as_described({"a byte order mark", "\xef\xbb\xbf", 0, 0, {{0, "no triangles to show"}}});
  expect_as_described({"vertices alone", "v 0 0 0\n", 0, 0, {{0, "no faces"}}});
}

TEST(HostileFiles, random_bytes_are_refused_in_words) {
  tracer::RandomSource random(7);
  for (int round = 0; round < 4; ++round) {
    std::string bytes(1000000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.word());
    expect_as_described({"random bytes", bytes, 0, 0, {{0, "no triangles to show"}}});
  }
}

TEST(HostileFiles, random_bytes_between_lines_cost_no_triangle) {
  tracer::RandomSource random(11);
  std::string noise = "#";
  for (int i = 0; i < 100000; ++i) noise += static_cast<char>(random.word() | 0x80);
  const TemporaryFolder folder;
  const Loading loading = load(folder.write("model.obj", triangle + noise + '\n' + "f 1 3 2\n"));
  ASSERT_TRUE(loading.scene) << loading.error;
  EXPECT_EQ(loading.scene->scene.mesh->triangle_count(), 2u);
}

TEST(HostileFiles, a_megabyte_of_zero_bytes_is_refused_in_words) {
  const std::string zeros(1 << 20, '\0');
  expect_as_described({"zeros", zeros, 0, 0, {{0, "no triangles to show"}}});
}

TEST(HostileFiles, zero_bytes_within_a_model_harm_their_line_alone) {
  const std::string zeros(1 << 20, '\0');
  expect_as_described({"a line of zeros", triangle + zeros + "\nf 1 3 2\n", 2, 0, {}});
  expect_as_described({"a zero in a face",
                       triangle + std::string("f 1 \0 2 3\n", 10) + "f 1 3 2\n",
                       2,
                       1,
                       {{5, "malformed"}}});
}

TEST(HostileFiles, a_comment_of_200_megabytes_on_one_line_is_passed_over) {
  const TemporaryFolder folder;
  const std::string path = folder / "model.obj";
  std::ofstream file(path);
  file << triangle << '#';
  write_many(file, " comment 1 2 3", 200);
  file << "\nf 1 3 2\nf 1 2 9\n";
  file.close();
  const WatchedRun run = run_watched(path);
  EXPECT_EQ(run.result.exit_code, 0) << run.result.err;
  EXPECT_NE(run.result.out.find("triangles      2\n"), std::string::npos) << run.result.out;
  EXPECT_NE(run.result.err.find(":7: vertex 9 does not exist"), std::string::npos)
      << run.result.err;
  if (is_sanitized) return;
  EXPECT_LT(run.processor_seconds, 1);
  EXPECT_LT(run.most_megabytes, 150);
}

TEST(HostileFiles, a_face_of_200_megabytes_on_one_line_is_refused_quickly_in_little_memory) {
  const TemporaryFolder folder;
  const std::string path = folder / "model.obj";
  for (const char* corner : {" 1 2 3", " 1/1/1 2//2 3/3", " 0000000000000000000001"}) {
    std::ofstream file(path);
    file << triangle << 'f';
    write_many(file, corner, 200);
    file << "\nf 1 3 2\n";
    file.close();
    const WatchedRun run = run_watched(path);
    EXPECT_EQ(run.result.exit_code, 0) << run.result.err;
    EXPECT_NE(run.result.out.find("triangles      2\n"), std::string::npos) << run.result.out;
    EXPECT_NE(run.result.err.find(path + ":5: the face "), std::string::npos) << run.result.err;
    if (is_sanitized) continue;
    EXPECT_LT(run.processor_seconds, 1) << corner;
    EXPECT_LT(run.most_megabytes, 200) << corner;
  }
}

TEST(HostileFiles, a_folder_a_device_and_a_pipe_are_refused) {
  const TemporaryFolder folder;
  expect_refused(folder.path(), "this is a directory");
  expect_refused("/dev/zero", "this is not a regular file");
  const std::string pipe = folder / "model.obj";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_refused(pipe, "this is not a regular file");
}

TEST(HostileFiles, a_missing_file_is_said_to_be_missing) {
  const TemporaryFolder folder;
  expect_refused(folder / "model.obj", "");
}

/// This process and its children as a user who may not read what belongs to others.
class Nobody {
 public:
  Nobody() { is_nobody_ = geteuid() != 0 || seteuid(65534) == 0; }
  ~Nobody() {
    if (getuid() == 0 && seteuid(0) != 0) std::abort();
  }
  Nobody(const Nobody&) = delete;
  Nobody& operator=(const Nobody&) = delete;
  bool is_nobody() const { return is_nobody_; }

 private:
  bool is_nobody_ = false;
};

TEST(HostileFiles, a_file_that_may_not_be_read_is_refused) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "leaks cannot be looked for in a process that changed its user";
#endif
  const TemporaryFolder folder;
  const std::string path = folder.write("model.obj", triangle);
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  ASSERT_EQ(chmod(path.c_str(), 0), 0);
  const Nobody nobody;
  if (!nobody.is_nobody()) GTEST_SKIP() << "this user can read every file";
  if (access(BOXWOOD_PROGRAM, X_OK) != 0) GTEST_SKIP() << "others may not run the program";
  expect_refused(path, "Permission denied");
}

TEST(HostileFiles, standard_input_may_be_a_device_of_no_bytes) {
  const ProgramResult result = run_boxwood({"info", "-"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("empty"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace tests
