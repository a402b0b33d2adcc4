#pragma once
/// The one wrapper around threads (oneTBB). Everything here gives the same bits for every number of threads:
/// chunks depend on sizes alone, reductions combine them in order.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace morsel::core {

/// Number of threads that parallel loops may use now.
int thread_count();

/// Limits (or raises) the number of threads while it lives; nested limits take the smallest. Needs `threads`
/// ≥ 1, throws InvalidArgument otherwise. More threads than processors are allowed and used.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Elements of a chunk by default: small enough to balance the load, large enough to
/// outweigh the overhead.
inline constexpr std::size_t kGrain = 2048;

namespace detail {
/// Runs chunk(k) for k = 0 … chunks − 1, in parallel when there is more than one. Exceptions reach the
/// caller.
void run_chunks(std::size_t chunks, const std::function<void(std::size_t)>& chunk);
/// Runs work() where oneTBB's algorithms use thread_count() threads.
void run_in_arena(const std::function<void()>& work);
}  // namespace detail

/// Calls body(first, last) on consecutive chunks of [begin, end) of `grain` elements each, in parallel.
/// Bodies must write to disjoint places.
template <class Body>
void parallel_for(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
  if (begin >= end) return;
  const std::size_t size = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (end - begin + size - 1) / size;
  if (chunks == 1) {
    body(begin, end);
    return;
  }
  detail::run_chunks(chunks, [&](std::size_t k) {
    const std::size_t first = begin + k * size;
    body(first, std::min(end, first + size));
  });
}

/// parallel_for over single elements: body(i), with the default grain.
template <class Body>
void parallel_for_each(std::size_t count, const Body& body) {
  parallel_for(0, count, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

/// map(first, last) → T on consecutive chunks in parallel, folded from left to right with combine(T, T) → T
/// starting from `identity`. The chunks, and so the roundings, depend on `grain` and the range alone.
template <class T, class Map, class Combine>
T parallel_reduce(std::size_t begin, std::size_t end, std::size_t grain, T identity, const Map& map,
                  const Combine& combine) {
  if (begin >= end) return identity;
  const std::size_t size = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (end - begin + size - 1) / size;
  struct Slot {  // avoids vector<bool>, whose elements share bytes
    T value;
  };
  std::vector<Slot> partial(chunks, Slot{identity});
  parallel_for(0, chunks, 1, [&](std::size_t k, std::size_t) {
    const std::size_t first = begin + k * size;
    partial[k].value = map(first, std::min(end, first + size));
  });
  T result = std::move(identity);
  for (Slot& slot : partial) result = combine(std::move(result), std::move(slot.value));
  return result;
}

}  // namespace morsel::core
