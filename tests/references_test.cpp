// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

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

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string references() {
  return text_of(BOXWOOD_SOURCE_DIR "/docs/references.md");
}

TEST(References, every_key_is_listed_and_every_listed_key_is_used) {
  const std::set<std::string> listed = source_keys(references());
  std::set<std::string> used;
  const auto note = [&](const std::filesystem::path& path, const std::string& text) {
    for (const std::string& key : source_keys(text)) {
      EXPECT_TRUE(listed.contains(key)) << path << ": [" << key << ']';
      used.insert(key);
    }
  };
  for (const char* folder : {"tracer", "app", "assets", "tests/bench"}) {
    for (const SourceFile& file : source_files(folder)) note(file.path, file.text);
  }
  for (const char* folder : {"docs", "assets"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(BOXWOOD_SOURCE_DIR) / folder)) {
      const bool is_text = entry.path().extension() == ".md";
      if (is_text && entry.path().filename() != "references.md") note(entry, text_of(entry));
    }
  }
  EXPECT_EQ(used, listed);
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
