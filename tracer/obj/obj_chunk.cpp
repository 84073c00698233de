// SPDX-License-Identifier: MIT
#include "tracer/obj/obj_chunk.h"

#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr float no_color = std::numeric_limits<float>::quiet_NaN();

bool ends_with_mtl(std::string_view name) {
  if (name.size() < 4 || name[name.size() - 4] != '.') return false;
  const std::string_view extension = name.substr(name.size() - 3);
  return (extension[0] | 0x20) == 'm' && (extension[1] | 0x20) == 't' &&
         (extension[2] | 0x20) == 'l';
}

/// "a.mtl my file.mtl" names two files: a name ends where a word ends in .mtl.
std::vector<std::string> split_libraries(std::string_view text) {
  std::vector<std::string> names;
  size_t begin = 0;
  while (begin < text.size() && text[begin] != '#') {
    size_t end = begin;
    do {
      end = std::min(text.find(' ', end + 1), text.size());
    } while (end < text.size() && !ends_with_mtl(text.substr(begin, end - begin)));
    names.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

class ChunkParser {
 public:
  explicit ChunkParser(std::string_view bytes) : cursor_(bytes) {
    chunk_.material_names.emplace_back();
  }

  ObjChunk parse() {
    while (cursor_.next_statement()) {
      parse_statement(cursor_.token());
      cursor_.finish_statement();
    }
    chunk_.line_count = cursor_.lines_passed();
    return std::move(chunk_);
  }

 private:
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
    }
  }

  void parse_position() {
    Vec3d position(not_a_number);
    if (parse_numbers(3, &position.x, "vertex") == 3) {
      parse_color();
    } else {
      position = Vec3d(not_a_number);
      push_color(Vec3f(no_color));
    }
    chunk_.positions.push_back(position);
  }

  /// One or two numbers after x y z are a weight, three and more begin with a colour.
  void parse_color() {
    Vec3d color(no_color);
    int count = 0;
    for (; count < 3 && !cursor_.at_statement_end(); ++count) {
      const std::optional<double> number = cursor_.number();
      if (!number) return reject_color();
      color[count] = *number;
    }
    push_color(count == 3 ? Vec3f(color) : Vec3f(no_color));
  }

  void reject_color() {
    warn([&] { return "vertex color: " + quote_text(cursor_.peek_token()) + " is not a number"; });
    push_color(Vec3f(no_color));
  }

  void push_color(const Vec3f& color) {
    if (chunk_.colors.empty()) {
      if (std::isnan(color.x)) return;
      chunk_.colors.assign(chunk_.positions.size(), Vec3f(no_color));
    }
    chunk_.colors.push_back(color);
  }

  void parse_texcoord() {
    Vec3d texcoord(0.0);
    if (parse_numbers(1, &texcoord.x, "texture coordinate") == 0) {
      texcoord = Vec3d(not_a_number);
    } else if (!cursor_.at_statement_end()) {
      if (parse_numbers(1, &texcoord.y, "texture coordinate") == 0) texcoord.y = not_a_number;
    }
    chunk_.texcoords.emplace_back(texcoord);
  }

  void parse_normal() {
    Vec3d normal(0.0);
    if (parse_numbers(3, &normal.x, "normal") < 3) normal = Vec3d(0.0);
    chunk_.normals.emplace_back(normal);
  }

  /// How many of `count` numbers there are; warns where there are fewer.
  int parse_numbers(int count, double* numbers, const char* what) {
    for (int i = 0; i < count; ++i) {
      if (cursor_.at_statement_end()) {
        warn([&] {
          return std::string(what) + ": " + std::to_string(count) +
                 " numbers are needed, here are " + std::to_string(i);
        });
        return i;
      }
      const std::optional<double> number = cursor_.number();
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
    const auto first_corner = static_cast<uint32_t>(chunk_.corners.size());
    size_t corner_count = 0;
    for (; !cursor_.at_statement_end(); ++corner_count) {
      if (corner_count >= max_face_corners) {
        return drop_face(first_corner, "the face has more than 1048576 corners");
      }
      const std::string_view token = cursor_.peek_token();
      const std::optional<WrittenCorner> corner = parse_corner();
      if (!corner)
        return drop_face(first_corner, "face corner " + quote_text(token) + " is malformed");
      if (corner->position == 0) return drop_face(first_corner, position_fault(token));
      chunk_.corners.push_back(*corner);
    }
    if (corner_count < 3) {
      return drop_face(first_corner,
                       "a face needs at least 3 corners, this has " + std::to_string(corner_count));
    }
    chunk_.faces.push_back({first_corner, static_cast<uint32_t>(corner_count), material_,
                            cursor_.statement_line(),
                            static_cast<uint32_t>(chunk_.positions.size()),
                            static_cast<uint32_t>(chunk_.texcoords.size()),
                            static_cast<uint32_t>(chunk_.normals.size())});
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

  void drop_face(uint32_t first_corner, const std::string& why) {
    chunk_.corners.resize(first_corner);
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

  TextCursor cursor_;
  ObjChunk chunk_;
  std::unordered_map<std::string, uint32_t> materials_;
  uint32_t material_ = 0;
};

}  // namespace

ObjChunk parse_obj_chunk(std::string_view bytes) {
  return ChunkParser(bytes).parse();
}

}  // namespace tracer
