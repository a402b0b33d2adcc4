// Colours of an annotation; tests/cli/test_brains.py has nibabel read the files.

#include "morsel/tools/export/brain_files.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <vector>

using namespace morsel;
using Rgb = std::array<std::uint8_t, 3>;

TEST_CASE("colours that differ stay, equal ones differ a little, and none is black") {
  CHECK(tools::distinct_colors(std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}}) ==
        std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}});
  CHECK(tools::distinct_colors({}).empty());
  CHECK(tools::distinct_colors(std::vector<Rgb>{{8, 8, 8}, {8, 8, 8}, {8, 8, 8}, {9, 8, 8}}) ==
        std::vector<Rgb>{{8, 8, 8}, {9, 8, 8}, {8, 9, 8}, {9, 9, 8}});
  CHECK(tools::distinct_colors(std::vector<Rgb>{{0, 0, 0}}) == std::vector<Rgb>{{1, 0, 0}});

  const std::vector<Rgb> nine = {{0x77, 0xaa, 0xdd}, {0xee, 0x88, 0x66}, {0, 0, 0}};
  std::vector<Rgb> many;
  for (int i = 0; i < 1500; ++i) many.push_back(nine[i % nine.size()]);
  const std::vector<Rgb> distinct = tools::distinct_colors(many);
  CHECK(std::set<Rgb>(distinct.begin(), distinct.end()).size() == many.size());
  CHECK(std::ranges::find(distinct, Rgb{0, 0, 0}) == distinct.end());
  int farthest = 0;
  for (std::size_t i = 0; i < many.size(); ++i)
    for (int c = 0; c < 3; ++c) farthest = std::max(farthest, std::abs(distinct[i][c] - many[i][c]));
  CHECK(farthest <= 7);  // 512 of each: three bits of each channel
}
