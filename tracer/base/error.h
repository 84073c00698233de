// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace tracer {

/// A fault in the user's data, as shown to the user: "cow.obj:17: face index 0: ...". Line 0: the
/// fault belongs to the file as a whole.
struct Message {
  std::string path;
  int64_t line = 0;
  std::string what;

  std::string text() const {
    return line > 0 ? path + ':' + std::to_string(line) + ": " + what : path + ": " + what;
  }
};

/// Nothing could be loaded. Thrown only while loading or writing files.
class LoadError : public std::runtime_error {
 public:
  explicit LoadError(const Message& message) : std::runtime_error(message.text()) {}
};

/// What loading had to leave out or guess: the first messages in file order, and how many in all.
class Warnings {
 public:
  static constexpr size_t kept_messages = 10;

  void add(Message message) {
    ++count_;
    if (messages_.size() < kept_messages) messages_.push_back(std::move(message));
  }
  /// Counts `more` messages that are not kept in words.
  void add_uncounted(int64_t more) { count_ += more; }
  void append(const Warnings& other) {
    for (const Message& message : other.messages_) {
      if (messages_.size() < kept_messages) messages_.push_back(message);
    }
    count_ += other.count_;
  }

  /// Those of a part of a file, of which `lines_before` lines stand before it.
  void append_moved(const Warnings& part, const std::string& path, int64_t lines_before) {
    for (const Message& message : part.messages_) {
      if (messages_.size() >= kept_messages) break;
      messages_.push_back({path, message.line + lines_before, message.what});
    }
    count_ += part.count_;
  }

  /// Both, each in the order of lines, as one list in that order.
  friend Warnings merged_by_line(const Warnings& a, const Warnings& b) {
    Warnings merged;
    std::ranges::merge(a.messages_, b.messages_, std::back_inserter(merged.messages_), {},
                       &Message::line, &Message::line);
    if (merged.messages_.size() > kept_messages) merged.messages_.resize(kept_messages);
    merged.count_ = a.count_ + b.count_;
    return merged;
  }

  int64_t count() const { return count_; }
  const std::vector<Message>& messages() const { return messages_; }

 private:
  std::vector<Message> messages_;
  int64_t count_ = 0;
};

}  // namespace tracer
