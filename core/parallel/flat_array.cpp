#include "morsel/core/parallel/flat_array.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace morsel::core::detail {

void* allocate_large(std::size_t bytes) {
  constexpr std::size_t kPage = std::size_t{1} << 21;
  const std::size_t rounded = (bytes + kPage - 1) / kPage * kPage;
  void* const memory = std::aligned_alloc(kPage, rounded);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // The part of the last page that is not needed stays in small pages, which are not made unless they are
  // touched.
  madvise(memory, bytes / kPage * kPage,
          MADV_HUGEPAGE);  // a hint: without it only speed is lost
#endif
  return memory;
}

void deallocate_large(void* memory) noexcept { std::free(memory); }

}  // namespace morsel::core::detail
