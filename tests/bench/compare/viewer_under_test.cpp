// SPDX-License-Identifier: MIT
#include "tests/bench/compare/viewer_under_test.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "app/stopwatch.h"

namespace bench {
namespace {

constexpr double patience_seconds = 120;

std::vector<std::string> arguments_for(const std::filesystem::path& model,
                                       const std::filesystem::path& layout_file) {
  return {"view", "--size", "1280x720", "--ui-layout", layout_file.string(), model.string()};
}

}  // namespace

ViewerUnderTest::ViewerUnderTest(const std::filesystem::path& model)
    : layout_file_(model.string() + ".layout.json"),
      program_(BOXWOOD_PROGRAM, arguments_for(model, layout_file_)) {}

tests::Rectangle ViewerUnderTest::widget(const std::string& name) const {
  const app::Stopwatch stopwatch;
  while (stopwatch.seconds() < patience_seconds) {
    if (const auto at = tests::find_widget(layout_file_, name)) return *at;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("the window shows no '" + name + "'");
}

}  // namespace bench
