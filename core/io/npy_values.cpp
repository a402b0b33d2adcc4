// NumPy's .npy files.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/value_file.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace npy {
namespace {

/// The dictionary of a header: {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }.
struct Header {
  std::string type;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
};

class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  Header parse() {
    Header header;
    bool type = false;
    bool order = false;
    bool shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr" && !type) {
        type = true;
        if (peek() != '\'' && peek() != '"')
          fail_reading(file_, "its array is one of records: save the one that is wanted by itself");
        header.type = quoted();
      } else if (key == "fortran_order" && !order) {
        order = true;
        header.fortran_order = truth();
      } else if (key == "shape" && !shape) {
        shape = true;
        header.shape = numbers();
      } else {
        fail();
      }
      if (!accept(',') && peek() != '}') fail();
    }
    if (!type || !order || !shape || peek() != 0) fail();
    return header;
  }

 private:
  [[noreturn]] void fail() const { fail_reading(file_, "the header of its NumPy array is damaged"); }

  char peek() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n\t"), rest_.size()));
    return rest_.empty() ? '\0' : rest_.front();
  }
  bool accept(char c) {
    if (rest_.empty() || peek() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail();
  }
  std::string quoted() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail();
    const std::size_t end = rest_.find(quote, 1);
    if (end == std::string_view::npos) fail();
    std::string text(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return text;
  }
  bool truth() {
    peek();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (!rest_.starts_with(word)) continue;
      rest_.remove_prefix(word.size());
      return value;
    }
    fail();
  }
  std::vector<std::uint64_t> numbers() {
    std::vector<std::uint64_t> result;
    expect('(');
    while (!accept(')')) {
      peek();
      std::uint64_t value = 0;
      const auto [stop, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
      if (error != std::errc()) fail();
      rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
      if (rest_.starts_with('L')) rest_.remove_prefix(1);  // of Python 2
      result.push_back(value);
      if (!accept(',') && peek() != ')') fail();
    }
    return result;
  }

  std::string_view rest_;
  const std::string& file_;
};

/// IEEE half precision, exactly.
double half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const int fraction = bits & 1023;
  const double size = exponent == 31  ? (fraction == 0 ? std::numeric_limits<double>::infinity()
                                                       : std::numeric_limits<double>::quiet_NaN())
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(fraction + 1024, exponent - 25);
  return bits >> 15 != 0 ? -size : size;
}

template <class T>
T load(const char* at, bool swap) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

using Load = double (*)(const char* at, bool swap);

template <class T>
double load_as_double(const char* at, bool swap) {
  return static_cast<double>(load<T>(at, swap));
}

struct ElementType {
  std::string_view name;  // without the byte order
  std::size_t size;
  Load load;
};
constexpr auto kTypes = std::to_array<ElementType>({
    {"b1", 1, load_as_double<std::uint8_t>},
    {"i1", 1, load_as_double<std::int8_t>},
    {"u1", 1, load_as_double<std::uint8_t>},
    {"i2", 2, load_as_double<std::int16_t>},
    {"u2", 2, load_as_double<std::uint16_t>},
    {"i4", 4, load_as_double<std::int32_t>},
    {"u4", 4, load_as_double<std::uint32_t>},
    {"i8", 8, load_as_double<std::int64_t>},
    {"u8", 8, load_as_double<std::uint64_t>},
    {"f2", 2, [](const char* at, bool swap) { return half(load<std::uint16_t>(at, swap)); }},
    {"f4", 4, load_as_double<float>},
    {"f8", 8, load_as_double<double>},
});

/// The header's text and the bytes after it.
std::pair<std::string_view, std::string_view> parts(std::string_view bytes, const std::string& file) {
  if (!bytes.starts_with("\x93NUMPY"))
    fail_reading(file, "it is no NumPy array: it does not begin with \\x93NUMPY");
  if (bytes.size() < 8) fail_reading(file, "it ends within its header");
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3)
    fail_reading(file, "its version of NumPy's format is " + std::to_string(version) + ", not 1, 2 or 3");
  const std::size_t first = version == 1 ? 10 : 12;
  if (bytes.size() < first) fail_reading(file, "it ends within its header");
  std::size_t length = byte(8) | byte(9) << 8;
  if (version > 1) length |= byte(10) << 16 | byte(11) << 24;
  if (length > bytes.size() - first) fail_reading(file, "it ends within its header");
  return {bytes.substr(first, length), bytes.substr(first + length)};
}

}  // namespace
}  // namespace npy

ValueFile read_npy_values(std::string_view bytes, const ValueRequest& request) {
  using namespace npy;
  const auto [text, data] = parts(bytes, request.file);
  const Header header = HeaderParser(text, request.file).parse();
  const std::string_view type = header.type;
  const std::size_t order = type.find_first_of("<>=|");
  const auto* element = std::ranges::find(kTypes, type.substr(order == 0 ? 1 : 0), &ElementType::name);
  if (element == kTypes.end())
    fail_reading(request.file,
                 "its numbers are of the type " + shown(type) +
                     ": values are read from whole numbers and from floats of 16, 32 and 64 bits");
  if (header.shape.empty() || header.shape.size() > 2)
    fail_reading(request.file, "its array has " + std::to_string(header.shape.size()) +
                                   " dimensions: values are read from one or two");
  const std::uint64_t rows = header.shape[0];
  const std::uint64_t columns = header.shape.size() == 1 ? 1 : header.shape[1];
  const std::uint64_t room = data.size() / element->size;
  if (rows > 0 && columns > 0 && (columns > room || rows > room / columns))
    fail_reading(request.file, "its header announces " + std::to_string(rows) +
                                   (columns == 1 ? "" : " times " + std::to_string(columns)) +
                                   " numbers, but there are bytes for only " + std::to_string(room));
  const std::size_t column = numbered_column(request, columns, "its array");
  // Without columns, shape (4000000000, 0), there is no value, and numbered_column() has thrown.
  const bool swap = type.front() == '>' ? std::endian::native == std::endian::little
                                        : type.front() == '<' && std::endian::native == std::endian::big;
  const std::size_t step = element->size * (header.fortran_order ? 1 : columns);
  const char* at =
      rows == 0 ? nullptr : data.data() + element->size * column * (header.fortran_order ? rows : 1);
  ValueFile file{std::vector<double>(rows), [](std::size_t i) { return "entry " + std::to_string(i); }};
  for (std::size_t i = 0; i < rows; ++i) {
    if ((i & 0xFFFF) == 0) request.progress.throw_if_cancelled();
    file.values[i] = element->load(at + i * step, swap);
  }
  if (const std::size_t used = rows * columns * element->size; used < data.size())
    file.warnings.push_back(request.file + ": " + std::to_string(data.size() - used) +
                            " bytes follow its array; they were not read");
  return file;
}

}  // namespace morsel::core
