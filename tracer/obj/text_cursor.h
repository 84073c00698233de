// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tracer/obj/parse_number.h"

namespace tracer {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
inline bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// Walks a text statement by statement, as OBJ and MTL share them: lines end in LF, CRLF or CR, a
/// backslash before the line's end continues the statement, # begins a comment.
class TextCursor {
 public:
  explicit TextCursor(std::string_view bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  const char* position() const { return at_; }
  const char* end() const { return end_; }
  /// Goes on at `at`, the begin of line `line`.
  void move_to(const char* at, uint32_t line) {
    at_ = at;
    line_ = line;
  }
  /// The line of the next byte, from 1.
  uint32_t line() const { return line_; }

  /// Moves to the next statement's keyword; false at the end of the text.
  bool next_statement();
  /// Passes what is left of the statement.
  void finish_statement();

  /// Where the statement begins, from 1.
  uint32_t statement_line() const { return statement_line_; }

  /// Whether the statement has no more arguments; passes blanks before the next one.
  bool at_statement_end() {
    skip_blanks();
    return at_ == end_ || is_line_end(*at_) || *at_ == '#';
  }
  /// The bytes up to the next blank.
  std::string_view token();
  /// The token ahead, which is not passed.
  std::string_view peek_token() const;
  /// What is left of the statement as a name, which may contain single blanks and '#'; only a '#'
  /// between blanks begins a comment.
  std::string name();
  /// A number that ends where a token ends; nothing is passed where there is none.
  template <class T>
  std::optional<T> number() {
    const Parsed<T> parsed = parse_real<T>(at_, end_);
    if (parsed.end == at_ || !is_argument_end(parsed.end)) return std::nullopt;
    at_ = parsed.end;
    return parsed.value;
  }
  /// A whole number, which need not end the token.
  std::optional<int64_t> integer() {
    const Parsed<int64_t> parsed = parse_int(at_, end_);
    if (parsed.end == at_) return std::nullopt;
    at_ = parsed.end;
    return parsed.value;
  }
  /// Passes `c` if it is the next byte.
  bool skip(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }
  bool at_argument_end() const { return is_argument_end(at_); }

 private:
  bool is_continuation(const char* at) const {
    return *at == '\\' && (at + 1 == end_ || is_line_end(at[1]));
  }
  bool is_argument_end(const char* at) const {
    return at == end_ || is_blank(*at) || is_line_end(*at) || *at == '#' || is_continuation(at);
  }
  void skip_blanks() {
    while (at_ != end_) {
      if (is_blank(*at_)) {
        ++at_;
      } else if (is_continuation(at_)) {
        ++at_;
        if (at_ != end_) skip_line_end();
      } else {
        return;
      }
    }
  }
  void skip_line_end() {
    at_ += at_[0] == '\r' && at_ + 1 != end_ && at_[1] == '\n' ? 2 : 1;
    ++line_;
  }
  void skip_comment() {
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
  }

  const char* at_;
  const char* end_;
  uint32_t line_ = 1;
  uint32_t statement_line_ = 1;
};

/// Text of the user's in single quotes for a message: shortened, and free of control characters
/// and of what is not UTF-8.
std::string quote_text(std::string_view text);

}  // namespace tracer
