#include "morsel/core/io/number_type.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>
#include <type_traits>
#include <utility>

#include "morsel/core/text/numbers.h"

namespace morsel::core {
namespace {

constexpr std::size_t kNumbersBetweenPauses = 1 << 16;  // between two checks for cancellation

/// Calls `use` with a value of the C++ type.
template <class Use>
void with_type(NumberType type, const Use& use) {
  switch (type) {
    case NumberType::int8:
      return use(std::int8_t{});
    case NumberType::uint8:
      return use(std::uint8_t{});
    case NumberType::int16:
      return use(std::int16_t{});
    case NumberType::uint16:
      return use(std::uint16_t{});
    case NumberType::int32:
      return use(std::int32_t{});
    case NumberType::uint32:
      return use(std::uint32_t{});
    case NumberType::int64:
      return use(std::int64_t{});
    case NumberType::uint64:
      return use(std::uint64_t{});
    case NumberType::float32:
      return use(float{});
    case NumberType::float64:
      return use(double{});
  }
}

template <class T>
T load_number(const char* at, bool swap) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

template <class Out, class Convert>
std::vector<Out> decode(std::string_view bytes, NumberType type, bool swap, const Progress& progress,
                        const Convert& convert) {
  std::vector<Out> result(bytes.size() / size_of(type));
  with_type(type, [&]<class T>(T) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (i % kNumbersBetweenPauses == 0) progress.throw_if_cancelled();
      result[i] = convert(load_number<T>(bytes.data() + i * sizeof(T), swap));
    }
  });
  return result;
}

/// "3.0" and "1e3"; false if it is no whole number of the type.
template <class T>
bool parse_fraction(std::string_view word, double& value) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = read_number(word.data(), end, value);
  // The limit is a power of two, which the largest number itself need not be as a double.
  const double limit = std::ldexp(1.0, std::numeric_limits<T>::digits);
  return error == std::errc() && stop == end && value == std::trunc(value) && value < limit &&
         value >= (std::is_signed_v<T> ? -limit : 0.0);
}

}  // namespace

std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::vector<double> decoded(std::string_view bytes, NumberType type, bool swap, const Progress& progress) {
  return decode<double>(bytes, type, swap, progress, [](auto value) { return static_cast<double>(value); });
}

std::vector<std::int64_t> decoded_whole(std::string_view bytes, NumberType type, bool swap,
                                        const Progress& progress) {
  return decode<std::int64_t>(bytes, type, swap, progress, [](auto value) -> std::int64_t {
    if constexpr (std::is_same_v<decltype(value), std::uint64_t>)
      return value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())
                 ? -1
                 : static_cast<std::int64_t>(value);
    else if constexpr (std::is_floating_point_v<decltype(value)>)
      return -1;
    else
      return value;
  });
}

bool parse_number(std::string_view word, NumberType type, double& value) {
  bool good = false;
  with_type(type, [&]<class T>(T number) {
    const char* begin = word.data();
    const char* end = begin + word.size();
    std::from_chars_result result{};
    if constexpr (std::is_floating_point_v<T>)
      result = read_number(begin, end, number);
    else
      result =
          std::from_chars(begin + (word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0), end, number);
    good = result.ec == std::errc() && result.ptr == end;
    value = static_cast<double>(number);
    if constexpr (std::is_integral_v<T>)
      if (!good) good = parse_fraction<T>(word, value);
  });
  return good;
}

bool parse_whole(std::string_view word, NumberType type, std::int64_t& value) {
  bool good = false;
  with_type(type, [&]<class T>(T number) {
    if constexpr (std::is_integral_v<T>) {
      const char* end = word.data() + word.size();
      const auto [stop, error] = std::from_chars(word.data(), end, number);
      good = error == std::errc() && stop == end && std::in_range<std::int64_t>(number);
      value = static_cast<std::int64_t>(number);
    }
  });
  return good;
}

}  // namespace morsel::core
