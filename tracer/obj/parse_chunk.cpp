// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_chunk.h"

#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "tracer/obj/comment_paint.h"
#include "tracer/obj/library_names.h"
#include "tracer/obj/scan_lines.h"
#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Indices as the file has them: from 1, negative ones from the last defined, 0 for none.
struct WrittenCorner {
  int32_t position = 0;
  int32_t texcoord = 0;
  int32_t normal = 0;
};

class ChunkParser {
 public:
  ChunkParser(const TextBlock& block, ChunkContent& content, Texcoords texcoords)
      : block_(block), cursor_(block.text()), content_(content), texcoords_(texcoords) {
    content_.reset(block.text().size());
    chunk_.material_names.emplace_back();
  }

  ObjChunk parse(ChunkMemory& memory) {
    do {
      scan_lines();
    } while (parse_next_statement());
    chunk_.texcoord_count = content_.texcoords.size();
    if (texcoords_ == Texcoords::dropped && !has_relative_texcoord()) {
      content_.drop_texcoords();
      chunk_.has_dropped_texcoords = true;
    }
    content_.copy_to(chunk_, memory);
    chunk_.line_count = cursor_.line() - 1 + block_.lines_left_out();
    return std::move(chunk_);
  }

 private:
  /// Passes lines as long as they are of the usual forms, or comments.
  void scan_lines() {
    LineScan scan{content_, chunk_.largest, form_, material_};
    LinePlace place{cursor_.position(), cursor_.line()};
    for (;;) {
      place = tracer::scan_lines(place, cursor_.end(), scan);
      const bool is_comment = place.at < cursor_.end() && *place.at == '#';
      const char* const next = is_comment ? scan_comment(place.at) : nullptr;
      if (next == nullptr) break;
      place = {std::min(next, cursor_.end()), place.line + 1};
    }
    cursor_.move_to(place.at, place.line);
  }

  /// Whether that exists is known only for each index by itself.
  bool has_relative_texcoord() const {
    return chunk_.largest.texcoord > static_cast<uint32_t>(std::numeric_limits<int32_t>::max());
  }

  bool parse_next_statement() {
    if (!cursor_.next_statement()) return false;
    parse_statement(cursor_.token());
    cursor_.finish_statement();
    return true;
  }

  const char* scan_comment(const char* at) {
    const char* end = at;
    while (end != cursor_.end() && !is_line_end(*end)) ++end;
    read_paint({at, static_cast<size_t>(end - at)}, chunk_.painted);
    if (end == cursor_.end()) return nullptr;
    return end + (end + 1 < cursor_.end() && end[0] == '\r' && end[1] == '\n' ? 2 : 1);
  }

  void parse_statement(std::string_view keyword) {
    if (keyword == "v") {
      parse_position();
    } else if (keyword == "f" || keyword == "fo") {
      parse_face();
    } else if (keyword == "vt") {
      parse_texcoord();
    } else if (keyword == "vn") {
      parse_normal();
    } else if (keyword == "usemtl") {
      use_material(cursor_.name());
    } else if (keyword == "mtllib") {
      for (std::string& name : split_libraries(cursor_.name())) {
        chunk_.material_libraries.push_back({std::move(name), cursor_.statement_line()});
      }
    } else if (keyword == "o") {
      ++chunk_.object_count;
    } else if (keyword == "g") {
      ++chunk_.group_count;
    } else {
      count_other(keyword);
    }
  }

  void count_other(std::string_view keyword) {
    OtherElements& others = chunk_.others;
    if (keyword == "p") {
      ++others.points;
    } else if (keyword == "l") {
      ++others.lines;
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
      if (others.free_forms++ == 0) others.first_free_form_line = cursor_.statement_line();
    }
  }

  void parse_position() {
    Vec3d position(not_a_number);
    if (parse_numbers(3, &position.x, "vertex") == 3) {
      content_.push_position(position);
      parse_color();
    } else {
      content_.push_position(Vec3d(not_a_number));
      content_.push_no_color();
    }
  }

  /// One or two numbers after x y z are a weight, three and more begin with a colour.
  void parse_color() {
    Vec3f color;
    for (int i = 0; i < 3; ++i) {
      if (cursor_.at_statement_end()) return content_.push_no_color();
      const std::optional<float> number = cursor_.number<float>();
      if (!number) return reject_color();
      color[i] = *number;
    }
    content_.push_color(color);
  }

  void reject_color() {
    warn([&] { return "vertex color: " + quote_text(cursor_.peek_token()) + " is not a number"; });
    content_.push_no_color();
  }

  void parse_texcoord() {
    Vec2f texcoord(0.0f);
    if (parse_numbers(1, &texcoord.x, "texture coordinate") == 0) {
      texcoord = Vec2f(not_a_number);
    } else if (!cursor_.at_statement_end()) {
      if (parse_numbers(1, &texcoord.y, "texture coordinate") == 0) texcoord.y = not_a_number;
    }
    content_.texcoords.push(texcoord);
  }

  void parse_normal() {
    Vec3f normal(0.0f);
    if (parse_numbers(3, &normal.x, "normal") < 3) normal = Vec3f(0.0f);
    content_.normals.push(normal);
  }

