#pragma once
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace dmp {

/// Allocator of whole cache lines: a record of 8 doubles then never straddles two of them. New elements are left as they are: the thread
/// that writes them first also places them in its memory.
template <class T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  CacheAligned() = default;
  template <class U>
  constexpr CacheAligned(const CacheAligned<U>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  template <class U>
  void construct(U* element) noexcept {
    ::new (static_cast<void*>(element)) U;
  }
  template <class U, class First, class... Rest>
  void construct(U* element, First&& first, Rest&&... rest) {
    ::new (static_cast<void*>(element)) U(std::forward<First>(first), std::forward<Rest>(rest)...);
  }
  void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, alignment); }
  friend constexpr bool operator==(CacheAligned, CacheAligned) noexcept { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheAligned<T>>;

/// resize for what varies a little from time to time, such as what depends on the number of ghosts: with a margin of 1/32 where `resize`
/// would take twice the memory.
template <class Vector>
void resize_with_margin(Vector& values, std::size_t count) {
  if (values.capacity() < count) values.reserve(count + count / 32);
  values.resize(count);
}

}  // namespace dmp
