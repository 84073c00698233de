// SPDX-License-Identifier: MIT
#include "tests/support/run_program.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tests {
namespace {

struct Channel {
  int read = -1;
  int write = -1;
};

Channel open_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  return {ends[0], ends[1]};
}

Channel open_terminal() {
  Channel terminal;
  winsize size{};
  size.ws_row = 24;
  size.ws_col = 80;
  if (openpty(&terminal.read, &terminal.write, nullptr, nullptr, &size) != 0) {
    throw std::runtime_error("openpty failed");
  }
  fcntl(terminal.read, F_SETFD, FD_CLOEXEC);
  fcntl(terminal.write, F_SETFD, FD_CLOEXEC);
  return terminal;
}

[[noreturn]] void become(const std::string& program, std::vector<char*>& arguments, int out,
                         int err, const char* working_directory) {
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  if (*working_directory && chdir(working_directory) != 0) _exit(126);
  execv(program.c_str(), arguments.data());
  _exit(127);
}

// Appends what there is to read; closes the stream at its end.
void drain(int& descriptor, std::string& text) {
  char buffer[4096];
  const ssize_t size = read(descriptor, buffer, sizeof buffer);
  if (size > 0) {
    text.append(buffer, static_cast<size_t>(size));
  } else {
    close(descriptor);
    descriptor = -1;
  }
}

}  // namespace

ChildProgram::ChildProgram(const std::string& program, const std::vector<std::string>& arguments,
                           ErrorStream error_stream,
                           const std::filesystem::path& working_directory) {
  std::vector<char*> pointers{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  const Channel out = open_pipe();
  const Channel err = error_stream == ErrorStream::pipe ? open_pipe() : open_terminal();
  pid_ = fork();
  if (pid_ == 0) become(program, pointers, out.write, err.write, working_directory.c_str());
  close(out.write);
  close(err.write);
  out_ = out.read;
  err_ = err.read;
}

ChildProgram::~ChildProgram() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_ >= 0) close(out_);
  if (err_ >= 0) close(err_);
}

void ChildProgram::send_signal(int signal) const {
  kill(pid_, signal);
}

template <class Condition>
bool ChildProgram::read_until(const Condition& is_enough, double timeout_seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_seconds);
  while (!is_enough()) {
    if (Clock::now() > end || (out_ < 0 && err_ < 0)) return false;
    // poll passes over descriptors below 0.
    pollfd streams[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
    poll(streams, 2, 100);
    if (streams[0].revents != 0) drain(out_, result_.out);
    if (streams[1].revents != 0) drain(err_, result_.err);
  }
  return true;
}

bool ChildProgram::wait_for_error_text(const std::string& text, double timeout_seconds) {
  return read_until([&] { return result_.err.find(text) != std::string::npos; }, timeout_seconds);
}

ProgramResult ChildProgram::wait(double timeout_seconds) {
  if (!read_until([&] { return out_ < 0 && err_ < 0; }, timeout_seconds)) {
    kill(pid_, SIGKILL);
    result_.err += "\n(killed by the test's time limit)";
  }
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  result_.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return result_;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace tests
