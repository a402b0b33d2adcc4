#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <type_traits>

#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr std::array<TypeName, 16> kTypes = {{{"char", Type::int8},
                                              {"uchar", Type::uint8},
                                              {"short", Type::int16},
                                              {"ushort", Type::uint16},
                                              {"int", Type::int32},
                                              {"uint", Type::uint32},
                                              {"float", Type::float32},
                                              {"double", Type::float64},
                                              {"int8", Type::int8},
                                              {"uint8", Type::uint8},
                                              {"int16", Type::int16},
                                              {"uint16", Type::uint16},
                                              {"int32", Type::int32},
                                              {"uint32", Type::uint32},
                                              {"float32", Type::float32},
                                              {"float64", Type::float64}}};

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_whole(Type type) { return type != Type::float32 && type != Type::float64; }

struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  std::string plural() const { return name == "vertex" ? "vertices" : name + "s"; }
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

/// Reads the header's lines; `scanner` stands at the end of its last one afterwards.
class HeaderReader {
 public:
  explicit HeaderReader(TextScanner& scanner) : scanner_(scanner) {}

  Header read() {
    if (!scanner_.next_raw_line() || scanner_.word() != "ply" || !scanner_.at_line_end())
      scanner_.fail("a PLY file begins with a line \"ply\"");
    for (;;) {
      if (!scanner_.next_line()) scanner_.fail_at_end("within its header");
      const std::string_view keyword = scanner_.word();
      if (keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "end_header") break;
      if (keyword == "format")
        read_format();
      else if (keyword == "element")
        read_element();
      else if (keyword == "property")
        read_property();
      else
        scanner_.fail("a PLY header has no line " + shown(keyword));
      if (!scanner_.at_line_end()) scanner_.fail("this header line has more words than it should");
    }
    if (!has_format_) scanner_.fail("the header has no format line");
    return std::move(header_);
  }

 private:
  void read_format() {
    const std::string_view word = scanner_.word();
    if (word == "ascii")
      header_.encoding = Encoding::ascii;
    else if (word == "binary_little_endian")
      header_.encoding = Encoding::little_endian;
    else if (word == "binary_big_endian")
      header_.encoding = Encoding::big_endian;
    else
      scanner_.fail("unknown format " + shown(word));
    if (has_format_) scanner_.fail("the header has two format lines");
    has_format_ = true;
    const std::string_view version = scanner_.word();
    if (version != "1.0") scanner_.fail("unknown version " + shown(version) + " of the format");
  }

  void read_element() {
    Element element;
    element.name = scanner_.word();
    const std::int64_t count = scanner_.integer("the number of elements");
    if (count < 0) scanner_.fail("the number of elements is " + std::to_string(count));
    element.count = static_cast<std::uint64_t>(count);
    if (!element_names_.insert(element.name).second)
      scanner_.fail("element " + shown(element.name) + " is declared twice");
    header_.elements.push_back(std::move(element));
    property_names_.clear();
  }

  void read_property() {
    if (header_.elements.empty()) scanner_.fail("a property before any element");
    Property property;
    std::string_view word = scanner_.word();
    property.is_list = word == "list";
    if (property.is_list) {
      property.count_type = type(scanner_.word());
      if (!is_whole(property.count_type)) scanner_.fail("the length of a list must have a whole type");
      word = scanner_.word();
    }
    property.type = type(word);
    property.name = scanner_.word();
    if (property.name.empty()) scanner_.fail("a property without a name");
    if (!property_names_.insert(property.name).second)
      scanner_.fail("property " + shown(property.name) + " is declared twice");
    header_.elements.back().properties.push_back(std::move(property));
  }

  Type type(std::string_view name) {
    for (const TypeName& entry : kTypes)
      if (entry.name == name) return entry.type;
    scanner_.fail("unknown type " + shown(name));
  }

