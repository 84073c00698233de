// SPDX-License-Identifier: MIT
#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

constexpr size_t longest_quote = 60;

/// Bytes of the UTF-8 character at the front of `text`; 0 where there is none.
size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const size_t length = lead < 0x80                   ? 1
                        : lead >= 0xc2 && lead < 0xe0 ? 2
                        : lead >= 0xe0 && lead < 0xf0 ? 3
                        : lead >= 0xf0 && lead < 0xf5 ? 4
                                                      : 0;
  if (length == 0 || length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  }
  if (length < 3) return length;
  // Overlong forms, surrogates, and what lies beyond U+10FFFF.
  const auto second = static_cast<unsigned char>(text[1]);
  const bool is_invalid = (lead == 0xe0 && second < 0xa0) || (lead == 0xed && second >= 0xa0) ||
                          (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second >= 0x90);
  return is_invalid ? 0 : length;
}

}  // namespace

bool TextCursor::next_statement() {
  while (at_ != end_) {
    skip_blanks();
    if (at_ == end_) break;
    if (*at_ == '#') skip_comment();
    if (at_ == end_) break;
    if (!is_line_end(*at_)) {
      statement_line_ = line_;
      return true;
    }
    skip_line_end();
  }
  return false;
}

void TextCursor::finish_statement() {
  while (at_ != end_ && !is_line_end(*at_)) {
    if (*at_ == '#') {
      skip_comment();
    } else if (*at_ == '\\') {
      skip_blanks();
      if (at_ != end_ && *at_ == '\\') ++at_;
    } else {
      ++at_;
    }
  }
  if (at_ != end_) skip_line_end();
}

std::string_view TextCursor::peek_token() const {
  const char* at = at_;
  while (at != end_ && !is_blank(*at) && !is_line_end(*at) && !is_continuation(at)) ++at;
  return {at_, static_cast<size_t>(at - at_)};
}

std::string_view TextCursor::token() {
  const std::string_view token = peek_token();
  at_ += token.size();
  return token;
}

std::string TextCursor::name() {
  std::string name;
  for (;;) {
    skip_blanks();
    const std::string_view word = token();
    if (word.empty()) return name;
    if (word == "#") {
      skip_comment();
      return name;
    }
    if (!name.empty()) name += ' ';
    name += word;
  }
}

std::string quote_text(std::string_view text) {
  std::string result = "'";
  while (!text.empty() && result.size() < longest_quote) {
    const size_t length = utf8_length(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool is_printable = length > 0 && first >= 0x20 && first != 0x7f;
    if (is_printable) {
      result += text.substr(0, length);
    } else {
      result += '?';
    }
    text.remove_prefix(is_printable ? length : 1);
  }
  return result + (text.empty() ? "'" : "...'");
}

}  // namespace tracer
