// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "tracer/scene/import_obj.h"

namespace app {

/// What loading had to leave out or guess, on stderr: the messages that were kept, then how many
/// there are in all.
void print_warnings(const std::filesystem::path& model, const tracer::ImportedScene& imported);

}  // namespace app
