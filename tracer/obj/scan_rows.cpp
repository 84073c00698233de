// SPDX-License-Identifier: MIT
#include "tracer/obj/scan_rows.h"

#include "tracer/obj/scan_number.h"
#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

inline const char* skip_blanks(const char* at) {
  while (*at == ' ' || *at == '\t') ++at;
  return at;
}

/// How many numbers the line has, at most `count` of which are read; 0 where it has more, or what
/// is no number. `at` is left on the line's end.
inline int scan_numbers(const char*& at, int count, double* numbers) {
  at = skip_blanks(at);
  for (int i = 0; i < count;) {
    if (!scan_double(at, numbers[i++])) return 0;
    if (at[0] == ' ' && static_cast<unsigned char>(at[1]) > ' ') {
      ++at;
      continue;
    }
    if (!is_blank(*at) && !is_line_end(*at)) return 0;
    at = skip_blanks(at);
    if (is_line_end(*at)) return i;
  }
  return 0;
}

bool round_all(const double* numbers, int count, float* rounded) {
  for (int i = 0; i < count; ++i) {
    if (!round_to_float(numbers[i], rounded[i])) return false;
  }
  return true;
}

inline void add_index(int32_t index, uint32_t& largest, int32_t*& to) {
  largest = std::max(largest, static_cast<uint32_t>(index));
  *to++ = index;
}

/// A corner whose indices have no sign, and eight digits at most; otherwise nothing is passed.
template <CornerForm form>
inline bool scan_plain_corner(const char*& at, LargestIndices& largest, int32_t*& to) {
  DigitRuns runs(at);
  const DigitRun position = runs.next();
  DigitRun texcoord = position;
  DigitRun normal = position;
  bool is_plain = position.is_usable();
  if constexpr (has_texcoord(form)) {
    is_plain = is_plain && *runs.end() == '/';
    texcoord = runs.next();
  } else if constexpr (has_normal(form)) {
    is_plain = is_plain && *runs.end() == '/' && runs.next().count == 0;
  }
  if constexpr (has_normal(form)) {
    is_plain = is_plain && *runs.end() == '/';
    normal = runs.next();
  }
  if (!is_plain || !texcoord.is_usable() || !normal.is_usable()) return false;
  const auto value_of = [](const DigitRun& run) { return static_cast<int32_t>(run.value()); };
  if (value_of(position) == 0 || value_of(texcoord) == 0 || value_of(normal) == 0) return false;
  add_index(value_of(position), largest.position, to);
  if constexpr (has_texcoord(form)) add_index(value_of(texcoord), largest.texcoord, to);
  if constexpr (has_normal(form)) add_index(value_of(normal), largest.normal, to);
  at = runs.end();
  return true;
}

/// Three corners of a position each, one blank between, and the line's end; otherwise nothing is
/// passed, nor written.
inline bool scan_plain_triangle(const char*& at, LargestIndices& largest, int32_t* to) {
  DigitRuns runs(at);
  const DigitRun a = runs.next();
  bool is_plain = *runs.end() == ' ';
  const DigitRun b = runs.next();
  is_plain = is_plain && *runs.end() == ' ';
  const DigitRun c = runs.next();
  is_plain = is_plain && is_line_end(*runs.end());
  if (!is_plain || !a.is_usable() || !b.is_usable() || !c.is_usable()) return false;
  to[0] = static_cast<int32_t>(a.value());
  to[1] = static_cast<int32_t>(b.value());
  to[2] = static_cast<int32_t>(c.value());
  if (to[0] == 0 || to[1] == 0 || to[2] == 0) return false;
  for (int i = 0; i < 3; ++i) {
    largest.position = std::max(largest.position, static_cast<uint32_t>(to[i]));
  }
  at = runs.end();
  return true;
}

/// The index of one kind, which a '/' stands before.
inline bool scan_behind_slash(const char*& at, uint32_t& largest, int32_t*& to) {
  if (*at != '/') return false;
  const int32_t index = scan_index(++at);
  add_index(index, largest, to);
  return index != 0;
}

