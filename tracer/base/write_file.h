// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace tracer {

/// Replaces the file by `bytes`, whole or not at all: they are written beside it and renamed.
/// Throws LoadError, in words for the user.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Throws what write_file would, as far as that shows before there are bytes to write.
void check_writable(const std::filesystem::path& path);

}  // namespace tracer
