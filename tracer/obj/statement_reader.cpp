// SPDX-License-Identifier: MIT
#include "tracer/obj/statement_reader.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace tracer {
namespace {

constexpr size_t usual_capacity = size_t{1} << 22;
constexpr size_t piece_bytes = size_t{1} << 16;
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool ends_line(std::string_view text, size_t at) {
  return text[at] == '\n' || (text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n'));
}

/// Whether a backslash stands before the end of a line whose last byte is at `at`.
bool is_continued(std::string_view text, size_t at) {
  const size_t line_end = at - (text[at] == '\n' && at > 0 && text[at - 1] == '\r' ? 1 : 0);
  return line_end > 0 && text[line_end - 1] == '\\';
}

/// Past the last end of a line in [from, size) that no backslash continues; 0 where there is none.
/// A CR that is the last byte may be half of a CRLF.
size_t last_statement_end(std::string_view text, size_t from) {
  for (size_t at = text.size(); at > from; --at) {
    const bool is_certain = at < text.size() || text[at - 1] != '\r';
    if (is_certain && ends_line(text, at - 1) && !is_continued(text, at - 1)) return at;
  }
  return 0;
}

}  // namespace

void TextBlock::reserve(size_t capacity) {
  if (capacity <= capacity_) return;
  void* const grown = std::realloc(bytes_.get(), capacity + 2 * margin + 64);
  if (grown == nullptr) throw std::bad_alloc();
  static_cast<void>(bytes_.release());
  bytes_.reset(static_cast<char*>(grown));
  std::memset(bytes_.get(), 0, margin);
  capacity_ = capacity;
}

bool StatementReader::next(TextBlock& block) {
  if (is_at_end_ && carried_.empty()) return false;
  if (block.capacity_ > std::max(usual_capacity, 4 * block_bytes_)) block = {};
  block.size_ = 0;
  block.is_cut_ = false;
  block.lines_left_out_ = 0;
  size_t searched = 0;
  for (size_t wanted = block_bytes_;; wanted = 2 * block.size_) {
    fill(block, wanted);
    if (is_at_end_) break;
    const size_t end = last_statement_end(block.text(), searched);
    if (end > 0) {
      split_behind(block, end);
      break;
    }
    // What follows may show that the last byte ended a statement.
    searched = block.size_ - 1;
    if (block.size_ >= longest_statement_bytes) {
      leave_out_rest_of_statement(block);
      break;
    }
  }
  if (block.size_ == 0) return false;
  if (is_first_ && block.text().starts_with(byte_order_mark)) {
    std::memset(block.data(), ' ', byte_order_mark.size());
  }
  is_first_ = false;
  std::memset(block.data() + block.size_, 0, TextBlock::margin);
  if (!block.is_cut_) block.data()[block.size_] = '\n';
  return true;
}

/// Until the block has `wanted_bytes`, or the text ends.
void StatementReader::fill(TextBlock& block, size_t wanted_bytes) {
  block.reserve(wanted_bytes);
  const size_t from_carried = std::min(carried_.size(), wanted_bytes - block.size_);
  std::memcpy(block.data() + block.size_, carried_.data(), from_carried);
  carried_.erase(0, from_carried);
  block.size_ += from_carried;
  if (block.size_ == wanted_bytes || is_at_end_) return;
  const std::span<char> rest(block.data() + block.size_, wanted_bytes - block.size_);
  const size_t count = source_.read(rest);
  block.size_ += count;
  is_at_end_ = count < rest.size();
}

void StatementReader::split_behind(TextBlock& block, size_t statement_end) {
  carried_.insert(0, block.data() + statement_end, block.size_ - statement_end);
  block.size_ = statement_end;
}

void StatementReader::leave_out_rest_of_statement(TextBlock& block) {
  constexpr size_t context = 3;  // a backslash and CRLF
  block.is_cut_ = true;
  // The last byte is left out too: it may be half of what ends the line.
  std::string text(block.text().substr(block.size_ - context - 1));
  --block.size_;
  for (;;) {
    fill_piece(text);
    const size_t known = is_at_end_ ? text.size() : text.size() - 1;
    for (size_t i = context; i < known; ++i) {
      if (!ends_line(text, i)) continue;
      ++block.lines_left_out_;
      if (is_continued(text, i)) continue;
      carried_ = text.substr(i + 1);
      return;
    }
    if (is_at_end_) return;
    text.erase(0, known - context);
  }
}

void StatementReader::fill_piece(std::string& text) {
  const size_t kept = text.size();
  text.resize(kept + piece_bytes);
  const size_t count = source_.read(std::span(text).subspan(kept));
  text.resize(kept + count);
  is_at_end_ = count < piece_bytes;
}

}  // namespace tracer
