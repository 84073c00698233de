// SPDX-License-Identifier: MIT
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/source_files.h"

namespace tracer {
namespace {

// "[Wald 2007]", "[IEC 61966-2-1]": a capital, words, and a number of four digits or more.
std::set<std::string> source_keys(const std::string& text) {
  static const std::regex key(R"(\[([A-Z][^\[\]]* [0-9]{4}[^\[\] ]*)\])");
  std::set<std::string> keys;
  for (std::sregex_iterator match(text.begin(), text.end(), key), end; match != end; ++match) {
    keys.insert((*match)[1]);
  }
  return keys;
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
  static const std::regex entry(R"(\n- \*\*\[([^\]]+)\]\*\*)");
  const std::string text = references();
  std::string previous;
  for (std::sregex_iterator match(text.begin(), text.end(), entry), end; match != end; ++match) {
    EXPECT_LT(previous, (*match)[1].str());
    previous = (*match)[1];
  }
  EXPECT_NE(previous, "");
}

TEST(References, keys_are_recognised) {
  const auto keys = source_keys("// [Wald 2007] (7) and [IEC 61966-2-1], not [0, 1000] or a[i].");
  EXPECT_EQ(keys, (std::set<std::string>{"Wald 2007", "IEC 61966-2-1"}));
}

}  // namespace
}  // namespace tracer
