#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/oddities.h"
#include "morsel/core/io/ply_header.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace ply {
namespace {

constexpr const char* kAnnounced = "the elements that its header announces";

/// Values of a text body: one element a line.
class TextBody {
 public:
  TextBody(TextScanner& scanner, const std::string&, const Progress&) : scanner_(scanner) {}

  void check_room(const Element& element) {
    if (element.count > (scanner_.remaining() + 1) / (2 * element.properties.size()))
      scanner_.fail("the header announces " + std::to_string(element.count) + " " + element.plural() +
                    ", but the file is too short for them");
  }
  void begin(const Element& element, std::uint64_t i) {
    element_ = &element;
    if (!scanner_.next_line())
      scanner_.fail_at_end("after " + std::to_string(i) + " of " + std::to_string(element.count) + " " +
                           element.plural());
  }
  /// Which number of a vertex's line is which coordinate cannot be told where there are more than announced;
  /// of other elements the first ones are those of the header: programs wrote such files.
  void end() {
    if (scanner_.at_line_end()) return;
    if (element_->name == "vertex")
      scanner_.fail("the line has more numbers than the header's properties, from " + shown(scanner_.word()) +
                    " on");
    while (!scanner_.at_line_end()) scanner_.number("a number");
    if (longer_.empty() || longer_.back().name != element_->name) longer_.push_back({element_->name, 0});
    ++longer_.back().lines;
  }
  double scalar(Type type) {
    if (type == Type::float64) return scanner_.number("a number");
    if (type == Type::float32) return scanner_.single_number("a number");
    return static_cast<double>(whole(type));
  }
  std::int64_t whole(Type type) {
    const auto [value, has_decimals] = scanner_.whole_number("a whole number");
    if (has_decimals) ++with_decimals_;
    if (!is_whole(type)) return value;
    const auto bits = static_cast<int>(8 * size_of(type));
    const bool is_signed = type == Type::int8 || type == Type::int16 || type == Type::int32;
    const std::int64_t low = is_signed ? -(std::int64_t{1} << (bits - 1)) : 0;
    const std::int64_t high = (std::int64_t{1} << (is_signed ? bits - 1 : bits)) - 1;
    if (value < low || value > high)
      scanner_.fail(std::to_string(value) + " is out of the range of its declared type");
    return value;
  }
  void check_list(std::uint64_t, Type) {}
  void count_values(std::size_t) {}  // the scanner does
  void finish(std::vector<std::string>& warnings) {
    for (const Longer& element : longer_)
      warnings.push_back(counted(element.lines, element.name + " line") +
                         (element.lines == 1 ? " goes on" : " go on") +
                         " after the header's properties; what follows there is left out");
    if (with_decimals_ > 0)
      warnings.push_back(counted(with_decimals_, "whole number") + (with_decimals_ == 1 ? " is" : " are") +
                         " written with decimals, all of them 0");
    std::uint64_t lines = 0;
    while (scanner_.next_line()) ++lines;
    add_left_out(warnings, lines, "line", kAnnounced);
  }
  [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

 private:
  struct Longer {
    std::string name;
    std::uint64_t lines;
  };

  TextScanner& scanner_;
  const Element* element_ = nullptr;
  std::vector<Longer> longer_;  // elements whose lines are longer than they should be
  std::uint64_t with_decimals_ = 0;
};

constexpr std::size_t kPause = 1 << 16;  // values between two reports of progress

/// Values of a binary body.
template <bool kSwap>
class BinaryBody {
 public:
  BinaryBody(TextScanner& scanner, const std::string& file, const Progress& progress)
      : file_(file),
        progress_(progress),
        cursor_(scanner.rest().data()),
        end_(cursor_ + scanner.remaining()) {}

