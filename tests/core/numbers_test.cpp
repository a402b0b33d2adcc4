#include "morsel/core/text/numbers.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

using namespace morsel::core;

TEST_CASE("numbers are written in few forms") {
  CHECK(shortest(0.1) == "0.1");
  CHECK(shortest(-0.0) == "-0");
  CHECK(shortest(1e300) == "1e+300");
  CHECK(shortest(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(shortest(-std::numeric_limits<double>::infinity()) == "-inf");
  CHECK(NumberText(std::numeric_limits<std::uint64_t>::max()).view() == "18446744073709551615");
  CHECK(NumberText(-std::numeric_limits<double>::denorm_min()).view() == "-5e-324");
  CHECK(to_digits(1234567) == "1.23457e+06");
  CHECK(to_digits(0.1 + 0.2, 12) == "0.3");
  CHECK(to_digits(-2) == "-2");
  CHECK(to_decimals(0.5, 2) == "0.50");
  CHECK(to_decimals(2.5, 0) == "2");
  CHECK(to_decimals(-0.001, 2) == "-0.00");
  CHECK(to_decimals(std::numeric_limits<double>::max(), 3).size() == 313);
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(1234567890) == "1,234,567,890");
  CHECK(grouped_digits("100000000000000000000000") == "100,000,000,000,000,000,000,000");
}

TEST_CASE("rounded numbers are those of printf") {
  std::mt19937_64 random(3);
  std::vector<double> values = {0, -0.0, 0.125, 0.375, 1e15, 999999.5, 0.000099995, HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i < 2000; ++i)
    values.push_back(
        std::ldexp(static_cast<double>(random()) - 9.2e18, static_cast<int>(random() % 200) - 160));
  for (const double value : values)
    for (const int precision : {0, 1, 2, 3, 6, 12}) {
      char text[128];
      std::snprintf(text, sizeof text, "%.*f", precision, value);
      CHECK(to_decimals(value, precision) == text);
      std::snprintf(text, sizeof text, "%.*g", precision, value);
      CHECK(to_digits(value, precision) == text);
    }
}
