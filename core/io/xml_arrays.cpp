#include "morsel/core/io/xml_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr std::size_t kPause = 1 << 16;  // numbers between two looks at whether to stop

template <class T>
std::vector<double> converted(std::string_view bytes, bool swap, std::uint64_t count,
                              const Progress& progress) {
  std::vector<double> values(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % kPause == 0) progress.throw_if_cancelled();
    std::array<char, sizeof(T)> one;
    std::memcpy(one.data(), bytes.data() + i * sizeof(T), sizeof(T));
    if (swap) std::reverse(one.begin(), one.end());
    values[i] = static_cast<double>(std::bit_cast<T>(one));
  }
  return values;
}

bool is_float(NumberType type) { return type == NumberType::float32 || type == NumberType::float64; }

/// The range of a type of whole numbers.
std::pair<double, double> range_of(NumberType type) {
  const auto bits = static_cast<int>(8 * size_of(type));
  const bool is_signed = type == NumberType::int8 || type == NumberType::int16 || type == NumberType::int32 ||
                         type == NumberType::int64;
  return is_signed ? std::pair(-std::ldexp(1, bits - 1), std::ldexp(1, bits - 1) - 1)
                   : std::pair(0.0, std::ldexp(1, bits) - 1);
}

/// A word as a number of the type; false if it is none.
bool parse_number(std::string_view word, NumberType type, double& value) {
  const char* begin = word.data();
  const char* end = word.data() + word.size();
  std::from_chars_result result{};
  if (type == NumberType::float32) {
    float single = 0;
    result = read_number(begin, end, single);
    value = single;
  } else {
    result = read_number(begin, end, value);
  }
  if (result.ec != std::errc() || result.ptr != end) return false;
  if (is_float(type)) return true;
  const auto [low, high] = range_of(type);
  return value >= low && value <= high && value == std::trunc(value);
}

}  // namespace

std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::int8:
    case NumberType::uint8:
      return 1;
    case NumberType::int16:
    case NumberType::uint16:
      return 2;
    case NumberType::int32:
    case NumberType::uint32:
    case NumberType::float32:
      return 4;
    default:
      return 8;
  }
}

std::vector<double> text_numbers(std::string_view text, NumberType type, std::uint64_t count,
                                 const std::string& what, const Progress& progress) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  if (count > text.size() / 2 + 1)
    throw BadInput(what + "it announces " + std::to_string(count) + " numbers, but its text is too short");
  std::vector<double> values;
  values.reserve(count);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) break;
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    if (values.size() == count)
      throw BadInput(what + "it has more numbers than the " + std::to_string(count) + " announced");
    double value = 0;
    if (!parse_number(word, type, value))
      throw BadInput(what + "number " + std::to_string(values.size()) + ", " + shown(word) +
                     ", is none of its type");
    values.push_back(value);
    if (values.size() % kPause == 0) progress.throw_if_cancelled();
  }
  if (values.size() < count)
    throw BadInput(what + "it has " + std::to_string(values.size()) + " of the " + std::to_string(count) +
                   " numbers announced");
  return values;
}

std::vector<double> binary_numbers(std::string_view bytes, NumberType type, std::endian order,
                                   std::uint64_t count, const Progress& progress) {
  const bool swap = order != std::endian::native;
  switch (type) {
    case NumberType::int8:
      return converted<std::int8_t>(bytes, swap, count, progress);
    case NumberType::uint8:
      return converted<std::uint8_t>(bytes, swap, count, progress);
    case NumberType::int16:
      return converted<std::int16_t>(bytes, swap, count, progress);
    case NumberType::uint16:
      return converted<std::uint16_t>(bytes, swap, count, progress);
    case NumberType::int32:
      return converted<std::int32_t>(bytes, swap, count, progress);
    case NumberType::uint32:
      return converted<std::uint32_t>(bytes, swap, count, progress);
    case NumberType::int64:
      return converted<std::int64_t>(bytes, swap, count, progress);
    case NumberType::uint64:
      return converted<std::uint64_t>(bytes, swap, count, progress);
    case NumberType::float32:
      return converted<float>(bytes, swap, count, progress);
    default:
      return converted<double>(bytes, swap, count, progress);
  }
}

std::string inflated(std::string_view bytes, std::uint64_t size, const std::string& what,
                     const Progress& progress) {
  struct Stream : z_stream {
    Stream() : z_stream{} {
      if (inflateInit2(this, MAX_WBITS + 32) != Z_OK) throw std::bad_alloc();  // zlib's format or gzip's
    }
    ~Stream() { inflateEnd(this); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
  } stream;
  // Deflate's ratio is 1032 at most.
  if (size / 1040 > bytes.size())
    throw BadInput(what + "its " + std::to_string(bytes.size()) + " compressed bytes cannot become " +
                   std::to_string(size));
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  std::string out;
  int status = Z_OK;
  while (status == Z_OK) {
    progress.throw_if_cancelled();
    const std::size_t before = out.size();
    // One byte more than there should be shows what is too long.
    const auto room = static_cast<std::size_t>(std::min(kPiece, size - before + 1));
    out.resize(before + room);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    stream.avail_out = static_cast<uInt>(room);
    if (stream.avail_in == 0) {
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), 1 << 30));
      bytes.remove_prefix(stream.avail_in);
    }
    status = ::inflate(&stream, Z_NO_FLUSH);
    out.resize(before + room - stream.avail_out);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (out.size() > size)
      throw BadInput(what + "it has more than the " + std::to_string(size) + " bytes that its sizes need");
    if (status == Z_BUF_ERROR && !bytes.empty()) status = Z_OK;
  }
  if (status != Z_STREAM_END) throw BadInput(what + "its compressed data are damaged or cut off");
  if (out.size() != size)
    throw BadInput(what + "it has " + std::to_string(out.size()) + " bytes, but its sizes need " +
                   std::to_string(size));
  return out;
}

}  // namespace morsel::core
