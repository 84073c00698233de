// SPDX-License-Identifier: MIT
// POSIX regular expressions: those of the standard library warn under the sanitizers of g++ 12.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <regex.h>

namespace tracer {

/// An extended regular expression with at least one group.
class Pattern {
 public:
  explicit Pattern(const char* expression) {
    if (regcomp(&compiled_, expression, REG_EXTENDED) != 0) throw std::logic_error(expression);
  }
  ~Pattern() { regfree(&compiled_); }
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;

  /// What the first group matched, for each match in the text; "" where it took no part.
  std::vector<std::string> first_groups(const std::string& text) const {
    std::vector<std::string> found;
    regmatch_t match[2];
    for (const char* rest = text.c_str(); regexec(&compiled_, rest, 2, match, 0) == 0;
         rest += match[0].rm_eo) {
      const bool took_part = match[1].rm_so >= 0;
      found.push_back(took_part ? std::string(rest + match[1].rm_so, rest + match[1].rm_eo) : "");
    }
    return found;
  }

 private:
  regex_t compiled_;
};

}  // namespace tracer
