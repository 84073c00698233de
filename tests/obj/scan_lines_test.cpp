// SPDX-License-Identifier: MIT
// Lines of the usual forms are read by a path of their own on processors that have the
// instructions: it must say what the general path says, which reads the same lines with two blanks
// where they have one.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/flat_obj.h"
#include "tests/support/instruction_sets.h"
#include "tracer/obj/parse_obj.h"

namespace tracer {
namespace {

constexpr int element_count = 300;

std::string with_two_blanks(const std::string& text) {
  std::string wider;
  for (const char c : text) wider += c == ' ' ? std::string("  ") : std::string(1, c);
  return wider;
}

class LineMaker {
 public:
  explicit LineMaker(uint32_t seed) : random_(seed) {}

  /// Vertices of all kinds, and faces of one form that uses them.
  std::string text() {
    std::string text;
    for (int i = 0; i < element_count; ++i) {
      text += "v " + number() + ' ' + number() + ' ' + number() + '\n';
      text += "vt " + number() + ' ' + number() + '\n';
      text += "vn " + number() + ' ' + number() + ' ' + number() + '\n';
    }
    const auto form = static_cast<uint32_t>(below(4));
    for (int i = 0; i < element_count; ++i) text += face(form) + '\n';
    return text;
  }

  /// Some bytes become others that lines have.
  void damage(std::string& text) {
    constexpr std::string_view bytes = "0123456789-+./ e#\t\\\r\nvf";
    for (int i = 0; i < 40; ++i) text[below(text.size())] = bytes[below(bytes.size())];
  }

 private:
  size_t below(size_t end) { return random_() % end; }

  std::string number() {
    char text[64];
    const double size = std::pow(10.0, static_cast<double>(below(7)));
    const double value = std::uniform_real_distribution<double>(-size, size)(random_);
    const int decimals = below(4) == 0 ? static_cast<int>(below(13)) : 6;
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
  }

  std::string index() {
    if (below(50) == 0) return std::to_string(-static_cast<int>(below(400)));
    if (below(50) == 0) return std::to_string(random_());
    const std::string zeros(below(20) == 0 ? below(7) : 0, '0');
    return zeros + std::to_string(1 + below(element_count));
  }

  std::string face(uint32_t form) {
    std::string line = "f";
    const size_t corner_count = below(8) == 0 ? 1 + below(7) : 3;
    if (below(30) == 0) form = static_cast<uint32_t>(below(4));
    for (size_t i = 0; i < corner_count; ++i) {
      line += ' ' + index();
      if (form == 1) line += '/' + index();
      if (form == 2) line += "//" + index();
      if (form == 3) line += '/' + index() + '/' + index();
    }
    return line;
  }

  std::mt19937 random_;
};

FlatObj parse(const std::string& text) {
  Progress progress;
  return FlatObj(parse_obj(text, "x.obj", progress));
}

template <class T>
bool have_equal_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const FlatObj& plain, const FlatObj& general) {
  EXPECT_TRUE(have_equal_bits(plain.positions, general.positions));
  EXPECT_TRUE(have_equal_bits(plain.texcoords, general.texcoords));
  EXPECT_TRUE(have_equal_bits(plain.normals, general.normals));
  ASSERT_EQ(plain.faces.size(), general.faces.size());
  for (size_t i = 0; i < plain.faces.size(); ++i) {
    EXPECT_EQ(plain.faces[i].line, general.faces[i].line);
    EXPECT_TRUE(have_equal_bits(plain.faces[i].corners, general.faces[i].corners)) << "face " << i;
  }
  EXPECT_EQ(plain.dropped_faces, general.dropped_faces);
  EXPECT_EQ(plain.warnings.count(), general.warnings.count());
  ASSERT_EQ(plain.warnings.messages().size(), general.warnings.messages().size());
  for (size_t i = 0; i < plain.warnings.messages().size(); ++i) {
    EXPECT_EQ(plain.warnings.messages()[i].text(), general.warnings.messages()[i].text());
  }
}

TEST(ScanLines, lines_of_the_usual_forms_say_what_the_general_path_reads_in_them) {
  for_each_instruction_set([](const std::string& set) {
    SCOPED_TRACE(set);
    for (uint32_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(seed);
      const std::string text = LineMaker(seed).text();
      expect_same(parse(text), parse(with_two_blanks(text)));
    }
  });
}

TEST(ScanLines, damaged_lines_are_reported_as_the_general_path_reports_them) {
  for_each_instruction_set([](const std::string& set) {
    SCOPED_TRACE(set);
    for (uint32_t seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE(seed);
      LineMaker maker(seed);
      std::string text = maker.text();
      maker.damage(text);
      expect_same(parse(text), parse(with_two_blanks(text)));
    }
  });
}

}  // namespace
}  // namespace tracer
