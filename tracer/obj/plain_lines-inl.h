// SPDX-License-Identifier: MIT
#if defined(TRACER_PLAIN_LINES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_PLAIN_LINES_INL_H
#undef TRACER_PLAIN_LINES_INL_H
#else
#define TRACER_PLAIN_LINES_INL_H
#endif

#include "tracer/obj/plain_numbers-inl.h"
#include "tracer/obj/scan_lines.h"
#include "tracer/obj/scan_rows.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

#ifdef TRACER_HAS_PLAIN_NUMBERS

/// Scans the forms that nearly all lines have; like the functions of scan_rows.h, which read the
/// others, but for the largest indices: those it keeps until it ends.
class PlainLines {
 public:
  explicit PlainLines(LineScan& scan) : scan_(scan) {}
  PlainLines(const PlainLines&) = delete;
  PlainLines& operator=(const PlainLines&) = delete;

  ~PlainLines() {
    alignas(16) std::array<uint32_t, 4> in_triangles, in_corners;
    _mm_store_si128(reinterpret_cast<__m128i*>(in_triangles.data()), largest_in_triangles_);
    _mm_store_si128(reinterpret_cast<__m128i*>(in_corners.data()), largest_in_corners_);
    LargestIndices& largest = scan_.largest;
    for (const uint32_t position : in_triangles) raise(largest.position, position);
    raise(largest.position, in_corners[0]);
    raise(largest.texcoord, in_corners[1]);
    raise(largest.normal, in_corners[2]);
  }

  HWY_INLINE const char* position(const char* at) {
    std::array<DecimalPlace, 3> places;
    const char* const line_end = find_decimals<3>(at, places);
    if (line_end == nullptr) return scan_position(at, scan_.content);
    double* const to = &scan_.content.positions.free_room()->x;
    _mm_storeu_pd(to, decimal_values(at, places[0], places[1]));
    _mm_store_sd(to + 2, decimal_values(at, places[2], places[2]));
    scan_.content.positions.keep(1);
    scan_.content.push_no_color();
    return next_line(line_end);
  }

  HWY_INLINE const char* texcoord(const char* at) {
    std::array<DecimalPlace, 2> places;
    const char* const line_end = find_decimals<2>(at, places);
    if (line_end == nullptr) return scan_texcoord(at, scan_.content);
    const __m128d values = decimal_values(at, places[0], places[1]);
    if (between_floats(values) != 0) return scan_texcoord(at, scan_.content);
    store_floats(&scan_.content.texcoords.free_room()->x, values);
    scan_.content.texcoords.keep(1);
    return next_line(line_end);
  }

  HWY_INLINE const char* normal(const char* at) {
    std::array<DecimalPlace, 3> places;
    const char* const line_end = find_decimals<3>(at, places);
    if (line_end == nullptr) return scan_normal(at, scan_.content);
    const __m128d xy = decimal_values(at, places[0], places[1]);
    const __m128d zz = decimal_values(at, places[2], places[2]);
    if ((between_floats(xy) | between_floats(zz)) != 0) return scan_normal(at, scan_.content);
    float* const to = &scan_.content.normals.free_room()->x;
    store_floats(to, xy);
    _mm_store_ss(to + 2, _mm_cvtpd_ps(zz));
    scan_.content.normals.keep(1);
    return next_line(line_end);
  }

  HWY_INLINE const char* face(const char* at, uint32_t line) {
    const char* next = nullptr;
    if (scan_.form == CornerForm::position) {
      next = triangle(at, line);
    } else if (scan_.form == CornerForm::both) {
      next = polygon<CornerForm::both>(at, line);
    } else if (scan_.form == CornerForm::normal) {
      next = polygon<CornerForm::normal>(at, line);
    } else {
      next = polygon<CornerForm::texcoord>(at, line);
    }
    if (next != nullptr) return next;
    return scan_face(at, {scan_.material, line}, scan_.form, scan_.largest, scan_.content);
  }

 private:
  static void raise(uint32_t& largest, uint32_t index) { largest = std::max(largest, index); }

  void add_face(uint32_t corner_count, uint32_t line) {
    scan_.content.indices.keep(size_t{corner_count} * indices_a_corner(scan_.form));
    scan_.content.add_face(corner_count, scan_.form, scan_.material, line);
  }

  /// Three positions.
  HWY_INLINE const char* triangle(const char* at, uint32_t line) {
    const ByteKinds kinds = kinds_of_32(at);
    uint64_t others = kinds.others | kinds.minuses;
    const int a_end = take_lowest(others);
    const int b_end = take_lowest(others);
    const int c_end = take_lowest(others);
    const IndexPlace a{a_end, a_end}, b{b_end, b_end - a_end - 1}, c{c_end, c_end - b_end - 1};
    const int wrong_byte = (at[a_end] ^ ' ') | (at[b_end] ^ ' ');
    if ((excess(a) | excess(b) | excess(c)) >= 8 || wrong_byte != 0 || !is_line_end(at[c_end])) {
      return nullptr;
    }
    const __m128i values = index_values(at, {a, b, c, c});
    if (has_zero(values)) return nullptr;
    largest_in_triangles_ = _mm_max_epu32(largest_in_triangles_, values);
    store(scan_.content.indices.free_room(), values);
    add_face(3, line);
    return next_line(at + c_end);
  }

