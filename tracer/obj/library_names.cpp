// SPDX-License-Identifier: MIT
#include "tracer/obj/library_names.h"

#include <algorithm>

namespace tracer {
namespace {

bool ends_with_mtl(std::string_view name) {
  if (name.size() < 4 || name[name.size() - 4] != '.') return false;
  const std::string_view extension = name.substr(name.size() - 3);
  return (extension[0] | 0x20) == 'm' && (extension[1] | 0x20) == 't' &&
         (extension[2] | 0x20) == 'l';
}

}  // namespace

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

}  // namespace tracer
