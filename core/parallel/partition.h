#pragma once
/// Distributing elements into buckets with all threads: the step that counting and radix sorts are made of.

#include <cstddef>
#include <vector>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::core {

/// Elements by bucket: those of bucket b are items[offset[b]] … items[offset[b + 1] − 1].
template <class T>
struct Partition {
  FlatArray<T> items;
  std::vector<std::size_t> offset;
};

/// Distributes the elements that `visit` emits for 0 … count − 1 into `buckets` buckets, keeping their order
/// within each. visit(first, last, emit) calls emit(bucket, element) for consecutive inputs; it runs twice on
/// each chunk and must emit the same both times. O(count + buckets · count / grain) time, and memory for the
/// counts of all chunks; parallel, the same result for every number of threads.
template <class T, class Visit>
Partition<T> partition(std::size_t count, std::size_t buckets, std::size_t grain, const Visit& visit) {
  const std::size_t chunks = (count + grain - 1) / grain;
  std::vector<std::size_t> places(chunks *
                                  buckets);  // first counts, then where the chunk's next element goes
  parallel_for(0, count, grain, [&](std::size_t first, std::size_t last) {
    std::size_t* const counts = &places[first / grain * buckets];
    visit(first, last, [&](std::size_t bucket, const T&) { ++counts[bucket]; });
  });
  Partition<T> result;
  result.offset.resize(buckets + 1);
  std::size_t sum = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    result.offset[b] = sum;
    for (std::size_t c = 0; c < chunks; ++c) {
      const std::size_t here = places[c * buckets + b];
      places[c * buckets + b] = sum;
      sum += here;
    }
  }
  result.offset[buckets] = sum;
  result.items.resize(sum);
  T* const items = result.items.data();
  parallel_for(0, count, grain, [&](std::size_t first, std::size_t last) {
    std::size_t* const place = &places[first / grain * buckets];
    visit(first, last, [&](std::size_t bucket, const T& element) { items[place[bucket]++] = element; });
  });
  return result;
}

}  // namespace morsel::core
