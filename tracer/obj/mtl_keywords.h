// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "tracer/obj/parse_mtl.h"

namespace tracer {

/// Statements that do more than set a value.
enum class MtlStatement : uint8_t { newmtl, d, tr, illum };

/// What a statement sets.
using MtlTarget =
    std::variant<MtlStatement, MtlSlot, Vec3f MtlMaterial::*, std::optional<Vec3f> MtlMaterial::*,
                 std::optional<float> MtlMaterial::*>;

struct MtlKeyword {
  std::string_view name;  // as the format writes it
  MtlTarget target;
};
/// Whatever case it is written in; nullptr for what is passed over.
const MtlKeyword* find_mtl_keyword(std::string_view written);

enum class MtlOption : uint8_t { passed_over, bm, clamp, imfchan, mm, o, s };

/// An option of a texture, and the words that follow it at most: numbers after the first may be
/// missing.
struct MtlMapOption {
  std::string_view name;
  int word_count;
  MtlOption option;
};
const MtlMapOption* find_mtl_option(std::string_view written);

/// Equal but for the case of ASCII letters.
bool is_same_word(std::string_view a, std::string_view b);

}  // namespace tracer