  void check_room(const Element& element) {
    std::size_t least = 0;
    for (const Property& p : element.properties) least += size_of(p.is_list ? p.count_type : p.type);
    if (element.count > room() / least)
      fail_reading(file_, "the header announces " + std::to_string(element.count) + " " + element.plural() +
                              " of at least " + std::to_string(least) + " bytes, but only " +
                              std::to_string(room()) + " bytes are left for them");
  }
  void begin(const Element& element, std::uint64_t i) {
    element_ = &element;
    number_ = i;
    count_values(element.properties.size());
  }
  void end() {}
  double scalar(Type type) {
    switch (type) {
      case Type::float32:
        return load<float>();
      case Type::float64:
        return load<double>();
      default:
        return static_cast<double>(whole(type));
    }
  }
  std::int64_t whole(Type type) {
    switch (type) {
      case Type::int8:
        return load<std::int8_t>();
      case Type::uint8:
        return load<std::uint8_t>();
      case Type::int16:
        return load<std::int16_t>();
      case Type::uint16:
        return load<std::uint16_t>();
      case Type::int32:
        return load<std::int32_t>();
      case Type::uint32:
        return load<std::uint32_t>();
      default:
        return whole_of_float(type);
    }
  }
  void check_list(std::uint64_t count, Type type) {
    if (count > room() / size_of(type)) fail_too_short();
  }
  /// Of those that were read or are read next.
  void count_values(std::size_t count) {
    values_ += count;
    if (values_ < kPause) return;
    values_ = 0;
    progress_.update("reading the mesh", static_cast<double>(number_) / static_cast<double>(element_->count));
  }
  void finish(std::vector<std::string>& warnings) {
    const bool blank = std::all_of(cursor_, end_, [](char c) { return c == '\n' || c == '\r' || c == ' '; });
    if (!blank) add_left_out(warnings, room(), "byte", kAnnounced);
  }
  [[noreturn]] void fail(const std::string& what) const { fail_reading(file_, place() + ": " + what); }

 private:
  std::size_t room() const { return static_cast<std::size_t>(end_ - cursor_); }
  std::string place() const { return element_->name + " " + std::to_string(number_); }
  [[noreturn]] void fail_too_short() const {
    fail_reading(file_, "it ends within " + place() + " of " + std::to_string(element_->count));
  }

  std::int64_t whole_of_float(Type type) {
    const double value = scalar(type);
    if (!(std::abs(value) < 0x1p53) || std::trunc(value) != value)
      fail("expected a whole number, found " + shortest(value));
    return static_cast<std::int64_t>(value);
  }

  template <class T>
  T load() {
    if (room() < sizeof(T)) fail_too_short();
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), cursor_, sizeof(T));
    cursor_ += sizeof(T);
    if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  const std::string& file_;
  const Progress& progress_;
  const char* cursor_;
  const char* end_;
  const Element* element_ = nullptr;
  std::uint64_t number_ = 0;
  std::size_t values_ = 0;  // since progress was reported
};

/// Stores the elements, in either encoding.
template <class Body>
class BodyReader {
 public:
  BodyReader(const Header& header, Body body) : header_(header), body_(body) {}

  LoadedSoup read() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;
      body_.check_room(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else
        skip(element);
    }
    warn_of_floating_point();
    body_.finish(result_.warnings);
    return std::move(result_);
  }

 private:
  void warn_of_floating_point() {
    for (const Element& element : header_.elements)
      for (const Property& p : element.properties)
        if (element.count > 0 && (element.name == "face" || element.name == "tristrips") &&
            is_corner_list(p) && !(is_whole(p.type) && is_whole(p.count_type)))
          result_.warnings.push_back("the corners of its " + element.plural() +
                                     " are declared as floating-point numbers");
  }

  void skip(const Property& property) {
    if (!property.is_list) {
      body_.scalar(property.type);
      return;
    }
    const std::uint64_t count = list_length(property);
    for (std::uint64_t i = 0; i < count; ++i) {
      body_.scalar(property.type);
      body_.count_values(1);
    }
  }

