#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "morsel/tools/plot/ticks.h"

using namespace morsel::tools::plot;

namespace {

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> result;
  for (const Tick& tick : ticks.major) result.push_back(tick.label);
  return result;
}

std::vector<double> values(const Ticks& ticks) {
  std::vector<double> result;
  for (const Tick& tick : ticks.major) result.push_back(tick.value);
  return result;
}

using Labels = std::vector<std::string>;
using Values = std::vector<double>;

const Axis kLinear{};
const Axis kLog{.scale = Scale::log};

}  // namespace

TEST_CASE("linear ticks are round numbers, exactly") {
  Ticks ticks = make_ticks({0, 1}, kLinear, 5);
  CHECK(values(ticks) == Values{0, 0.2, 0.4, 0.6, 0.8, 1});  // not 0.6000000000000001
  CHECK(labels(ticks) == Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(ticks.minor.empty());
  CHECK((ticks.factor == 0 && ticks.offset == 0 && ticks.offset_text.empty()));

  ticks = make_ticks({-344, 270}, kLinear, 7);
  CHECK(values(ticks) == Values{-300, -200, -100, 0, 100, 200});
  CHECK(labels(ticks) == Labels{"\u2212300", "\u2212200", "\u2212100", "0", "100", "200"});

  CHECK(values(make_ticks({0.05, 0.3}, kLinear, 3)) == Values{0.1, 0.2, 0.3});
  CHECK(labels(make_ticks({0, 40'000}, kLinear, 4)) == Labels{"0", "10,000", "20,000", "30,000", "40,000"});
}

TEST_CASE("very large and very small numbers share a factor") {
  Ticks ticks = make_ticks({0, 3e6}, kLinear, 3);
  CHECK(labels(ticks) == Labels{"0", "1", "2", "3"});
  CHECK(ticks.factor == 6);
  CHECK(values(ticks) == Values{0, 1e6, 2e6, 3e6});

  ticks = make_ticks({0, 4e-7}, kLinear, 4);
  CHECK(labels(ticks) == Labels{"0", "1", "2", "3", "4"});
  CHECK(ticks.factor == -7);

  ticks = make_ticks({0, 1.5e-300}, kLinear, 3);
  CHECK(labels(ticks) == Labels{"0.0", "0.5", "1.0", "1.5"});
  CHECK(ticks.factor == -300);
  CHECK(make_ticks({-1e300, 1e300}, kLinear, 4).factor == 300);
}

TEST_CASE("the common part of all numbers is an offset") {
  Ticks ticks = make_ticks({1e9, 1e9 + 9.5e-4}, kLinear, 5);
  CHECK(ticks.offset == 1e9);
  CHECK(ticks.offset_text == "1,000,000,000");
  CHECK(labels(ticks) == Labels{"0", "2", "4", "6", "8"});
  CHECK(ticks.factor == -4);
  CHECK(values(ticks) ==
        Values{1e9, 1'000'000'000.0002, 1'000'000'000.0004, 1'000'000'000.0006, 1'000'000'000.0008});

  ticks = make_ticks({-123456.0004, -123456}, kLinear, 4);
  CHECK(ticks.offset < 0);
  for (const Tick& tick : ticks.major) CHECK(tick.label.size() < 14);

  CHECK(make_ticks({100, 110}, kLinear, 5).offset == 0);
  CHECK(labels(make_ticks({1000, 1010}, kLinear, 5)) ==
        Labels{"1,000", "1,002", "1,004", "1,006", "1,008", "1,010"});
}

TEST_CASE("logarithmic ticks are powers of ten") {
  Ticks ticks = make_ticks({1e-3, 1e5}, kLog, 10);
  CHECK(values(ticks) == Values{1e-3, 1e-2, 1e-1, 1, 10, 100, 1e3, 1e4, 1e5});
  CHECK(labels(ticks) == Labels{"10\u207b\u00b3", "10\u207b\u00b2", "10\u207b\u00b9", "10\u2070", "10\u00b9",
                                "10\u00b2", "10\u00b3", "10\u2074", "10\u2075"});
  CHECK(ticks.minor.size() == 8 * 8);
  CHECK(ticks.minor.front() == 2e-3);
  CHECK(ticks.minor.back() == 9e4);

  ticks = make_ticks({1e-3, 1e5}, kLog, 4);  // every second one is enough
  CHECK(values(ticks) == Values{1e-2, 1, 100, 1e4});
  CHECK(ticks.minor == Values{1e-3, 1e-1, 10, 1e3, 1e5});

  CHECK(labels(make_ticks({0.8, 1500}, kLog, 6)) == Labels{"1", "10", "100", "1,000"});
  CHECK(make_ticks({1e-250, 1e250}, kLog, 6).major.size() <= 7);
}

TEST_CASE("within few decades a logarithmic axis has 1, 2 and 5, or as a linear one") {
  Ticks ticks = make_ticks({80, 2600}, kLog, 6);
  CHECK(values(ticks) == Values{100, 200, 500, 1000, 2000});
  CHECK(labels(ticks) == Labels{"100", "200", "500", "1,000", "2,000"});
  CHECK(labels(make_ticks({8e7, 6e8}, kLog, 6)) == Labels{"10\u2078", "2\u00b710\u2078", "5\u00b710\u2078"});
  CHECK(values(make_ticks({31, 39}, kLog, 4)) == Values{32, 34, 36, 38});
  CHECK(values(make_ticks({8, 600}, kLog, 4)) == Values{10, 100});
}

TEST_CASE("symmetric ticks are powers of both signs and 0") {
  const Axis axis{.scale = Scale::symmetric, .linear = 1};
  Ticks ticks = make_ticks({-150, 150}, axis, 10);
  CHECK(values(ticks) == Values{-100, -10, -1, 0, 1, 10, 100});
  CHECK(labels(ticks) == Labels{"\u2212100", "\u221210", "\u22121", "0", "1", "10", "100"});
  CHECK(ticks.minor.size() == 2 * 16);
  CHECK(std::is_sorted(ticks.minor.begin(), ticks.minor.end()));

  CHECK(values(make_ticks({-150, 150}, axis, 4)) == Values{-100, -10, 0, 10, 100});
  CHECK(values(make_ticks({-150, 150}, axis, 2)) == Values{-100, 0, 100});
  CHECK(values(make_ticks({-0.5, 150}, axis, 10)) == Values{0, 1, 10, 100});
  CHECK(values(make_ticks({31, 39}, axis, 4)) == Values{32, 34, 36, 38});
  CHECK(values(make_ticks({-0.5, 0.5}, axis, 2)) == Values{-0.5, 0, 0.5});
  const Axis small{.scale = Scale::symmetric, .linear = 1e-6};
  CHECK(labels(make_ticks({-1e-4, 0}, small, 3)) ==
        Labels{"\u221210\u207b\u2074", "\u221210\u207b\u2075", "\u221210\u207b\u2076", "0"});
  CHECK(values(make_ticks({-1e-4, 0}, small, 2)) == Values{-1e-4, -1e-5, 0});
}

TEST_CASE("an axis has a margin, and a length even for a constant") {
  CHECK(padded({0, 100}, kLinear) == Interval{-4, 104});
  CHECK(padded({5, 5}, kLinear) == Interval{2.5, 7.5});
  CHECK(padded({-5, -5}, kLinear) == Interval{-7.5, -2.5});
  CHECK(padded({0, 0}, kLinear) == Interval{-1, 1});
  CHECK(padded({1e9, std::nextafter(1e9, 2e9)}, kLinear).size() == Approx(1e9));
  CHECK(padded({3, 3}, kLog) == Interval{1.5, 6});
  const Interval log = padded({1, 1e100}, kLog);
  CHECK(log.lower == Approx(1e-4));
  CHECK(log.upper == Approx(1e104));
  const Axis axis{.scale = Scale::symmetric, .linear = 1};
  const Interval symmetric = padded({-100, 100}, axis);
  CHECK(symmetric.lower == Approx(-symmetric.upper));
  CHECK(symmetric.upper > 120);
}

TEST_CASE("on any interval ticks ascend, lie within it and are neither too many nor too few") {
  std::mt19937_64 random(3);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int trial = 0; trial < 20'000; ++trial) {
    const double size = std::pow(10, 40 * uniform() - 20);
    const Scale scale = trial % 3 == 0 ? Scale::linear : trial % 3 == 1 ? Scale::log : Scale::symmetric;
    const Axis axis{.scale = scale, .linear = std::pow(10, std::floor(10 * uniform() - 5))};
    const double a = scale == Scale::log ? size : (uniform() - 0.5) * size * std::pow(10, 9 * uniform());
    const Interval shown =
        scale == Scale::log ? Interval{a, a * std::pow(10, 12 * uniform() + 0.01)} : Interval{a, a + size};
    const int count = 2 + static_cast<int>(random() % 9);
    const Ticks ticks = make_ticks(shown, axis, count);
    INFO(shown.lower << " to " << shown.upper << ", scale " << static_cast<int>(scale) << ", " << count);
    CHECK_FALSE(ticks.major.empty());
    if (scale == Scale::linear) CHECK(ticks.major.size() >= static_cast<std::size_t>(count) / 3);
    CHECK(ticks.major.size() <= static_cast<std::size_t>(std::max(count + 1, 5)));
    for (std::size_t i = 0; i < ticks.major.size(); ++i) {
      CHECK(along(ticks.major[i].value, axis) >=
            along(shown.lower, axis) - 1e-5 * (along(shown.upper, axis) - along(shown.lower, axis)));
      CHECK(along(ticks.major[i].value, axis) <=
            along(shown.upper, axis) + 1e-5 * (along(shown.upper, axis) - along(shown.lower, axis)));
      if (i > 0) {
        CHECK(ticks.major[i].value > ticks.major[i - 1].value);
        CHECK(ticks.major[i].label != ticks.major[i - 1].label);
      }
      CHECK(ticks.major[i].label.size() < 20);
    }
  }
}
