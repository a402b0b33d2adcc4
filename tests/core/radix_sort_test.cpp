#include "morsel/core/parallel/radix_sort.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

using namespace morsel;

TEST_CASE("sorting by whole numbers keeps the order of equal ones") {
  std::mt19937_64 random(3);
  for (const std::size_t count : {0U, 1U, 200U, 5000U, 150000U})
    for (const unsigned bits : {4U, 21U, 64U}) {
      std::vector<std::pair<std::uint64_t, std::size_t>> items(count);
      for (std::size_t i = 0; i < count; ++i) items[i] = {random() >> (64 - bits), i};
      auto expected = items;
      std::sort(expected.begin(), expected.end());
      core::radix_sort(items, bits, [](const auto& item) { return item.first; });
      CHECK(items == expected);
    }
}
