#include "morsel/core/io/ply_header.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "morsel/core/types.h"

namespace morsel::core::ply {
namespace {

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

/// Refuses headers that describe no mesh.
void check_describes_mesh(const Header& header, const std::string& file) {
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
    if ((element.name == "face" || element.name == "tristrips") && element.count > 0 &&
        std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1)
      fail_reading(file, (element.name == "face" ? "its faces need" : "its triangle strips need") +
                             std::string(" one list of whole numbers called vertex_indices"));
  }
  if (!has_vertices) fail_reading(file, "its header declares no vertices");
}

}  // namespace

Header read_header(TextScanner& scanner, const std::string& file) {
  Header header = HeaderReader(scanner).read();
  check_describes_mesh(header, file);
  return header;
}

}  // namespace morsel::core::ply