  TextScanner& scanner_;
  Header header_;
  std::set<std::string> element_names_;
  std::set<std::string> property_names_;  // of the last element
  bool has_format_ = false;
};

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
    if (!scanner_.next_line())
      scanner_.fail_at_end("after " + std::to_string(i) + " of " + std::to_string(element.count) + " " +
                           element.plural());
  }
  void end() {
    if (!scanner_.at_line_end())
      scanner_.fail("the line has more numbers than the header's properties, from " + shown(scanner_.word()) +
                    " on");
  }
  double scalar(Type type) {
    if (type == Type::float64) return scanner_.number("a number");
    if (type == Type::float32) return scanner_.single_number("a number");
    return static_cast<double>(whole(type));
  }
  std::int64_t whole(Type type) {
    const std::int64_t value = scanner_.integer("a whole number");
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
  void finish() {
    if (scanner_.next_line()) scanner_.fail("the file goes on after the elements that its header announces");
  }
  [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

 private:
  TextScanner& scanner_;
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
      default:
        return load<std::uint32_t>();
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
  void finish() {
    const bool blank = std::all_of(cursor_, end_, [](char c) { return c == '\n' || c == '\r' || c == ' '; });
    if (!blank)
      fail_reading(file_, std::to_string(room()) + " bytes follow the elements that its header announces");
  }
  [[noreturn]] void fail(const std::string& what) const { fail_reading(file_, place() + ": " + what); }

 private:
  std::size_t room() const { return static_cast<std::size_t>(end_ - cursor_); }
  std::string place() const { return element_->name + " " + std::to_string(number_); }
  [[noreturn]] void fail_too_short() const {
    fail_reading(file_, "it ends within " + place() + " of " + std::to_string(element_->count));
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
      else
        skip(element);
    }
    body_.finish();
    return std::move(result_);
  }

 private:
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
    soup.offsets.reserve(element.count + 1);
    soup.corners.reserve(3 * element.count);
    const std::uint64_t vertices = vertex_count();
    for (std::uint64_t f = 0; f < element.count; ++f) {
      body_.begin(element, f);
      for (const Property& p : element.properties) {
        if (!p.is_list || (p.name != "vertex_indices" && p.name != "vertex_index")) {
          skip(p);
          continue;
        }
        const std::uint64_t corners = list_length(p);
        for (std::uint64_t i = 0; i < corners; ++i) {
          const std::int64_t v = body_.whole(p.type);
          if (v < 0 || static_cast<std::uint64_t>(v) >= vertices)
            body_.fail("a face names vertex " + std::to_string(v) + ", but there are only " +
                       std::to_string(vertices) + " vertices, numbered from 0");
          soup.corners.push_back(static_cast<Index>(v));
          body_.count_values(1);
        }
      }
      soup.offsets.push_back(soup.corners.size());
      body_.end();
    }
  }

  std::uint64_t vertex_count() const {
    for (const Element& element : header_.elements)
      if (element.name == "vertex") return element.count;
    return 0;
  }

  const Header& header_;
  Body body_;
  LoadedSoup result_;
};

/// Refuses headers that describe no mesh.
void check(const Header& header, const std::string& file) {
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      has_vertices = true;
      if (element.count >= kNone) fail_reading(file, "it has more vertices than can be numbered");
      for (const char* axis : {"x", "y", "z"})
        if (std::none_of(element.properties.begin(), element.properties.end(),
                         [&](const Property& p) { return !p.is_list && p.name == axis; }))
          fail_reading(file, std::string("its vertices have no property ") + axis);
    }
    if (element.name == "face" && element.count > 0) {
      const auto lists =
          std::count_if(element.properties.begin(), element.properties.end(), [](const Property& p) {
            return p.is_list && is_whole(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index");
          });
      if (lists != 1) fail_reading(file, "its faces need one list of whole numbers called vertex_indices");
    }
    if (element.name == "tristrips" && element.count > 0)
      fail_reading(file, "it holds triangle strips, which are not supported: export it as triangles");
  }
  if (!has_vertices) fail_reading(file, "its header declares no vertices");
}

}  // namespace

LoadedSoup read_ply(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  // The first line determines the line terminator; a binary body has none.
  const std::size_t first = bytes.find_first_of("\r\n");
  const bool old_mac = first != std::string_view::npos && bytes[first] == '\r' &&
                       (first + 1 == bytes.size() || bytes[first + 1] != '\n');
  TextScanner scanner(bytes, file, {.comment = 0, .continuation = false, .terminator = old_mac ? '\r' : '\n'},
                      progress);
  const Header header = HeaderReader(scanner).read();
  check(header, file);
  constexpr bool kLittle = std::endian::native == std::endian::little;
  switch (header.encoding) {
    case Encoding::ascii:
      return BodyReader(header, TextBody(scanner, file, progress)).read();
    case Encoding::little_endian:
      return BodyReader(header, BinaryBody<!kLittle>(scanner, file, progress)).read();
    default:
      return BodyReader(header, BinaryBody<kLittle>(scanner, file, progress)).read();
  }
}

}  // namespace morsel::core
