// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "tracer/base/huge_pages.h"

namespace tracer {

/// Huge pages where there are such, and elements that are not written until someone does.
template <class T>
requires std::is_trivially_copyable_v<T>
struct LargeAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = LargeAllocator<U>;
  };

  T* allocate(size_t count) { return static_cast<T*>(allocate_in_huge_pages(count * sizeof(T))); }
  void deallocate(T* elements, size_t) { std::free(elements); }

  template <class U, class... Arguments>
  void construct(U* element, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0) {
      std::construct_at(element, std::forward<Arguments>(arguments)...);
    }
  }
};

/// A vector of many elements that threads fill: resize() leaves new ones uninitialised.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace tracer
