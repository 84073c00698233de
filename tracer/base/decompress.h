// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tracer/base/byte_source.h"

namespace tracer {

enum class Packing { none, gzip, zstd };

/// What the first four bytes of a file, or all where there are fewer, say.
Packing packing_of(std::string_view first_bytes);

/// What `packed` holds, one or more gzip members or zstd frames, unpacked as it is read. Reading
/// throws LoadError where the data is damaged or ends early, in the name of `name`.
std::unique_ptr<ByteSource> unpack(Packing packing, std::unique_ptr<ByteSource> packed,
                                   const std::string& name);

}  // namespace tracer
