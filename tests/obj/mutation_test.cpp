// SPDX-License-Identifier: MIT
// Fuzzing with a fixed seed, so that every run of the tests, and of the sanitizers, does some.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fuzz/check_against_reference.h"
#include "tests/fuzz/check_obj.h"

namespace tracer {
namespace {

std::vector<std::string> read_corpus(const std::string& kind) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(BOXWOOD_SOURCE_DIR "/tests/fuzz/corpus/" + kind)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

class Mutator {
 public:
  Mutator(std::vector<std::string> corpus, uint32_t seed)
      : corpus_(std::move(corpus)), random_(seed) {}

  std::string next() {
    std::string text = corpus_[below(corpus_.size())];
    for (size_t changes = 1 + below(8); changes > 0; --changes) mutate(text);
    return text;
  }

 private:
  size_t below(size_t end) { return end == 0 ? 0 : random_() % end; }

  void mutate(std::string& text) {
    const size_t at = below(text.size() + 1);
    const size_t size = below(std::min<size_t>(text.size() - at, 40) + 1);
    switch (below(6)) {
      case 0:
        if (!text.empty()) text[below(text.size())] = static_cast<char>(random_());
        break;
      case 1:
        text.erase(at, size);
        break;
      case 2:
        text.insert(below(text.size() + 1), text.substr(at, size));
        break;
      case 3:
        text.insert(at, words[below(std::size(words))]);
        break;
      case 4: {
        const std::string& other = corpus_[below(corpus_.size())];
        const size_t from = below(other.size() + 1);
        text.insert(at, other.substr(from, below(80)));
        break;
      }
      default:
        text.resize(at);
        break;
    }
  }

  static constexpr const char* words[] = {
      "\\\n",
      "\r",
      "\n",
      " ",
      "#",
      "/",
      "-",
      "0",
      "1e400",
      "nan",
      "-1",
      "1e38",
      "f 1 2 3 4 5\n",
      "v 0 0 0\n",
      "usemtl ",
      "4294967296",
      "newmtl a\n",
      "Kd ",
      "map_Kd -s 1 ",
      "\xef\xbb\xbf",
      "2147483648",
      "1e-45",
  };

  std::vector<std::string> corpus_;
  std::mt19937 random_;
};

TEST(Mutation, no_obj_breaks_what_a_mesh_promises) {
  Mutator mutator(read_corpus("obj"), 1);
  for (int i = 0; i < 20'000; ++i) check_obj(mutator.next());
}

TEST(Mutation, no_obj_is_read_otherwise_than_by_the_slow_reference) {
  Mutator mutator(read_corpus("obj"), 3);
  for (int i = 0; i < 20'000; ++i) check_against_reference(mutator.next());
}

TEST(Mutation, no_mtl_breaks_what_a_material_promises) {
  Mutator mutator(read_corpus("mtl"), 2);
  for (int i = 0; i < 20'000; ++i) check_mtl(mutator.next());
}

}  // namespace
}  // namespace tracer