  void skip(const Element& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body_.begin(element, i);
      for (const Property& p : element.properties) skip(p);
      body_.end();
    }
  }

  std::uint64_t list_length(const Property& property) {
    const std::int64_t count = body_.whole(property.count_type);
    if (count < 0) body_.fail("the length of a list is " + std::to_string(count));
    body_.check_list(static_cast<std::uint64_t>(count), property.type);
    return static_cast<std::uint64_t>(count);
  }

  void read_vertices(const Element& element) {
    const std::uint64_t count = element.count;
    auto& positions = result_.soup.positions;
    positions.resize(count);
    std::vector<double*> targets;  // per property; null for lists
    std::vector<int> strides;
    for (const Property& p : element.properties)
      if (!p.is_list && p.name != "x" && p.name != "y" && p.name != "z")
        result_.properties.push_back({p.name, std::vector<double>(count)});
    std::size_t kept = 0;
    for (const Property& p : element.properties) {
      const std::size_t axis = p.is_list ? std::string::npos : std::string_view("xyz").find(p.name);
      const bool is_coordinate = p.name.size() == 1 && axis != std::string::npos;
      targets.push_back(p.is_list       ? nullptr
                        : is_coordinate ? positions.empty() ? nullptr : positions.data()->data() + axis
                                        : result_.properties[kept++].values.data());
      strides.push_back(is_coordinate ? 3 : 1);
    }
    for (std::uint64_t v = 0; v < count; ++v) {
      body_.begin(element, v);
      for (std::size_t k = 0; k < targets.size(); ++k) {
        if (targets[k] == nullptr) {
          skip(element.properties[k]);
          continue;
        }
        *targets[k] = body_.scalar(element.properties[k].type);
        targets[k] += strides[k];
      }
      body_.end();
    }
  }

  void read_faces(const Element& element) {
    PolygonSoup& soup = result_.soup;
    soup.offsets.reserve(soup.offsets.size() + element.count);
    soup.corners.reserve(soup.corners.size() + 3 * element.count);
    std::vector<VertexProperty> properties;  // of polygons, those of strips before them included
    for (const Property& p : element.properties)
      if (!p.is_list) {
        properties.push_back({p.name, std::vector<double>(soup.polygon_count(), kNoValue)});
        properties.back().values.reserve(soup.polygon_count() + element.count);
      }
    const std::uint64_t vertices = vertex_count();
    for (std::uint64_t f = 0; f < element.count; ++f) {
      body_.begin(element, f);
      auto property = properties.begin();
      for (const Property& p : element.properties) {
        if (!p.is_list) {
          (property++)->values.push_back(body_.scalar(p.type));
          continue;
        }
        if (!is_corner_list(p)) {
          skip(p);
          continue;
        }
        const std::uint64_t corners = list_length(p);
        for (std::uint64_t i = 0; i < corners; ++i) {
          soup.corners.push_back(corner(body_.whole(p.type), vertices, "a face"));
          body_.count_values(1);
        }
      }
      soup.offsets.push_back(soup.corners.size());
      body_.end();
    }
    result_.face_properties = std::move(properties);
  }

  /// Each three consecutive vertices are a triangle, every second one turned round; −1 begins a new strip.
  /// Triangles with a repeated vertex only join strips and are skipped.
  void read_strips(const Element& element) {
    const std::uint64_t vertices = vertex_count();
    for (std::uint64_t s = 0; s < element.count; ++s) {
      body_.begin(element, s);
      for (const Property& p : element.properties) {
        if (!is_corner_list(p)) {
          skip(p);
          continue;
        }
        const std::uint64_t length = list_length(p);
        std::size_t in_strip = 0;
        std::array<Index, 2> before{};  // the last two vertices
        for (std::uint64_t i = 0; i < length; ++i) {
          const std::int64_t number = body_.whole(p.type);
          body_.count_values(1);
          if (number == -1) {
            in_strip = 0;
            continue;
          }
          const Index v = corner(number, vertices, "a triangle strip");
          if (in_strip >= 2 && before[0] != before[1] && before[0] != v && before[1] != v)
            result_.soup.add_polygon(in_strip % 2 == 0 ? std::array{before[0], before[1], v}
                                                       : std::array{before[1], before[0], v});
          before = {before[1], v};
          ++in_strip;
        }
      }
      body_.end();
    }
    for (VertexProperty& p : result_.face_properties) p.values.resize(result_.soup.polygon_count(), kNoValue);
  }

  Index corner(std::int64_t v, std::uint64_t vertices, const char* of) const {
    if (v < 0 || static_cast<std::uint64_t>(v) >= vertices)
      body_.fail(std::string(of) + " names vertex " + std::to_string(v) + ", but there are only " +
                 std::to_string(vertices) + " vertices, numbered from 0");
    return static_cast<Index>(v);
  }

  std::uint64_t vertex_count() const {
    for (const Element& element : header_.elements)
      if (element.name == "vertex") return element.count;
    return 0;
  }

  /// Of a face property, at triangles of strips.
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

  const Header& header_;
  Body body_;
  LoadedSoup result_;
};

}  // namespace
}  // namespace ply

LoadedSoup read_ply(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  // The first line determines the line terminator; a binary body has none.
  const std::size_t first = bytes.find_first_of("\r\n");
  const bool old_mac = first != std::string_view::npos && bytes[first] == '\r' &&
                       (first + 1 == bytes.size() || bytes[first + 1] != '\n');
  TextScanner scanner(bytes, file, {.comment = 0, .continuation = false, .terminator = old_mac ? '\r' : '\n'},
                      progress);
  const ply::Header header = ply::read_header(scanner, file);
  constexpr bool kLittle = std::endian::native == std::endian::little;
  switch (header.encoding) {
    case ply::Encoding::ascii:
      return ply::BodyReader(header, ply::TextBody(scanner, file, progress)).read();
    case ply::Encoding::little_endian:
      return ply::BodyReader(header, ply::BinaryBody<!kLittle>(scanner, file, progress)).read();
    default:
      return ply::BodyReader(header, ply::BinaryBody<kLittle>(scanner, file, progress)).read();
  }
}

}  // namespace morsel::core
