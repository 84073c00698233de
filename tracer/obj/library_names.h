// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tracer {

/// What a mtllib statement names: "a.mtl my file.mtl" are two files, as a name ends where a word
/// ends in .mtl. What follows a # is a comment.
std::vector<std::string> split_libraries(std::string_view text);

}  // namespace tracer
