// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_mtl.h"

#include <algorithm>
#include <cmath>

#include "tracer/obj/mtl_keywords.h"
#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

class MtlParser {
 public:
  MtlParser(std::string_view bytes, const std::string& path) : cursor_(bytes), path_(path) {}

  MtlFile parse() {
    while (cursor_.next_statement()) {
      const MtlKeyword* keyword = find_mtl_keyword(cursor_.token());
      if (keyword) parse_statement(*keyword);
      cursor_.finish_statement();
    }
    return std::move(file_);
  }

 private:
  void parse_statement(const MtlKeyword& keyword) {
    keyword_ = keyword.name;
    if (keyword.target == MtlTarget(MtlStatement::newmtl)) {
      file_.materials.emplace_back().name = cursor_.name();
      has_opacity_ = false;
    } else if (file_.materials.empty()) {
      warn("stands before the first newmtl", " ");
    } else {
      std::visit([&](auto target) { set(target, file_.materials.back()); }, keyword.target);
    }
  }

  void set(Vec3f MtlMaterial::*color, MtlMaterial& material) {
    if (const auto parsed = parse_color()) material.*color = *parsed;
  }
  void set(std::optional<Vec3f> MtlMaterial::*color, MtlMaterial& material) {
    if (const auto parsed = parse_color()) material.*color = parsed;
  }
  void set(std::optional<float> MtlMaterial::*number, MtlMaterial& material) {
    if (const auto parsed = parse_number()) material.*number = parsed;
  }
  void set(MtlSlot slot, MtlMaterial& material) {
    MtlMap map;
    while (!cursor_.at_statement_end() && parse_option(map)) {
    }
    map.path = without_quotes(cursor_.name());
    map.line = cursor_.statement_line();
    if (map.path.empty()) warn("the path is missing");
    material.map(slot) = std::move(map);
  }
  void set(MtlStatement statement, MtlMaterial& material) {
    if (statement == MtlStatement::illum) {
      const auto parsed = parse_number();
      if (parsed) material.illum = static_cast<int>(std::clamp(*parsed, 0.0f, 10.0f));
    } else {
      parse_opacity(statement, material.d);
    }
  }

  /// d = 1 - Tr; where a material has both, exporters disagree on Tr and d counts.
  void parse_opacity(MtlStatement statement, float& opacity) {
    if (!cursor_.at_statement_end() && cursor_.peek_token() == "-halo") cursor_.token();
    const auto parsed = parse_number();
    if (!parsed) return;
    if (statement == MtlStatement::d) {
      opacity = *parsed;
      has_opacity_ = true;
    } else if (!has_opacity_) {
      opacity = 1 - *parsed;
    }
  }

  /// One number stands for all three.
  std::optional<Vec3f> parse_color() {
    const auto red = parse_number();
    if (!red) return std::nullopt;
    if (cursor_.at_statement_end()) return Vec3f(*red);
    const auto green = parse_number();
    if (!green) return std::nullopt;
    const auto blue = parse_number();
    if (!blue) return std::nullopt;
    return Vec3f(*red, *green, *blue);
  }

  /// Warns where there is no finite one.
  std::optional<float> parse_number() {
    if (cursor_.at_statement_end()) {
      warn("a number is missing");
      return std::nullopt;
    }
    const std::string_view token = cursor_.peek_token();
    const std::optional<float> parsed = cursor_.number<float>();
    if (!parsed || !std::isfinite(*parsed)) {
      warn(quote_text(token) + " is not a finite number");
      return std::nullopt;
    }
    return parsed;
  }

  bool parse_option(MtlMap& map) {
    const MtlMapOption* known = find_mtl_option(cursor_.peek_token());
    if (!known) return false;
    cursor_.token();
    if (known->option == MtlOption::clamp || known->option == MtlOption::imfchan) {
      if (!cursor_.at_statement_end()) set_by_word(known->option, cursor_.token(), map);
    } else {
      set_by_numbers(*known, map);
    }
    return true;
  }

  static void set_by_word(MtlOption option, std::string_view word, MtlMap& map) {
    if (option == MtlOption::clamp) {
      map.is_clamped = is_same_word(word, "on");
      return;
    }
    for (const std::string_view channel : {"r", "g", "b", "m", "l", "z"}) {
      if (is_same_word(word, channel)) map.channel = channel[0];
    }
  }

  // The first word is passed whatever it is; further ones belong to the option where they are
  // numbers, else to the path.
  void set_by_numbers(const MtlMapOption& known, MtlMap& map) {
    for (int i = 0; i < known.word_count && !cursor_.at_statement_end(); ++i) {
      const std::optional<float> number = cursor_.number<float>();
      if (number && std::isfinite(*number)) set_number(known.option, i, *number, map);
      if (!number && i > 0) return;
      if (!number) cursor_.token();
    }
  }

  static void set_number(MtlOption option, int place, float number, MtlMap& map) {
    if (option == MtlOption::bm) map.bump_strength = number;
    if (option == MtlOption::mm) (place == 0 ? map.base : map.gain) = number;
    if (option == MtlOption::o && place < 2) map.offset[place] = number;
    if (option == MtlOption::s && place < 2) map.scale[place] = number;
  }

  static std::string without_quotes(std::string path) {
    if (path.size() > 1 && path.front() == '"' && path.back() == '"') {
      path = path.substr(1, path.size() - 2);
    }
    return path;
  }

  void warn(const std::string& what, std::string_view separator = ": ") {
    file_.warnings.add(
        {path_, cursor_.statement_line(), std::string(keyword_).append(separator) + what});
  }

  TextCursor cursor_;
  const std::string& path_;
  MtlFile file_;
  std::string_view keyword_;
  bool has_opacity_ = false;
};

}  // namespace

MtlFile parse_mtl(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return MtlParser(bytes, path).parse();
}

}  // namespace tracer
