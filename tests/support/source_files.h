// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tracer {

struct SourceFile {
  std::string path;  // from the root of the repository: "tracer/bvh/tree.h"
  std::string text;
};

/// All .h and .cpp files below a folder of the repository, by path.
inline std::vector<SourceFile> source_files(const std::string& folder) {
  const std::filesystem::path root = BOXWOOD_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    files.push_back({entry.path().lexically_relative(root).generic_string(), text.str()});
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace tracer
