// SPDX-License-Identifier: MIT
// The loader's triangles are those of the slow reference; the fuzz target and a test share it.
#pragma once

#include <string_view>

namespace tracer {

/// Ends the process where the loader and the reference disagree on a triangle, an attribute, a
/// material or how many faces are left out.
void check_against_reference(std::string_view bytes);

}  // namespace tracer
