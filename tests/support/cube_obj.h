// SPDX-License-Identifier: MIT
#pragma once

namespace tests {

/// A cube of side 2 around the origin: 8 vertices, 6 quads, 12 triangles.
inline constexpr const char* cube_obj = R"(o cube
v -1 -1 -1
v  1 -1 -1
v  1  1 -1
v -1  1 -1
v -1 -1  1
v  1 -1  1
v  1  1  1
v -1  1  1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

}  // namespace tests