template <CornerForm form>
inline bool scan_corner(const char*& at, LargestIndices& largest, int32_t*& to) {
  if (scan_plain_corner<form>(at, largest, to)) return true;
  const int32_t position = scan_index(at);
  add_index(position, largest.position, to);
  if (position == 0) return false;
  if constexpr (has_texcoord(form)) {
    if (!scan_behind_slash(at, largest.texcoord, to)) return false;
  } else if constexpr (has_normal(form)) {
    if (*at++ != '/') return false;
  }
  if constexpr (has_normal(form)) return scan_behind_slash(at, largest.normal, to);
  return true;
}

/// How many corners there are up to the line's end, where `at` is left; 0 where one is of another
/// form. Their indices are written behind the last of `content`.
template <CornerForm form>
uint32_t scan_corners(const char*& at, LargestIndices& largest, ChunkContent& content) {
  int32_t* to = content.indices.free_room();
  if (form == CornerForm::position && scan_plain_triangle(at, largest, to)) return 3;
  // In registers: bytes that are written may lie anywhere, for all the compiler knows.
  const char* here = at;
  LargestIndices largest_here = largest;
  for (uint32_t corner_count = 1; corner_count <= max_face_corners; ++corner_count) {
    if (!scan_corner<form>(here, largest_here, to)) return 0;
    if (here[0] == ' ' && static_cast<unsigned char>(here[1]) > ' ') {
      ++here;
      continue;
    }
    if (is_blank(*here))
      here = skip_blanks(here + 1);
    else if (!is_line_end(*here))
      return 0;
    if (!is_line_end(*here)) continue;
    at = here;
    largest = largest_here;
    return corner_count;
  }
  return 0;
}

uint32_t scan_corners_of(CornerForm form, const char*& at, LargestIndices& largest,
                         ChunkContent& content) {
  switch (form) {
    case CornerForm::position:
      return scan_corners<CornerForm::position>(at, largest, content);
    case CornerForm::texcoord:
      return scan_corners<CornerForm::texcoord>(at, largest, content);
    case CornerForm::normal:
      return scan_corners<CornerForm::normal>(at, largest, content);
    default:
      return scan_corners<CornerForm::both>(at, largest, content);
  }
}

CornerForm form_of_corner(const char* at) {
  scan_index(at);
  if (*at != '/') return CornerForm::position;
  if (*++at == '/') return CornerForm::normal;
  scan_index(at);
  return *at == '/' ? CornerForm::both : CornerForm::texcoord;
}

}  // namespace

const char* scan_position(const char* at, ChunkContent& content) {
  constexpr int most_numbers = 8;
  double numbers[most_numbers];
  const int count = scan_numbers(at, most_numbers, numbers);
  if (count < 3) return nullptr;
  Vec3f color;
  if (count >= 6 && !round_all(numbers + 3, 3, &color.x)) return nullptr;
  content.push_position({numbers[0], numbers[1], numbers[2]});
  if (count >= 6) {
    content.push_color(color);
  } else {
    content.push_no_color();
  }
  return next_line(at);
}

const char* scan_texcoord(const char* at, ChunkContent& content) {
  double numbers[3];
  Vec2f texcoord(0.0f);
  const int count = scan_numbers(at, 3, numbers);
  if (count == 0 || !round_all(numbers, std::min(count, 2), &texcoord.x)) return nullptr;
  content.texcoords.push(texcoord);
  return next_line(at);
}

const char* scan_normal(const char* at, ChunkContent& content) {
  double numbers[3];
  Vec3f normal;
  if (scan_numbers(at, 3, numbers) != 3 || !round_all(numbers, 3, &normal.x)) return nullptr;
  content.normals.push(normal);
  return next_line(at);
}

const char* scan_face(const char* at, const FacePlace& place, CornerForm& form,
                      LargestIndices& largest, ChunkContent& content) {
  at = skip_blanks(at);
  const char* here = at;
  uint32_t corner_count = scan_corners_of(form, here, largest, content);
  if (corner_count == 0) {
    const CornerForm other = form_of_corner(at);
    if (other == form) return nullptr;
    form = other;
    here = at;
    corner_count = scan_corners_of(form, here, largest, content);
  }
  if (corner_count < 3) return nullptr;
  content.indices.keep(size_t{corner_count} * indices_a_corner(form));
  content.add_face(corner_count, form, place.material, place.line);
  return next_line(here);
}

}  // namespace tracer
