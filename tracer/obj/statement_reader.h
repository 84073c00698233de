// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tracer/base/byte_source.h"

namespace tracer {

/// Statements of more bytes are cut: a face of 2^20 corners has room for 40 bytes a corner.
inline constexpr size_t longest_statement_bytes = size_t{40} << 20;

/// A run of whole statements in memory of its own. 64 bytes before and behind
/// the text may be read; a line feed stands behind it, so that every line ends, or a NUL where the
/// last statement is cut.
class TextBlock {
 public:
  std::string_view text() const { return {bytes_.get() + margin, size_}; }
  /// The last statement is longer than longest_statement_bytes; what follows is left out.
  bool is_cut() const { return is_cut_; }
  /// Ends of lines that were left out.
  int64_t lines_left_out() const { return lines_left_out_; }

 private:
  friend class StatementReader;
  static constexpr size_t margin = 64;

  struct Free {
    void operator()(char* bytes) const { std::free(bytes); }
  };

  /// Keeps what there is.
  void reserve(size_t capacity);
  char* data() { return bytes_.get() + margin; }

  std::unique_ptr<char[], Free> bytes_;
  size_t capacity_ = 0;
  size_t size_ = 0;
  bool is_cut_ = false;
  int64_t lines_left_out_ = 0;
};

/// Cuts a text into blocks, each of whole statements: a statement ends where a line does that no
/// backslash continues. A byte order mark becomes blanks.
class StatementReader {
 public:
  /// Blocks are of about `block_bytes` >= 1, longer where a statement is.
  StatementReader(ByteSource& source, size_t block_bytes)
      : source_(source), block_bytes_(block_bytes) {}

  /// The next block; false at the end of the text. Throws what the source throws.
  bool next(TextBlock& block);

 private:
  void fill(TextBlock& block, size_t wanted_bytes);
  void split_behind(TextBlock& block, size_t statement_end);
  void leave_out_rest_of_statement(TextBlock& block);
  void fill_piece(std::string& text);

  ByteSource& source_;
  const size_t block_bytes_;
  std::string carried_;  // read already, for the next block
  bool is_first_ = true;
  bool is_at_end_ = false;
};

}  // namespace tracer
