#include "morsel/tools/study/random_stream.h"

#include <cmath>
#include <limits>

namespace morsel::tools {
namespace {

constexpr std::uint64_t kStep = 0x9E37'79B9'7F4A'7C15;  // 2⁶⁴ by the golden ratio

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58'476D'1CE4'E5B9;
  z = (z ^ (z >> 27)) * 0x94D0'49BB'1331'11EB;
  return z ^ (z >> 31);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, RandomUse use, std::initializer_list<std::uint64_t> place)
    : state_(seed) {
  const auto enter = [&](std::uint64_t number) { state_ = mixed(mixed(state_ + kStep) ^ mixed(number)); };
  enter(static_cast<std::uint64_t>(use));
  for (const std::uint64_t number : place) enter(number);
}

std::uint64_t RandomStream::next() { return mixed(state_ += kStep); }

double RandomStream::uniform() { return std::ldexp(static_cast<double>(next() >> 12) + 0.5, -52); }

double RandomStream::normal() {
  constexpr double kWidth = 1.7155277699214135;  // √(8/e)
  for (;;) {
    const double u = uniform();
    const double x = kWidth * (uniform() - 0.5) / u;
    if (x * x <= -4 * std::log(u)) return x;
  }
}

std::uint64_t RandomStream::below(std::uint64_t count) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t limit = kMost - kMost % count;  // a multiple of count, so that no remainder is favoured
  for (;;) {
    const std::uint64_t number = next();
    if (number < limit) return number % count;
  }
}

}  // namespace morsel::tools
