// SPDX-License-Identifier: MIT
#include <set>

#include <gtest/gtest.h>

#include "tests/support/pattern.h"
#include "tests/support/source_files.h"

namespace tracer {
namespace {

// "[Wald 2007]", "[IEC 61966-2-1]": a capital, words, and a number of four digits or more.
std::set<std::string> source_keys(const std::string& text) {
  static const Pattern key("\\[([A-Z][^][]* [0-9]{4}[^][ ]*)\\]");
  const std::vector<std::string> keys = key.first_groups(text);
  return {keys.begin(), keys.end()};
}

std::string references() {
  std::ostringstream text;
  text << std::ifstream(BOXWOOD_SOURCE_DIR "/docs/references.md").rdbuf();
  return text.str();
}

TEST(References, every_key_in_the_sources_is_listed) {
  const std::set<std::string> listed = source_keys(references());
  int key_count = 0;
  for (const char* folder : {"tracer", "app"}) {
    for (const SourceFile& file : source_files(folder)) {
      for (const std::string& key : source_keys(file.text)) {
        EXPECT_TRUE(listed.contains(key)) << file.path << ": [" << key << ']';
        ++key_count;
      }
    }
  }
  EXPECT_GT(key_count, 5);
}

TEST(References, are_listed_once_each_in_alphabetical_order) {
  const Pattern entry("\n- [*][*]\\[([^]]+)\\][*][*]");
  std::string previous;
  for (const std::string& key : entry.first_groups(references())) {
    EXPECT_LT(previous, key);
    previous = key;
  }
  EXPECT_NE(previous, "");
}

TEST(References, keys_are_recognised) {
  const auto keys = source_keys("// [Wald 2007] (7) and [IEC 61966-2-1], not [0, 1000] or a[i].");
  EXPECT_EQ(keys, (std::set<std::string>{"Wald 2007", "IEC 61966-2-1"}));
}

}  // namespace
}  // namespace tracer
