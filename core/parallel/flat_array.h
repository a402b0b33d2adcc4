#pragma once
/// Long arrays that are not initialised, in large pages where the system has them.

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace morsel::core {

namespace detail {
/// Memory for an array of a few MiB or more, in large pages if the system gives them (Linux: madvise). Throws
/// std::bad_alloc.
void* allocate_large(std::size_t bytes);
void deallocate_large(void* memory) noexcept;
inline constexpr std::size_t kLarge = std::size_t{1} << 22;
}  // namespace detail

/// An allocator whose elements are left uninitialised by resize() and by vectors of a given size, so that
/// they are first touched by the thread that writes them. Arrays that are read out of order gain from large
/// pages most.
template <class T>
struct FlatAllocator {
  static_assert(std::is_trivially_destructible_v<T>);
  using value_type = T;
  FlatAllocator() = default;
  template <class U>
  explicit FlatAllocator(const FlatAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    if (count >= detail::kLarge / sizeof(T)) {
      if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
      return static_cast<T*>(detail::allocate_large(count * sizeof(T)));
    }
    return std::allocator<T>().allocate(count);
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (count >= detail::kLarge / sizeof(T)) {
      detail::deallocate_large(memory);
    } else {
      std::allocator<T>().deallocate(memory, count);
    }
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0) {
      ::new (static_cast<void*>(place)) U;
    } else {
      ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
  }
  friend bool operator==(const FlatAllocator&, const FlatAllocator&) { return true; }
};

/// A vector of plain values. FlatArray<T>(n) and resize(n) do not initialise: write every element before it
/// is read.
template <class T>
using FlatArray = std::vector<T, FlatAllocator<T>>;

}  // namespace morsel::core
