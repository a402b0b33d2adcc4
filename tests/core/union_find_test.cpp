#include "morsel/core/parallel/union_find.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace morsel::core;

TEST_CASE("sets agree with brute force and their smallest element is the root") {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const Index n = 1 + static_cast<Index>(random() % 60);
    UnionFind sets(n);
    std::vector<Index> label(n);
    std::iota(label.begin(), label.end(), Index{0});
    for (unsigned unions = random() % 80; unions > 0; --unions) {
      const Index a = static_cast<Index>(random() % n), b = static_cast<Index>(random() % n);
      const Index low = std::min(label[a], label[b]), high = std::max(label[a], label[b]);
      CHECK(sets.unite(a, b) == (low != high));
      std::replace(label.begin(), label.end(), high, low);
    }
    for (Index i = 0; i < n; ++i) CHECK(sets.find(i) == label[i]);
  }
}

TEST_CASE("parities are those of a colouring and a contradiction is detected") {
  std::mt19937 random(4);
  for (int round = 0; round < 100; ++round) {
    const Index n = 2 + static_cast<Index>(random() % 40);
    std::vector<bool> color(n);
    for (Index i = 0; i < n; ++i) color[i] = random() % 2 == 1;
    ParityUnionFind sets(n);
    UnionFind plain(n);
    for (unsigned unions = random() % 100; unions > 0; --unions) {
      const Index a = static_cast<Index>(random() % n), b = static_cast<Index>(random() % n);
      CHECK(sets.unite(a, b, color[a] != color[b]));
      plain.unite(a, b);
    }
    for (Index a = 0; a < n; ++a) {
      CHECK(sets.find(a).first == plain.find(a));
      for (Index b = 0; b < n; ++b) {
        if (plain.find(a) != plain.find(b)) continue;
        CHECK((sets.find(a).second != sets.find(b).second) == (color[a] != color[b]));
        CHECK_FALSE(sets.unite(a, b, color[a] == color[b]));
      }
    }
  }
}

TEST_CASE("an odd cycle cannot be coloured and an even one can") {
  for (const Index n : {3u, 4u, 7u, 10u}) {
    ParityUnionFind sets(n);
    for (Index i = 0; i + 1 < n; ++i) CHECK(sets.unite(i, i + 1, true));
    CHECK(sets.unite(n - 1, 0, true) == (n % 2 == 0));
  }
}

TEST_CASE("sets united by many threads at a time are those that one thread makes") {
  std::mt19937 random(5);
  const ThreadLimit limit(4);
  for (const Index n : {Index{1}, Index{10}, Index{3000}, Index{50000}}) {
    std::vector<std::pair<Index, Index>> unions(n);
    for (auto& [a, b] : unions) {
      a = static_cast<Index>(random() % n);
      b = static_cast<Index>(random() % n);
    }
    UnionFind expected(n);
    for (const auto& [a, b] : unions) expected.unite(a, b);
    ConcurrentUnionFind sets(n);
    parallel_for(0, unions.size(), 100, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) sets.unite(unions[i].first, unions[i].second);
    });
    for (Index i = 0; i < n; ++i) REQUIRE(sets.find(i) == expected.find(i));
  }
}
