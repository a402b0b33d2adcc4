#include "morsel/core/parallel/parallel.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel_sort.h"

using namespace morsel;
using core::ThreadLimit;

namespace {

std::vector<double> numbers(std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<double> result(count);
  for (double& x : result)
    x = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 80) - 60);
  return result;
}

}  // namespace

TEST_CASE("every element is visited once") {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    for (const std::size_t count : {0u, 1u, 2047u, 2048u, 2049u, 100000u}) {
      std::vector<int> visits(count, 0);
      core::parallel_for_each(count, [&](std::size_t i) { ++visits[i]; });
      CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
    }
    std::atomic<int> sum{0};
    core::parallel_for(10, 25, 4, [&](std::size_t first, std::size_t last) {
      CHECK((first - 10) % 4 == 0);
      CHECK(last - first <= 4);
      sum += static_cast<int>(last - first);
    });
    CHECK(sum == 15);
    core::parallel_for(5, 5, 1, [](std::size_t, std::size_t) { throw std::logic_error("an empty range"); });
    core::parallel_for(6, 5, 0, [](std::size_t, std::size_t) { throw std::logic_error("an empty range"); });
  }
}

TEST_CASE("a reduction has the same bits for any number of threads") {
  const std::vector<double> values = numbers(200000);
  const auto sum = [&] {
    return core::parallel_reduce(
        0, values.size(), 1000, 0.0,
        [&](std::size_t first, std::size_t last) {
          return std::accumulate(&values[first], &values[last - 1] + 1, 0.0);
        },
        [](double a, double b) { return a + b; });
  };
  const ThreadLimit serial(1);
  const double expected = sum();
  for (int round = 0; round < 5; ++round) CHECK(sum() == expected);
}

TEST_CASE("reductions with 1 and 2 and 7 threads agree to the last bit") {
  const std::vector<double> values = numbers(200000);
  std::set<double> results;
  std::set<std::vector<int>> orders;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    for (int round = 0; round < 5; ++round) {
      results.insert(core::parallel_reduce(
          3, values.size(), 777, 0.1,
          [&](std::size_t first, std::size_t last) {
            return std::accumulate(values.begin() + static_cast<long>(first),
                                   values.begin() + static_cast<long>(last), 0.0);
          },
          [](double a, double b) { return a + b; }));
      // Chunks are combined from left to right.
      orders.insert(core::parallel_reduce(
          0, 100, 10, std::vector<int>{},
          [](std::size_t first, std::size_t) { return std::vector<int>{static_cast<int>(first)}; },
          [](std::vector<int> a, std::vector<int> b) {
            a.insert(a.end(), b.begin(), b.end());
            return a;
          }));
    }
  }
  CHECK(results.size() == 1);
  REQUIRE(orders.size() == 1);
  CHECK(std::is_sorted(orders.begin()->begin(), orders.begin()->end()));
  CHECK(core::parallel_reduce(
            0, 0, 5, 42, [](std::size_t, std::size_t) { return 1; }, std::plus<>()) == 42);
}

TEST_CASE("sorting gives the same result for any number of threads") {
  std::vector<double> expected = numbers(100000);
  std::sort(expected.begin(), expected.end());
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    std::vector<double> values = numbers(100000);
    core::parallel_sort(values.begin(), values.end(), std::less<>());
    CHECK(values == expected);
  }
}

TEST_CASE("a raised limit really runs more threads than the machine has processors") {
  const int threads = static_cast<int>(std::thread::hardware_concurrency()) + 3;
  const ThreadLimit limit(threads);
  CHECK(core::thread_count() == threads);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  core::parallel_for(0, 50, 1, [&](std::size_t, std::size_t) {
    for (bool enough = false; !enough && std::chrono::steady_clock::now() < deadline;) {
      {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
        enough = seen.size() > std::thread::hardware_concurrency();
      }
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  });
  CHECK(seen.size() > std::thread::hardware_concurrency());
}

TEST_CASE("exceptions reach the caller whatever the number of threads") {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    CHECK_THROWS_AS(core::parallel_for_each(100000,
                                            [](std::size_t i) {
                                              if (i == 77777) throw core::Cancelled();
                                            }),
                    core::Cancelled);
    // The next loop runs normally.
    std::atomic<std::size_t> count{0};
    core::parallel_for_each(100000, [&](std::size_t) { ++count; });
    CHECK(count == 100000);
  }
}

TEST_CASE("loops may be nested") {
  const ThreadLimit limit(4);
  std::vector<std::size_t> sums(50, 0);
  core::parallel_for(0, sums.size(), 1, [&](std::size_t k, std::size_t) {
    sums[k] = core::parallel_reduce(
        0, 10000, 100, std::size_t{0}, [](std::size_t first, std::size_t last) { return last - first; },
        std::plus<>());
  });
  CHECK(std::all_of(sums.begin(), sums.end(), [](std::size_t s) { return s == 10000; }));
}

TEST_CASE("a thread limit must be positive and ends with its scope") {
  CHECK_THROWS_AS(ThreadLimit(0), core::InvalidArgument);
  CHECK_THROWS_AS(ThreadLimit(-3), core::InvalidArgument);
  const int before = core::thread_count();
  {
    const ThreadLimit outer(3);
    CHECK(core::thread_count() == 3);
    {
      const ThreadLimit inner(2);
      CHECK(core::thread_count() == 2);
      const ThreadLimit larger(5);
      CHECK(core::thread_count() == 2);
    }
    CHECK(core::thread_count() == 3);
  }
  CHECK(core::thread_count() == before);
}
