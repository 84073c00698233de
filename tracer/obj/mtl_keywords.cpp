// SPDX-License-Identifier: MIT
#include "tracer/obj/mtl_keywords.h"

#include <algorithm>

namespace tracer {
namespace {

// Of several keywords for a slot, the first is the one that messages name.
constexpr std::array keywords{
    MtlKeyword{"newmtl", MtlStatement::newmtl}, MtlKeyword{"d", MtlStatement::d},
    MtlKeyword{"Tr", MtlStatement::tr},         MtlKeyword{"illum", MtlStatement::illum},
    MtlKeyword{"Ka", &MtlMaterial::ka},         MtlKeyword{"Kd", &MtlMaterial::kd},
    MtlKeyword{"Ks", &MtlMaterial::ks},         MtlKeyword{"Ke", &MtlMaterial::ke},
    MtlKeyword{"Tf", &MtlMaterial::tf},         MtlKeyword{"Ns", &MtlMaterial::ns},
    MtlKeyword{"Ni", &MtlMaterial::ni},         MtlKeyword{"Pr", &MtlMaterial::pr},
    MtlKeyword{"Pm", &MtlMaterial::pm},         MtlKeyword{"Ps", &MtlMaterial::ps},
    MtlKeyword{"Pc", &MtlMaterial::pc},         MtlKeyword{"Pcr", &MtlMaterial::pcr},
    MtlKeyword{"aniso", &MtlMaterial::aniso},   MtlKeyword{"anisor", &MtlMaterial::anisor},
    MtlKeyword{"map_Kd", MtlSlot::kd},          MtlKeyword{"map_Ks", MtlSlot::ks},
    MtlKeyword{"map_Ke", MtlSlot::ke},          MtlKeyword{"map_d", MtlSlot::d},
    MtlKeyword{"map_Ns", MtlSlot::ns},          MtlKeyword{"map_Pr", MtlSlot::pr},
    MtlKeyword{"map_Pm", MtlSlot::pm},          MtlKeyword{"map_refl", MtlSlot::pm},
    MtlKeyword{"norm", MtlSlot::norm},          MtlKeyword{"map_norm", MtlSlot::norm},
    MtlKeyword{"map_Bump", MtlSlot::bump},      MtlKeyword{"bump", MtlSlot::bump},
    MtlKeyword{"map_Ps", MtlSlot::ps},          MtlKeyword{"disp", MtlSlot::disp},
    MtlKeyword{"map_disp", MtlSlot::disp},      MtlKeyword{"refl", MtlSlot::refl},
};

constexpr std::array options{
    MtlMapOption{"-blendu", 1, MtlOption::passed_over},
    MtlMapOption{"-blendv", 1, MtlOption::passed_over},
    MtlMapOption{"-boost", 1, MtlOption::passed_over},
    MtlMapOption{"-t", 3, MtlOption::passed_over},
    MtlMapOption{"-texres", 1, MtlOption::passed_over},
    MtlMapOption{"-type", 1, MtlOption::passed_over},
    MtlMapOption{"-cc", 1, MtlOption::passed_over},
    MtlMapOption{"-colorspace", 1, MtlOption::passed_over},
    MtlMapOption{"-bm", 1, MtlOption::bm},
    MtlMapOption{"-clamp", 1, MtlOption::clamp},
    MtlMapOption{"-imfchan", 1, MtlOption::imfchan},
    MtlMapOption{"-mm", 2, MtlOption::mm},
    MtlMapOption{"-o", 3, MtlOption::o},
    MtlMapOption{"-s", 3, MtlOption::s},
};

char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

template <class Table>
auto find_named(const Table& table, std::string_view written) -> decltype(table.data()) {
  for (const auto& entry : table) {
    if (is_same_word(entry.name, written)) return &entry;
  }
  return nullptr;
}

}  // namespace

bool is_same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower_case(x) == lower_case(y); });
}

const MtlKeyword* find_mtl_keyword(std::string_view written) {
  return find_named(keywords, written);
}

const MtlMapOption* find_mtl_option(std::string_view written) {
  return find_named(options, written);
}

std::string_view keyword_of(MtlSlot slot) {
  for (const MtlKeyword& keyword : keywords) {
    const MtlSlot* named = std::get_if<MtlSlot>(&keyword.target);
    if (named && *named == slot) return keyword.name;
  }
  return {};
}

}  // namespace tracer
