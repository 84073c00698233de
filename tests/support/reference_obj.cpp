// SPDX-License-Identifier: MIT
#include "tests/support/reference_obj.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace tracer {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr size_t max_corners = 1u << 20;

struct Statement {
  int64_t line = 0;
  std::vector<std::string> words;  // the first is the keyword
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/// Names may hold '#'; elsewhere it begins a comment wherever it stands behind the keyword.
bool names_something(const std::string& keyword) {
  return keyword == "usemtl" || keyword == "mtllib";
}

class StatementReader {
 public:
  explicit StatementReader(std::string_view bytes) : bytes_(bytes) {
    if (bytes_.starts_with("\xef\xbb\xbf")) bytes_.remove_prefix(3);
  }

  std::optional<Statement> next() {
    Statement statement;
    while (!bytes_.empty()) {
      const std::string_view text = take_line();
      if (!add_words(text, statement) && !statement.words.empty()) return statement;
    }
    if (statement.words.empty()) return std::nullopt;
    return statement;
  }

 private:
  std::string_view take_line() {
    ++line_;
    const size_t end = bytes_.find_first_of("\r\n");
    const std::string_view text = bytes_.substr(0, end);
    bytes_.remove_prefix(text.size());
    bytes_.remove_prefix(bytes_.starts_with("\r\n") ? 2 : bytes_.empty() ? 0 : 1);
    return text;
  }

  /// Whether the statement goes on in the next line.
  bool add_words(std::string_view text, Statement& statement) const {
    const bool goes_on_if_last = text.ends_with('\\');
    const size_t size = text.size() - (goes_on_if_last ? 1 : 0);
    for (size_t at = 0; at < size;) {
      if (is_blank(text[at])) {
        ++at;
        continue;
      }
      size_t end = at;
      while (end < size && !is_blank(text[end]) && !begins_comment(text, at, end, statement)) ++end;
      const bool is_sharp = end == at || (text.substr(at, end - at) == "#");
      if (is_sharp) return false;
      if (statement.words.empty()) statement.line = line_;
      statement.words.emplace_back(text.substr(at, end - at));
      at = end;
    }
    return goes_on_if_last;
  }

  static bool begins_comment(std::string_view text, size_t word, size_t at,
                             const Statement& statement) {
    if (text[at] != '#') return false;
    if (statement.words.empty()) return at == word;
    return !names_something(statement.words[0]);
  }

  std::string_view bytes_;
  int64_t line_ = 0;
};

size_t count_digits(const std::string& text, size_t at) {
  size_t end = at;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
  return end - at;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_special_number(const std::string& text) {
  const std::string lower = lower_case(text);
  if (lower == "inf" || lower == "infinity" || lower == "nan") return true;
  if (!lower.starts_with("nan(") || !lower.ends_with(')')) return false;
  for (const char c : lower.substr(4, lower.size() - 5)) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  }
  return true;
}

bool is_decimal(const std::string& text) {
  size_t at = count_digits(text, 0);
  size_t digits = at;
  if (at < text.size() && text[at] == '.') {
    const size_t decimals = count_digits(text, at + 1);
    digits += decimals;
    at += 1 + decimals;
  }
  if (digits == 0) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const size_t exponent = count_digits(text, at);
    if (exponent == 0) return false;
    at += exponent;
  }
  return at == text.size();
}

std::optional<double> read_number(const std::string& word) {
  const bool has_sign = word.starts_with('+') || word.starts_with('-');
  const std::string unsigned_word = word.substr(has_sign ? 1 : 0);
  if (!is_decimal(unsigned_word) && !is_special_number(unsigned_word)) return std::nullopt;
  return std::strtod(word.c_str(), nullptr);
}

/// Numbers in words 1 to `count`; nothing where one is missing or malformed.
std::optional<Vec3d> read_vector(const Statement& statement, size_t count) {
  Vec3d vector(0.0);
  for (size_t i = 0; i < count; ++i) {
    if (statement.words.size() <= i + 1) return std::nullopt;
    const std::optional<double> number = read_number(statement.words[i + 1]);
    if (!number) return std::nullopt;
    vector[static_cast<int>(i)] = *number;
  }
  return vector;
}

/// As written; 0 stands for what no array can hold.
struct WrittenIndex {
  bool is_there = false;
  int64_t value = 0;
};

