// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

/// Options of a texture map and how many words follow each; numbers after the first may be missing.
struct MapOption {
  std::string_view name;
  int word_count;
};
constexpr std::array map_options{
    MapOption{"-blendu", 1}, MapOption{"-blendv", 1},     MapOption{"-boost", 1},
    MapOption{"-mm", 2},     MapOption{"-o", 3},          MapOption{"-s", 3},
    MapOption{"-t", 3},      MapOption{"-texres", 1},     MapOption{"-clamp", 1},
    MapOption{"-bm", 1},     MapOption{"-imfchan", 1},    MapOption{"-type", 1},
    MapOption{"-cc", 1},     MapOption{"-colorspace", 1},
};

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

/// As the format writes it, whatever case the file has; empty for what is passed over.
std::string known_keyword(std::string_view written) {
  constexpr std::array<std::string_view, 10> known{"newmtl", "Kd", "Ks", "Ke",    "Ns",
                                                   "Ni",     "d",  "Tr", "illum", "map_Kd"};
  const auto found = std::find_if(known.begin(), known.end(), [&](std::string_view keyword) {
    return lower_case(keyword) == lower_case(written);
  });
  return std::string(found == known.end() ? std::string_view() : *found);
}

class MtlParser {
 public:
  MtlParser(std::string_view bytes, const std::string& path) : cursor_(bytes), path_(path) {}

  MtlFile parse() {
    while (cursor_.next_statement()) {
      parse_statement(known_keyword(cursor_.token()));
      cursor_.finish_statement();
    }
    return std::move(file_);
  }

 private:
  void parse_statement(const std::string& keyword) {
    if (keyword == "newmtl") {
      MtlMaterial material;
      material.name = cursor_.name();
      file_.materials.push_back(std::move(material));
      has_opacity_ = false;
    } else if (!keyword.empty()) {
      if (file_.materials.empty()) {
        warn(keyword + " stands before the first newmtl");
      } else {
        parse_value(keyword, file_.materials.back());
      }
    }
  }

  void parse_value(const std::string& keyword, MtlMaterial& material) {
    if (keyword == "Kd") {
      parse_color(keyword, material.kd);
    } else if (keyword == "Ks") {
      parse_color(keyword, material.ks);
    } else if (keyword == "Ke") {
      parse_color(keyword, material.ke);
    } else if (keyword == "Ns") {
      parse_number(keyword, material.ns);
    } else if (keyword == "Ni") {
      parse_number(keyword, material.ni);
    } else if (keyword == "illum") {
      parse_illum(material);
    } else if (keyword == "map_Kd") {
      parse_map(material);
    } else {
      parse_opacity(keyword, material.d);
    }
  }

  /// One number stands for all three.
  void parse_color(const std::string& keyword, Vec3f& color) {
    Vec3f parsed;
    if (!parse_number(keyword, parsed.x)) return;
    parsed.y = parsed.z = parsed.x;
    if (!cursor_.at_statement_end()) {
      if (!parse_number(keyword, parsed.y) || !parse_number(keyword, parsed.z)) return;
    }
    color = parsed;
  }

  /// Leaves `number` as it is, and warns, where there is no finite one.
  bool parse_number(const std::string& keyword, float& number) {
    if (cursor_.at_statement_end()) {
      warn(keyword + ": a number is missing");
      return false;
    }
    const std::string_view token = cursor_.peek_token();
    const std::optional<float> parsed = cursor_.number<float>();
    if (!parsed || !std::isfinite(*parsed)) {
      warn(keyword + ": " + quote_text(token) + " is not a finite number");
      return false;
    }
    number = *parsed;
    return true;
  }

  void parse_illum(MtlMaterial& material) {
    float number = 0;
    if (!parse_number("illum", number)) return;
    material.illum = static_cast<int>(std::clamp(number, 0.0f, 10.0f));
  }

  /// d = 1 - Tr; where a material has both, exporters disagree on Tr and d counts.
  void parse_opacity(const std::string& keyword, float& opacity) {
    if (!cursor_.at_statement_end() && cursor_.peek_token() == "-halo") cursor_.token();
    float number = 0;
    if (!parse_number(keyword, number)) return;
    if (keyword == "d") {
      opacity = number;
      has_opacity_ = true;
    } else if (!has_opacity_) {
      opacity = 1 - number;
    }
  }

  void parse_map(MtlMaterial& material) {
    while (!cursor_.at_statement_end() && skip_option()) {
    }
    material.map_kd = cursor_.name();
    material.map_kd_line = cursor_.statement_line();
    if (material.map_kd.empty()) warn("map_Kd: the path is missing");
  }

  bool skip_option() {
    const std::string name = lower_case(cursor_.peek_token());
    const auto option = std::find_if(map_options.begin(), map_options.end(),
                                     [&](const MapOption& known) { return known.name == name; });
    if (option == map_options.end()) return false;
    cursor_.token();
    for (int i = 0; i < option->word_count && !cursor_.at_statement_end(); ++i) {
      if (i == 0) {
        cursor_.token();
      } else if (!cursor_.number<float>()) {
        break;
      }
    }
    return true;
  }

  void warn(const std::string& what) {
    file_.warnings.add({path_, cursor_.statement_line(), what});
  }

  TextCursor cursor_;
  const std::string& path_;
  MtlFile file_;
  bool has_opacity_ = false;
};

}  // namespace

MtlFile parse_mtl(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return MtlParser(bytes, path).parse();
}

}  // namespace tracer
