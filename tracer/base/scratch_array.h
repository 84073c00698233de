// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include "tracer/base/huge_pages.h"

namespace tracer {

/// Many elements, none of them initialised, in huge pages where there are such.
template <class T>
requires std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>
class ScratchArray {
 public:
  ScratchArray() = default;
  explicit ScratchArray(size_t count) : data_(static_cast<T*>(std::malloc(count * sizeof(T)))) {
    if (!data_ && count > 0) throw std::bad_alloc();
    prefer_huge_pages(data_.get(), count * sizeof(T));
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }

 private:
  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  std::unique_ptr<T[], Free> data_;
};

}  // namespace tracer