/// Passes an optional index.
WrittenIndex take_index(std::string_view& text) {
  size_t end = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  const size_t first_digit = end;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
  if (end == first_digit) return {};
  const long long value = std::strtoll(std::string(text.substr(0, end)).c_str(), nullptr, 10);
  text.remove_prefix(end);
  const bool is_small = std::abs(static_cast<double>(value)) <= 0x7fffffff;
  return {true, is_small ? value : 0};
}

bool take_slash(std::string_view& text) {
  if (!text.starts_with('/')) return false;
  text.remove_prefix(1);
  return true;
}

struct WrittenCorner {
  int64_t position = 0, texcoord = 0, normal = 0;
};

std::optional<WrittenCorner> read_corner(std::string_view text) {
  WrittenCorner corner;
  const WrittenIndex position = take_index(text);
  if (!position.is_there || position.value == 0) return std::nullopt;
  corner.position = position.value;
  if (take_slash(text)) {
    corner.texcoord = take_index(text).value;
    if (take_slash(text)) corner.normal = take_index(text).value;
  }
  return text.empty() ? std::optional(corner) : std::nullopt;
}

bool fits_float(const Vec3d& position) {
  constexpr double largest = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(position[axis]) <= largest)) return false;
  }
  return true;
}

class ObjReader {
 public:
  ReferenceObj read(std::string_view bytes) {
    StatementReader reader(bytes);
    while (const auto statement = reader.next()) add(*statement);
    for (const Pending& face : pending_) resolve(face);
    return std::move(obj_);
  }

 private:
  /// A face may stand before its vertices; negative indices count from what stood before it.
  struct Pending {
    ReferenceFace face;
    std::vector<WrittenCorner> corners;
    size_t positions = 0, texcoords = 0, normals = 0;
    bool is_faulty = false;
  };

  void add(const Statement& statement) {
    const std::string& keyword = statement.words[0];
    if (keyword == "v") {
      obj_.positions.push_back(read_vector(statement, 3).value_or(Vec3d(not_a_number)));
    } else if (keyword == "vt") {
      const bool has_one = statement.words.size() == 2;
      const auto read = read_vector(statement, has_one ? 1 : 2);
      obj_.texcoords.push_back(read ? Vec2d(read->x, read->y) : Vec2d(not_a_number));
    } else if (keyword == "vn") {
      obj_.normals.push_back(read_vector(statement, 3).value_or(Vec3d(0.0)));
    } else if (keyword == "f" || keyword == "fo") {
      add_face(statement);
    } else if (keyword == "usemtl") {
      material_.clear();
      for (size_t i = 1; i < statement.words.size(); ++i) {
        material_ += (i > 1 ? " " : "") + statement.words[i];
      }
    }
  }

  void add_face(const Statement& statement) {
    Pending pending{{statement.line, material_, {}},
                    {},
                    obj_.positions.size(),
                    obj_.texcoords.size(),
                    obj_.normals.size()};
    for (size_t i = 1; i < statement.words.size() && !pending.is_faulty; ++i) {
      const auto corner = read_corner(statement.words[i]);
      pending.is_faulty = !corner || i > max_corners;
      if (corner) pending.corners.push_back(*corner);
    }
    pending.is_faulty = pending.is_faulty || pending.corners.size() < 3;
    pending_.push_back(std::move(pending));
  }

  static int64_t from_0(int64_t written, size_t before, size_t total) {
    const int64_t index = written < 0 ? static_cast<int64_t>(before) + written : written - 1;
    return index >= 0 && index < static_cast<int64_t>(total) ? index : -1;
  }

  void resolve(const Pending& pending) {
    ReferenceFace face = pending.face;
    bool is_faulty = pending.is_faulty;
    for (const WrittenCorner& written : pending.corners) {
      const ReferenceCorner corner{
          from_0(written.position, pending.positions, obj_.positions.size()),
          written.texcoord == 0
              ? -1
              : from_0(written.texcoord, pending.texcoords, obj_.texcoords.size()),
          written.normal == 0 ? -1 : from_0(written.normal, pending.normals, obj_.normals.size())};
      is_faulty = is_faulty || corner.position < 0 ||
                  !fits_float(obj_.positions[static_cast<size_t>(corner.position)]);
      face.corners.push_back(corner);
    }
    if (is_faulty) {
      obj_.lines_of_dropped_faces.push_back(face.line);
    } else {
      obj_.faces.push_back(std::move(face));
    }
  }

  ReferenceObj obj_;
  std::vector<Pending> pending_;
  std::string material_;
};

}  // namespace

ReferenceObj read_reference_obj(std::string_view bytes) {
  return ObjReader().read(bytes);
}

}  // namespace tracer
