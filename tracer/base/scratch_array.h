// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <memory>
#include <type_traits>

#include "tracer/base/huge_pages.h"

namespace tracer {

/// Many elements, none of them initialised, in huge pages where there are such.
template <class T>
requires std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>
class ScratchArray {
 public:
  ScratchArray() = default;
  explicit ScratchArray(size_t count)
      : data_(static_cast<T*>(allocate_in_huge_pages(count * sizeof(T)))) {}

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
