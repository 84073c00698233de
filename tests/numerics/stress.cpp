// SPDX-License-Identifier: MIT
#include "tests/numerics/stress.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tracer::stress {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr uint64_t sanitizer_divisor = 50;
#else
constexpr uint64_t sanitizer_divisor = 1;
#endif

constexpr size_t most_replays = 5;
constexpr double seconds_between_lines = 10;

const char* results_path() {
  return std::getenv("BOXWOOD_NUMERICS");
}

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string test_name() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  return std::string(test.test_suite_name()) + '.' + test.name();
}

struct Result {
  std::string test;
  std::string property;
  Tally tally;
};

/// All results: a table on stdout at the end, and a file where it has a name.
class Results : public testing::Environment {
 public:
  void add(Result result) { results_.push_back(std::move(result)); }

  void TearDown() override {
    if (results_.empty()) return;
    print_table();
    if (is_long()) write_json();
  }

 private:
  void print_table() const {
    fmt::print("\n{:>13} {:>9} {:>13} {:>13} {:>9}  property\n", "trials", "failures", "control",
               "its failures", "worst");
    for (const auto& [test, property, tally] : results_) {
      const bool has_control = tally.control_checks > 0;
      fmt::print("{:>13} {:>9} {:>13} {:>13} {:>9}  {}\n", tally.checks, tally.failures,
                 has_control ? std::to_string(tally.control_checks) : "",
                 has_control ? std::to_string(tally.control_failures) : "",
                 tally.worst > 0 ? fmt::format("{:.3g}", tally.worst) : "", property);
    }
  }
  void write_json() const {
    std::ofstream file(results_path());
    file << "[\n";
    for (size_t i = 0; i < results_.size(); ++i) {
      const auto& [test, property, tally] = results_[i];
      file << fmt::format(R"(  {{"test": "{}", "property": "{}", "trials": {}, "failures": {}, )"
                          R"("control_trials": {}, "control_failures": {}, "worst": {:.9g}}})",
                          test, property, tally.checks, tally.failures, tally.control_checks,
                          tally.control_failures, tally.worst);
      file << (i + 1 < results_.size() ? ",\n" : "\n");
    }
    file << "]\n";
    file.flush();
    EXPECT_TRUE(file.good()) << results_path() << " cannot be written";
  }

  std::vector<Result> results_;
};

// GoogleTest owns it.
Results& results() {
  static Results* const environment = new Results;
  return *environment;
}
[[maybe_unused]] const testing::Environment* const registered =
    testing::AddGlobalTestEnvironment(&results());

}  // namespace

bool is_long() {
  return results_path() != nullptr;
}

uint64_t trials(uint64_t in_short, uint64_t in_long) {
  return is_long() ? in_long : std::max<uint64_t>(1, in_short / sanitizer_divisor);
}

double Tally::control_failures_per_million() const {
  return control_checks == 0
             ? 0
             : 1e6 * static_cast<double>(control_failures) / static_cast<double>(control_checks);
}

void Tally::add(const Tally& other) {
  checks += other.checks;
  failures += other.failures;
  control_checks += other.control_checks;
  control_failures += other.control_failures;
  worst = std::max(worst, other.worst);
  for (const std::string& replay : other.replays) {
    if (replays.size() < most_replays) replays.push_back(replay);
  }
}

void Trial::fail(const std::string& replay) {
  ++tally_.failures;
  if (tally_.replays.size() < most_replays) {
    tally_.replays.push_back(fmt::format("Trial({}, {}): {}", seed_, index, replay));
  }
}

ProgressLine::ProgressLine(std::string_view property, uint64_t trial_count)
    : property_(property), total_(trial_count), last_seconds_(seconds_now()) {}

ProgressLine::~ProgressLine() {
  if (is_long()) fmt::print(stderr, "{:>13} trials: {}\n", done_, property_);
}

void ProgressLine::done(uint64_t trial_count) {
  if (!is_long()) return;
  const std::scoped_lock lock(mutex_);
  done_ += trial_count;
  const double now = seconds_now();
  if (now - last_seconds_ < seconds_between_lines) return;
  last_seconds_ = now;
  fmt::print(stderr, "{:>13.0f} %: {}\n",
             100 * static_cast<double>(done_) / static_cast<double>(total_), property_);
}

void expect_holds(std::string_view property, const Tally& tally) {
  results().add({test_name(), std::string(property), tally});
  EXPECT_GT(tally.checks, 0u) << property;
  EXPECT_EQ(tally.failures, 0u) << property << ", of " << tally.checks;
  for (const std::string& replay : tally.replays) ADD_FAILURE() << property << ", " << replay;
}

void expect_holds_and_control_fails(std::string_view property, const Tally& tally,
                                    double least_per_million) {
  expect_holds(property, tally);
  if (sanitizer_divisor > 1) return;  // Too few trials to tell.
  EXPECT_GE(tally.control_failures_per_million(), least_per_million)
      << property << ": the control holds too often for this test to tell, in "
      << tally.control_checks;
}

std::string literal(float value) {
  if (!std::isfinite(value)) return fmt::format("{}f", value);
  return fmt::format("{:a}f", value);
}

std::string literal(const Vec3f& vector) {
  return fmt::format("{{{}, {}, {}}}", literal(vector.x), literal(vector.y), literal(vector.z));
}

std::string literal(const Ray& ray) {
  std::string text = "Ray{.origin" + literal(ray.origin) + ", .direction" + literal(ray.direction);
  if (ray.t_min != 0 || std::isfinite(ray.t_max)) {
    text += fmt::format(", .t_min = {:a}, .t_max = {:a}", ray.t_min, ray.t_max);
  }
  return text + '}';
}

}  // namespace tracer::stress
