// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "tests/support/temporary_folder.h"

namespace tests {

struct ProgramResult {
  int exit_code = 0;  // 128 + the signal's number where a signal ended it
  std::string out;
  std::string err;
};

/// Where standard error goes: into a pipe, or a terminal of 80 columns.
enum class ErrorStream { pipe, terminal };

/// A child process, its standard input empty. It is killed when it outlives `timeout_seconds` or
/// this object.
class ChildProgram {
 public:
  ChildProgram(const std::string& program, const std::vector<std::string>& arguments,
               ErrorStream error_stream = ErrorStream::pipe,
               const std::filesystem::path& working_directory = {});
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  pid_t pid() const { return pid_; }
  void send_signal(int signal) const;
  /// Whether `text` came on standard error in time.
  bool wait_for_error_text(const std::string& text, double timeout_seconds = 60);
  /// Waits for the end; once.
  ProgramResult wait(double timeout_seconds = 120);

 private:
  template <class Condition>
  bool read_until(const Condition& is_enough, double timeout_seconds);

  pid_t pid_ = -1;
  int out_ = -1;
  int err_ = -1;
  ProgramResult result_;
};

/// Runs BOXWOOD_PROGRAM to its end.
inline ProgramResult run_boxwood(const std::vector<std::string>& arguments) {
  return ChildProgram(BOXWOOD_PROGRAM, arguments).wait();
}

using tracer::TemporaryFolder;

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace tests
