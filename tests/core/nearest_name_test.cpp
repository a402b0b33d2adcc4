#include "morsel/core/text/nearest_name.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <vector>

using namespace morsel::core;

TEST_CASE("the nearest name is the one with the fewest letters changed, if it is near enough") {
  const std::vector<std::string> names = {"compare", "check", "cut", "field", "salient", "saliency"};
  CHECK(nearest_name("comapre", names) == "compare");
  CHECK(nearest_name("compar", names) == "compare");
  CHECK(nearest_name("ceck", names) == "check");
  CHECK(nearest_name("cat", names) == "cut");
  CHECK(nearest_name("saliencx", names) == "saliency");
  CHECK(nearest_name("saliett", names) == "salient");
  CHECK(nearest_name("nonsense", names).empty());
  CHECK(nearest_name("", names).empty());
  CHECK(nearest_name("x", names).empty());
  CHECK(nearest_name(std::string(1000, 'c'), names).empty());
  CHECK(nearest_name("cut", {}).empty());
  CHECK(nearest_hint("feild", names) == "; did you mean field?");
  CHECK(nearest_hint("nonsense", names).empty());
  const std::vector<std::string> two = {"axis", "direction"};
  CHECK(nearest_of("axs", two, "it takes") == "; did you mean axis? It takes: axis, direction");
  CHECK(nearest_of("q", two, "it takes") == "; it takes: axis, direction");
  CHECK(must_be_one_of(two, "axs") == "must be axis or direction, not \"axs\"; did you mean axis?");
  CHECK(must_be_one_of(two, "") == "must be axis or direction, not \"\"");
}

TEST_CASE("one letter changed in a long name is always corrected") {
  const std::vector<std::string> names = {"mean-curvature", "gaussian-curvature", "principal-curvature"};
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const std::string& name = names[random() % names.size()];
    std::string word = name;
    const std::size_t at = random() % (word.size() - 1);
    switch (random() % 4) {
      case 0:
        word.erase(at, 1);
        break;
      case 1:
        word.insert(at, 1, 'z');
        break;
      case 2:
        word[at] = 'z';
        break;
      default:
        std::swap(word[at], word[at + 1]);
        break;
    }
    INFO(word);
    CHECK(nearest_name(word, names) == name);
  }
}
