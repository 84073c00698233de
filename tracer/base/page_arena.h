// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <type_traits>

namespace tracer {

/// Some elements in a PageArena's memory. Copies share them.
template <class T>
class PageArray {
 public:
  PageArray() = default;
  PageArray(std::shared_ptr<T[]> elements, size_t size)
      : elements_(std::move(elements)), size_(size) {}

  bool empty() const { return size_ == 0; }
  size_t size() const { return size_; }
  T* data() { return elements_.get(); }
  const T* data() const { return elements_.get(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](size_t i) { return elements_[i]; }
  const T& operator[](size_t i) const { return elements_[i]; }

 private:
  std::shared_ptr<T[]> elements_;
  size_t size_ = 0;
};

/// Memory in huge pages for many arrays that are let go in about the order in which they were made:
/// a page is the system's again when the last array in it ends, while something as large is made of
/// what was in them. Any thread may use it.
class PageArena {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T> PageArray<T> copy(std::span<const T> elements) {
    if (elements.empty()) return {};
    const std::shared_ptr<std::byte[]> memory = allocate(elements.size_bytes());
    std::memcpy(memory.get(), elements.data(), elements.size_bytes());
    return {std::shared_ptr<T[]>(memory, reinterpret_cast<T*>(memory.get())), elements.size()};
  }

 private:
  /// At a multiple of 64, and not initialised. Throws std::bad_alloc.
  std::shared_ptr<std::byte[]> allocate(size_t size_bytes);

  std::mutex mutex_;
  std::shared_ptr<std::byte[]> slab_;
  size_t slab_left_ = 0;  // bytes at its end
  std::byte* next_ = nullptr;
};

}  // namespace tracer