  /// Three or four corners that have more than a position.
  template <CornerForm form>
  HWY_INLINE const char* polygon(const char* at, uint32_t line) {
    int32_t* to = scan_.content.indices.free_room();
    ByteKinds kinds = kinds_of_64(at);
    uint64_t others = kinds.others | kinds.minuses;
    __m128i largest = largest_in_corners_;
    int begin = 0;
    for (uint32_t corner_count = 1; corner_count <= 4; ++corner_count) {
      std::array<IndexPlace, 4> places;
      uint64_t rest = others;
      int end = find_corner<form>(begin, rest, places);
      if (end == 64) {
        at += begin;
        kinds = kinds_of_64(at);
        rest = kinds.others | kinds.minuses;
        begin = 0;
        end = find_corner<form>(begin, rest, places);
        if (end == 64) return nullptr;
      }
      others = rest;
      if (!is_corner<form>(at, places)) return nullptr;
      const __m128i values = index_values(at, places);
      if (has_zero(values)) return nullptr;
      largest = _mm_max_epu32(largest, by_kind<form>(values));
      store(to, values);
      to += indices_a_corner(form);
      begin = end + 1;
      if (at[end] == ' ') continue;
      if (!is_line_end(at[end]) || corner_count < 3) return nullptr;
      largest_in_corners_ = largest;
      add_face(corner_count, line);
      return next_line(at + end);
    }
    return nullptr;
  }

  /// Where the corner's indices stand, the last one again for those that it has not; its end, 64
  /// where not all of it is known.
  template <CornerForm form>
  static HWY_INLINE int find_corner(int begin, uint64_t& ends, std::array<IndexPlace, 4>& places) {
    const int first_end = take_lowest(ends);
    places[0] = {first_end, first_end - begin};
    int end = take_lowest(ends);
    places[1] = {end, end - first_end - 1};
    if (form != CornerForm::texcoord) {
      const int before = end;
      end = take_lowest(ends);
      places[2] = {end, end - before - 1};
    } else {
      places[2] = places[1];
    }
    places[3] = places[2];
    return end;
  }

  template <CornerForm form>
  static HWY_INLINE bool is_corner(const char* at, std::array<IndexPlace, 4>& places) {
    int wrong_byte = at[places[0].end] ^ '/';
    if (form != CornerForm::texcoord) wrong_byte |= at[places[1].end] ^ '/';
    if (form == CornerForm::normal) {
      wrong_byte |= places[1].digit_count;
      places[1] = places[2];
    }
    const unsigned excesses = excess(places[0]) | excess(places[1]) | excess(places[2]);
    return wrong_byte == 0 && excesses < 8;
  }

  /// Position, texcoord, normal: 0 where there is none.
  template <CornerForm form>
  static HWY_INLINE __m128i by_kind(__m128i values) {
    if (form == CornerForm::texcoord) return _mm_move_epi64(values);
    if (form == CornerForm::normal) return _mm_blend_epi16(values, _mm_setzero_si128(), 0b1100);
    return values;
  }

  static HWY_INLINE void store_floats(float* to, __m128d values) {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_castps_si128(_mm_cvtpd_ps(values)));
  }

  static HWY_INLINE void store(int32_t* to, __m128i values) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), values);
  }

  LineScan& scan_;
  __m128i largest_in_triangles_ = _mm_setzero_si128();
  __m128i largest_in_corners_ = _mm_setzero_si128();  // position, texcoord, normal
};

#else

class PlainLines {
 public:
  explicit PlainLines(LineScan& scan) : scan_(scan) {}

  const char* position(const char* at) { return scan_position(at, scan_.content); }
  const char* texcoord(const char* at) { return scan_texcoord(at, scan_.content); }
  const char* normal(const char* at) { return scan_normal(at, scan_.content); }
  const char* face(const char* at, uint32_t line) {
    return scan_face(at, {scan_.material, line}, scan_.form, scan_.largest, scan_.content);
  }

 private:
  LineScan& scan_;
};

#endif

/// Where the next line begins; nullptr where the line is of another form.
HWY_INLINE const char* scan_line(const char* at, uint32_t line, PlainLines& lines) {
  switch (at[0]) {
    case 'v':
      if (is_blank(at[1])) return lines.position(at + 2);
      if (at[1] == 'n' && is_blank(at[2])) return lines.normal(at + 3);
      if (at[1] == 't' && is_blank(at[2])) return lines.texcoord(at + 3);
      return nullptr;
    case 'f':
      return is_blank(at[1]) ? lines.face(at + 2, line) : nullptr;
    case '\n':
      return at + 1;
    default:
      return nullptr;
  }
}

// NOLINTNEXTLINE(misc-definitions-in-headers): each instruction set has a namespace of its own.
LinePlace ScanLines(LinePlace from, const char* end, LineScan& scan) {
  PlainLines lines(scan);
  const char* at = from.at;
  uint32_t line = from.line;
  while (at < end) {
    const char* const next = scan_line(at, line, lines);
    if (next == nullptr) break;
    at = std::min(next, end);
    ++line;
  }
  return {at, line};
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
