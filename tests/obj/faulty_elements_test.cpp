// SPDX-License-Identifier: MIT
// A faulty element is left out, counted and said with its line; the rest of the file is shown.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/obj/faulty_file.h"

namespace tests {
namespace {

// The fault under test stands on line 6.
const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\n";

std::string repeat(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(FaultyElements, a_face_with_a_faulty_corner_is_dropped) {
  const std::pair<const char*, const char*> faults[] = {
      {"f 0 1 2", "face index 0"},
      {"f 1 2 0/1", "face index 0"},
      {"f 1 2 5", "vertex 5 does not exist"},
      {"f 1 2 -5", "vertex -5 does not exist"},
      {"f 1 2 99999999999999", "99999999999999"},
      {"f 1 2 -99999999999999", "-99999999999999"},
      {"f 1 2 4294967297", "4294967297"},
      {"f 1 2 2147483648", "2147483648"},
      {"f 1 2 99999999999999999999999999", "does not exist"},
      {"f 1", "at least 3 corners"},
      {"f 1 2", "at least 3 corners"},
      {"f", "at least 3 corners"},
      {"f 1 2 three", "malformed"},
      {"f 1 2 3.0", "malformed"},
      {"f 1 2 3/1/1/1", "malformed"},
      {"f 1 1 1", "no area"},
  };
  for (const auto& [line, reason] : faults) {
    expect_as_described({line, square + line + "\nf 1 3 4\n", 2, 1, {{6, reason}}});
  }
}

TEST(FaultyElements, where_the_only_face_is_faulty_nothing_can_be_shown) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const char* face : {"f 0 1 2", "f 1 2 9", "f 1 2 -9", "f 1 2 99999999999999", "f 1 2", "f 1",
                           "f", "f 1 2 x", "f 1 1 2"}) {
    expect_as_described({face, vertices + face + '\n', 0, 0, {{4, "no triangles to show"}}});
  }
}

TEST(FaultyElements, an_attribute_out_of_range_goes_and_the_triangle_stays) {
  const std::string attributes = square + "vt 0 0\nvn 0 0 1\n";
  const std::pair<const char*, const char*> faults[] = {
      {"f 1/2 3/1 4/1", "texture coordinate 2"},
      {"f 1/-2 3/1 4/1", "texture coordinate -2"},
      {"f 1/0 3/1 4/1", "texture coordinate index 0"},
      {"f 1/99999999999999 3/1 4/1", "99999999999999"},
      {"f 1//2 3//1 4//1", "normal 2"},
      {"f 1//-2 3//1 4//1", "normal -2"},
      {"f 1//0 3//1 4//1", "normal index 0"},
      {"f 1//99999999999999 3//1 4//1", "99999999999999"},
  };
  for (const auto& [line, reason] : faults) {
    expect_as_described({line, attributes + line + '\n', 2, 0, {{8, reason}}});
  }
}

TEST(FaultyElements, a_face_with_a_vertex_that_is_not_finite_is_dropped) {
  for (const char* vertex : {"v nan 0 0", "v 0 inf 0", "v 0 0 -inf", "v 1e400 0 0", "v 0 -1e400 0",
                             "v 1e39 0 0", "v NaN 0 0", "v 0 Infinity 0"}) {
    const std::string obj = square + vertex + "\nf 1 5 4\nf 1 3 4\n";
    expect_as_described({vertex, obj, 2, 1, {{7, "not finite, or too large"}}});
  }
}

TEST(FaultyElements, a_vertex_that_is_not_finite_and_not_used_does_no_harm) {
  expect_as_described({"unused nan", square + "v nan inf 1e400\nf 1 3 4\n", 2, 0, {}});
}

TEST(FaultyElements, a_number_below_the_smallest_is_zero) {
  const TemporaryFolder folder;
  for (const char* number : {"1e-400", "-1e-400", "0.0000000001e-390"}) {
    const std::string vertex = std::string("v 0 0 ") + number;
    const auto loading = load(folder.write("model.obj", vertex + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    ASSERT_TRUE(loading.scene) << number;
    EXPECT_EQ(loading.scene->warnings.count(), 0) << number;
    EXPECT_EQ(loading.scene->bounds.min.z, 0) << number;
    EXPECT_EQ(loading.scene->bounds.max.z, 0) << number;
  }
}

TEST(FaultyElements, a_malformed_vertex_costs_the_faces_that_use_it) {
  expect_as_described({"malformed vertex",
                       square + "v 0 one 0\nf 1 5 4\nf 1 3 4\n",
                       2,
                       1,
                       {{6, "'one' is not a number"}, {7, "not finite"}}});
  expect_as_described({"short vertex",
                       square + "v 0\nf 1 5 4\nf 1 3 4\n",
                       2,
                       1,
                       {{6, "3 numbers are needed"}, {7, "not finite"}}});
}

TEST(FaultyElements, ten_faults_are_said_and_all_are_counted) {
  const std::string faults = repeat("f 1 2 9\n", 25);
  FaultyFile file{"25 faults", square + faults, 1, 25, {}, 25};
  for (int i = 0; i < 10; ++i) file.faults.push_back({6 + i, "vertex 9 does not exist"});
  expect_as_described(file);
}

TEST(FaultyElements, ten_faults_are_the_first_of_the_file_however_many_there_are) {
  const std::string faults = repeat("f 1 2 9\nf 1 3 4\n", 100000);
  FaultyFile file{"100000 faults", square + faults, 100001, 100000, {}, 100000};
  for (int i = 0; i < 10; ++i) file.faults.push_back({6 + 2 * i, "vertex 9 does not exist"});
  expect_as_described(file);
}

TEST(FaultyElements, what_is_cut_off_is_said_with_its_line) {
  expect_as_described({"mid-number", square + "v 0 0 1e", 1, 0, {{6, "is not a number"}}});
  expect_as_described({"mid-vertex", square + "v 0 0", 1, 0, {{6, "3 numbers are needed"}}});
  expect_as_described({"mid-face", square + "f 1 3", 1, 1, {{6, "at least 3 corners"}}});
  expect_as_described({"mid-corner", square + "f 1 3 4/", 2, 0, {}});
  expect_as_described({"mid-word", square + "usemt", 1, 0, {}});
  expect_as_described({"mid-sign", square + "f 1 3 -", 1, 1, {{6, "malformed"}}});
  expect_as_described({"after a face's last digit", square + "f 1 3 4", 2, 0, {}});
}

}  // namespace
}  // namespace tests