  /// How many of `count` numbers there are; warns where there are fewer.
  template <class T>
  int parse_numbers(int count, T* numbers, const char* what) {
    for (int i = 0; i < count; ++i) {
      if (cursor_.at_statement_end()) {
        warn([&] {
          return std::string(what) + ": " + std::to_string(count) +
                 " numbers are needed, here are " + std::to_string(i);
        });
        return i;
      }
      const std::optional<T> number = cursor_.number<T>();
      if (!number) {
        warn([&] {
          return std::string(what) + ": " + quote_text(cursor_.peek_token()) + " is not a number";
        });
        return i;
      }
      numbers[i] = *number;
    }
    return count;
  }

  void parse_face() {
    corners_.clear();
    for (; !cursor_.at_statement_end();) {
      if (corners_.size() >= max_face_corners) {
        return drop_face("the face has more than 1048576 corners");
      }
      const std::string_view token = cursor_.peek_token();
      const std::optional<WrittenCorner> corner = parse_corner();
      if (!corner) return drop_face("face corner " + quote_text(token) + " is malformed");
      if (corner->position == 0) return drop_face(position_fault(token));
      corners_.push_back(*corner);
    }
    if (block_.is_cut() && cursor_.position() == cursor_.end()) {
      return drop_face("the face is longer than 40 MiB");
    }
    if (corners_.size() < 3) {
      return drop_face("a face needs at least 3 corners, this has " +
                       std::to_string(corners_.size()));
    }
    add_face();
  }

  /// Corners of several forms become one that has the indices of all.
  void add_face() {
    int form_bits = 0;
    for (const WrittenCorner& corner : corners_) {
      form_bits |= (corner.texcoord != 0 ? 1 : 0) | (corner.normal != 0 ? 2 : 0);
    }
    const auto form = static_cast<CornerForm>(form_bits);
    for (const WrittenCorner& corner : corners_) {
      push_index(corner.position, chunk_.largest.position);
      if (has_texcoord(form)) push_index(corner.texcoord, chunk_.largest.texcoord);
      if (has_normal(form)) push_index(corner.normal, chunk_.largest.normal);
    }
    content_.add_face(static_cast<uint32_t>(corners_.size()), form, material_,
                      cursor_.statement_line());
  }

  void push_index(int32_t index, uint32_t& largest) {
    largest = std::max(largest, static_cast<uint32_t>(index));
    content_.indices.push(index);
  }

  /// v, v/vt, v//vn or v/vt/vn; nullopt where it is none of these.
  std::optional<WrittenCorner> parse_corner() {
    WrittenCorner corner;
    const std::optional<int64_t> position = cursor_.integer();
    if (!position) return std::nullopt;
    corner.position = narrow_index(*position);
    if (cursor_.skip('/')) {
      if (const auto texcoord = cursor_.integer()) {
        corner.texcoord = attribute_index(*texcoord, "texture coordinate");
      }
      if (cursor_.skip('/')) {
        if (const auto normal = cursor_.integer()) {
          corner.normal = attribute_index(*normal, "normal");
        }
      }
    }
    if (!cursor_.at_argument_end()) return std::nullopt;
    return corner;
  }

  /// 0 where no array is as large.
  static int32_t narrow_index(int64_t index) {
    constexpr int64_t largest = std::numeric_limits<int32_t>::max();
    return index >= -largest && index <= largest ? static_cast<int32_t>(index) : 0;
  }

  int32_t attribute_index(int64_t index, const char* what) {
    const int32_t narrowed = narrow_index(index);
    if (index == 0) {
      warn([&] { return std::string(what) + " index 0: OBJ indices start at 1"; });
    } else if (narrowed == 0) {
      warn([&] { return std::string(what) + ' ' + std::to_string(index) + " does not exist"; });
    }
    return narrowed;
  }

  static std::string position_fault(std::string_view token) {
    const std::string_view digits = token.substr(0, token.find('/'));
    if (digits.find_first_of("123456789") == digits.npos) {
      return "face index 0: OBJ indices start at 1";
    }
    return "vertex " + quote_text(digits) + " does not exist";
  }

  void drop_face(const std::string& why) {
    ++chunk_.dropped_faces;
    warn([&] { return why; });
  }

  void use_material(const std::string& name) {
    const auto next = static_cast<uint32_t>(chunk_.material_names.size());
    const auto [entry, is_new] = materials_.try_emplace(name, next);
    if (is_new) chunk_.material_names.push_back({name, cursor_.statement_line()});
    material_ = chunk_.last_material = entry->second;
  }

  /// Makes the text only where the message is kept.
  template <class MakeText>
  void warn(MakeText&& make_text) {
    if (chunk_.warnings.messages().size() < Warnings::kept_messages) {
      chunk_.warnings.add({"", cursor_.statement_line(), make_text()});
    } else {
      chunk_.warnings.add_uncounted(1);
    }
  }

  const TextBlock& block_;
  TextCursor cursor_;
  ChunkContent& content_;
  const Texcoords texcoords_;
  ObjChunk chunk_;
  CornerForm form_ = CornerForm::position;  // of the last face
  std::vector<WrittenCorner> corners_;
  std::unordered_map<std::string, uint32_t> materials_;
  uint32_t material_ = 0;
};

}  // namespace

ObjChunk parse_obj_chunk(const TextBlock& block, ChunkContent& content, Texcoords texcoords,
                         ChunkMemory& memory) {
  return ChunkParser(block, content, texcoords).parse(memory);
}

}  // namespace tracer
