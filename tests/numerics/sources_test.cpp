// SPDX-License-Identifier: MIT
// What the sources and the compiler must not do: absolute epsilons, contracted products.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/numerics/stress.h"
#include "tests/support/pattern.h"
#include "tests/support/source_files.h"

namespace tracer::stress {
namespace {

std::string without_comments(const std::string& text) {
  std::string code;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    code += line.substr(0, line.find("//")) + '\n';
  }
  return code;
}

/// Decimal numbers with a negative exponent, and decimal fractions of a thousandth or less.
std::vector<std::string> small_decimals(const std::string& text) {
  static const Pattern number("[^0-9A-Za-z_.]([0-9]*\\.?[0-9]+[eE]-[0-9]+|0\\.00[0-9]+)");
  return number.first_groups(without_comments(text));
}

TEST(NumericsSources, absolute_epsilons_are_found_where_there_are_some) {
  EXPECT_EQ(small_decimals("t > 1e-4f && x < .5e-3 && y < 0.001f").size(), 3u);
  EXPECT_EQ(small_decimals(" x = 0x1p-24f * m; // 1e-6\n y = 0.25 + 1e4;").size(), 0u);
}

// Error bounds are powers of two times what they are relative to.
TEST(NumericsSources, nothing_that_traces_a_ray_has_an_absolute_epsilon) {
  Tally tally;
  for (const char* folder :
       {"tracer/base", "tracer/geometry", "tracer/bvh", "tracer/scene", "tracer/render"}) {
    for (const auto& [path, text] : source_files(folder)) {
      Trial trial(1, tally.checks, tally);
      std::vector<std::string> found = small_decimals(text);
      // The narrowest field of view, in degrees.
      if (path == "tracer/scene/camera.cpp") std::erase(found, "1e-6");
      // Constants of nature.
      if (path == "tracer/scene/sun_sky.cpp") found.clear();
      trial.check(found.empty(), [&, &file = path] { return file + ": " + found.front(); });
    }
  }
  EXPECT_GT(tally.checks, 80u);
  expect_holds("files without an absolute epsilon", tally);
}

#if defined(__x86_64__)
// Each for a processor with FMA: 0 where every product is rounded.
[[gnu::target("fma"), gnu::noinline]] double difference_of_products(double a, double b, double c,
                                                                    double d) {
  return a * b - c * d;
}
#if defined(__GNUC__) && !defined(__clang__)
[[gnu::target("fma"), gnu::noinline, gnu::optimize("fp-contract=fast")]] double
contracted_difference_of_products(double a, double b, double c, double d) {
  return a * b - c * d;
}
#endif

TEST(NumericsSources, the_compiler_contracts_no_product_with_a_sum) {
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has no FMA";
  const Tally tally = run_trials("a b - a b is 0", 2, trials(10'000, 1'000'000), [](Trial& trial) {
    const double a = 1 + static_cast<double>(trial.random.unit()) / 3;
    const double b = 1 + static_cast<double>(trial.random.unit()) / 7;
    trial.check(difference_of_products(a, b, a, b) == 0,
                [&] { return fmt::format("{:a} * {:a}", a, b); });
#if defined(__GNUC__) && !defined(__clang__)
    trial.check_control(contracted_difference_of_products(a, b, a, b) == 0);
#endif
  });
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__)
  expect_holds_and_control_fails("a b - a b is 0", tally, 1e5);
#else
  expect_holds("a b - a b is 0", tally);
#endif
}
#endif

}  // namespace
}  // namespace tracer::stress
