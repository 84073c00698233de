// SPDX-License-Identifier: MIT
#include "app/viewer/file_watch.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace app {
namespace {

TEST(FileWatch, a_change_counts_when_it_has_stayed_for_one_look) {
  const tracer::TemporaryFolder folder;
  const auto path = folder.write("ball.obj", "v 0 0 0\n");
  FileWatch watch;
  watch.watch(path);
  EXPECT_FALSE(watch.has_changed(1));
  folder.write("ball.obj", "v 0 0 0\nv 1 0 0\n");
  EXPECT_FALSE(watch.has_changed(2));
  EXPECT_TRUE(watch.has_changed(3));
  EXPECT_FALSE(watch.has_changed(4));
}

TEST(FileWatch, a_file_that_was_missing_counts_when_it_appears) {
  const tracer::TemporaryFolder folder;
  FileWatch watch;
  watch.watch(folder / "ball.obj");
  EXPECT_FALSE(watch.has_changed(1));
  folder.write("ball.obj", "v 0 0 0\n");
  EXPECT_FALSE(watch.has_changed(2));
  EXPECT_TRUE(watch.has_changed(3));
}

TEST(FileWatch, a_change_of_any_file_counts_and_others_are_forgotten) {
  const tracer::TemporaryFolder folder;
  const auto path = folder.write("ball.obj", "mtllib ball.mtl\n");
  FileWatch watch;
  watch.watch(path);
  watch.add(folder.write("ball.mtl", "newmtl red\n"));
  folder.write("ball.mtl", "newmtl red\nKd 1 0 0\n");
  EXPECT_FALSE(watch.has_changed(1));
  EXPECT_TRUE(watch.has_changed(2));
  watch.watch(path);
  folder.write("ball.mtl", "newmtl blue\n");
  EXPECT_FALSE(watch.has_changed(3));
  EXPECT_FALSE(watch.has_changed(4));
}

}  // namespace
}  // namespace app
