// VTK's XML formats: PolyData (.vtp) and the surfaces in UnstructuredGrid (.vtu).

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/io/decompression.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/vtk_surface.h"
#include "morsel/core/io/vtk_xml_data.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace vtk {
namespace {

std::string_view attribute_of(const pugi::xml_node& node, const char* name) {
  return node.attribute(name).value();
}

/// Raw bytes are no XML: the content of AppendedData is cut out before the rest is parsed.
struct CutDocument {
  std::string xml;            ///< without the content
  std::string_view appended;  ///< from the byte after its _ on
  bool has_appended = false;
};

CutDocument cut_out_appended(std::string_view bytes, const std::string& file) {
  CutDocument result;
  const std::size_t element = bytes.find("<AppendedData");
  const std::size_t open_end = element == std::string_view::npos ? element : bytes.find('>', element);
  if (open_end == std::string_view::npos || bytes[open_end - 1] == '/') {
    result.xml = bytes;
    return result;
  }
  const std::size_t close = bytes.rfind("</AppendedData");
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n", open_end + 1);
  if (close == std::string_view::npos || close < open_end || begin >= close || bytes[begin] != '_')
    fail_reading(file, "its appended data are cut off: they begin with _ and end with </AppendedData>");
  result.appended = bytes.substr(begin + 1, close - begin - 1);
  result.has_appended = true;
  result.xml.reserve(open_end + 1 + bytes.size() - close);
  result.xml.append(bytes.substr(0, open_end + 1)).append(bytes.substr(close));
  return result;
}

class XmlReader {
 public:
  XmlReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : file_(file),
        progress_(progress),
        cut_(cut_out_appended(bytes, file)),
        builder_(file, progress),
        budget_(bytes.size()) {}

  LoadedSoup read() {
    // Neither parsing nor destruction recurses, and entities of a document are not expanded.
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer_inplace(cut_.xml.data(), cut_.xml.size());
    if (!parsed)
      fail_reading(file_, "it is no whole XML document: " + std::string(parsed.description()) + " at byte " +
                              std::to_string(parsed.offset));
    const pugi::xml_node root = document.document_element();
    if (root.name() != std::string_view("VTKFile"))
      fail_reading(file_, "it is no VTK file: its root is <" + std::string(root.name()) + ">, not <VTKFile>");
    read_encoding(root);
    const std::string_view kind = attribute_of(root, "type");
    is_grid_ = kind == "UnstructuredGrid";
    if (!is_grid_ && kind != "PolyData")
      fail_reading(file_, "its data are of the type " + shown(kind) +
                              ": surfaces are read from PolyData and UnstructuredGrid");
    const pugi::xml_node data = root.child(is_grid_ ? "UnstructuredGrid" : "PolyData");
    if (!data) fail_reading(file_, "its element <" + std::string(kind) + "> is missing");
    for (const pugi::xml_node piece : data.children("Piece")) read_piece(piece);
    return builder_.finish(point_arrays_.joined(*this, "points"), cell_arrays_.joined(*this, "cells"));
  }

 private:
  /// The arrays of points or of cells, joined over the pieces of a file.
  struct Arrays {
    struct Joined {
      Array array;
      std::size_t pieces = 0;
    };
    std::vector<Joined> all;
    std::map<std::string, std::size_t, std::less<>> by_name;

    std::vector<Array> joined(XmlReader& reader, const std::string& owner) {
      std::vector<Array> result;
      for (Joined& one : all) {
        if (one.pieces == reader.pieces_)
          result.push_back(std::move(one.array));
        else
          reader.builder_.warn("the array " + shown(one.array.name) + " of its " + owner +
                               " is not in all pieces and was left out");
      }
      return result;
    }
  };

  [[noreturn]] void fail(const std::string& what) const { fail_reading(file_, what); }

  void read_encoding(const pugi::xml_node& root) {
    const std::string_view order = attribute_of(root, "byte_order");
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
      fail("its byte_order is " + shown(order) + ", not LittleEndian or BigEndian");
    const bool is_big = order == "BigEndian";
    encoding_.swap = is_big == (std::endian::native == std::endian::little);
    const std::string_view header = attribute_of(root, "header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64")
      fail("its header_type is " + shown(header) + ", not UInt32 or UInt64");
    encoding_.wide_header = header == "UInt64";
    const std::string_view compressor = attribute_of(root, "compressor");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      fail("it is compressed by " + shown(compressor) +
           ": write it with vtkZLibDataCompressor or without compression");
    encoding_.compressed = !compressor.empty();
    if (!cut_.has_appended) return;
    const std::string_view encoding = attribute_of(root.child("AppendedData"), "encoding");
    if (encoding != "raw" && encoding != "base64" && !encoding.empty())
      fail("its appended data have the encoding " + shown(encoding) + ", not raw or base64");
    appended_base64_ = encoding != "raw";
    appended_budget_ = 8 * cut_.appended.size();
  }

  std::uint64_t count_of(const pugi::xml_node& node, const char* name, std::uint64_t otherwise) const {
    const std::string_view text = attribute_of(node, name);
    if (text.empty()) return otherwise;
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size())
      fail("its " + std::string(name) + " is " + shown(text) + ", which is no count");
    return value;
  }

  void read_piece(const pugi::xml_node& piece) {
    progress_.throw_if_cancelled();
    const std::size_t first = builder_.point_count();
    const std::size_t cells_before = builder_.cell_count();
    const std::uint64_t points = count_of(piece, "NumberOfPoints", 0);
    const pugi::xml_node coordinates = piece.child("Points").child("DataArray");
    if (coordinates) builder_.add_points(numbers(coordinates, times(points, 3), "the array of points"));
    if (builder_.point_count() - first != points)
      fail("a piece announces " + std::to_string(points) + " points, but has " +
           std::to_string(builder_.point_count() - first));
    if (is_grid_) {
      const pugi::xml_node node = piece.child("Cells");
      const std::uint64_t count = count_of(piece, "NumberOfCells", 0);
      const Cells cells = cells_of(node, count, "Cells");
      std::vector<std::int64_t> types;
      if (const pugi::xml_node array = named(node, "types"))
        types = whole(array, count, "the array of cell types");
      builder_.add_cells(cells, types, first);
    } else {
      struct Kind {
        const char* element;
        const char* count;
        CellType type;
      };
      constexpr auto kKinds = std::to_array<Kind>({{"Verts", "NumberOfVerts", kPolyVertex},
                                                   {"Lines", "NumberOfLines", kPolyLine},
                                                   {"Polys", "NumberOfPolys", kPolygon},
                                                   {"Strips", "NumberOfStrips", kTriangleStrip}});
      for (const Kind& kind : kKinds)
        builder_.add_cells(cells_of(piece.child(kind.element), count_of(piece, kind.count, 0), kind.element),
                           kind.type, first);
    }
    if (builder_.point_count() == first && builder_.cell_count() == cells_before) return;  // has no arrays
    read_arrays(piece.child("PointData"), point_arrays_, points, "points");
    read_arrays(piece.child("CellData"), cell_arrays_, builder_.cell_count() - cells_before, "cells");
    ++pieces_;
  }

  static pugi::xml_node named(const pugi::xml_node& parent, std::string_view name) {
    for (const pugi::xml_node array : parent.children("DataArray"))
      if (attribute_of(array, "Name") == name) return array;
    return {};
  }

  Cells cells_of(const pugi::xml_node& node, std::uint64_t count, const std::string& what) {
    Cells cells;
    if (const pugi::xml_node array = named(node, "offsets"))
      cells.ends = whole(array, count, "the offsets of " + what);
    if (cells.ends.size() != count)
      fail("a piece announces " + std::to_string(count) + " cells in " + what + ", but has offsets of " +
           std::to_string(cells.ends.size()));
    // As many corners as the last cell ends at.
    const std::int64_t corners = cells.ends.empty() ? 0 : std::max<std::int64_t>(cells.ends.back(), 0);
    if (const pugi::xml_node array = named(node, "connectivity"))
      cells.connectivity = whole(array, static_cast<std::uint64_t>(corners), "the connectivity of " + what);
    return cells;
  }

  /// Arrays of `tuples` tuples each.
  void read_arrays(const pugi::xml_node& section, Arrays& arrays, std::uint64_t tuples,
                   const std::string& owner) {
    std::size_t unnamed = 0;
    for (const pugi::xml_node node : section.children()) {
      const std::string_view element = node.name();
      if (element != "DataArray" && element != "Array") continue;
      std::string name(attribute_of(node, "Name"));
      if (name.empty()) name = "unnamed" + (unnamed == 0 ? std::string() : std::to_string(unnamed + 1));
      if (attribute_of(node, "Name").empty()) ++unnamed;
      const std::string what = "the array " + shown(name) + " of its " + owner;
      const std::string_view time = attribute_of(node, "TimeStep");
      const bool is_later = !time.empty() && time != "0" && !time.starts_with("0 ");
      if (is_later || !number_type(attribute_of(node, "type"))) {
        builder_.warn(what + (is_later ? " is of a later time step" : " has no numbers") +
                      " and was left out");
        continue;
      }
      const std::size_t components = count_of(node, "NumberOfComponents", 1);
      std::vector<double> values = numbers(node, times(tuples, components), what);
      const auto [found, is_new] = arrays.by_name.try_emplace(name, arrays.all.size());
      if (is_new) {
        // One that is not in the first piece is left out at the end.
        arrays.all.push_back({{name, components, std::move(values)}, pieces_ == 0 ? std::size_t{1} : 0});
        continue;
      }
      Arrays::Joined& joined = arrays.all[found->second];
      if (joined.pieces == pieces_ + 1) {
        builder_.warn(what + " comes twice; the second one was left out");
      } else if (joined.pieces == pieces_ && joined.array.components == components) {
        joined.array.values.insert(joined.array.values.end(), values.begin(), values.end());
        ++joined.pieces;
      }
    }
  }

  std::optional<NumberType> type_of(const pugi::xml_node& array, const std::string& what) const {
    const std::string_view name = attribute_of(array, "type");
    const std::optional<NumberType> type = number_type(name);
    if (!type) fail(what + " is of the type " + shown(name) + ", which is none of VTK's numbers");
    return type;
  }

  /// The product, or the largest number if that is less.
  static std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    return b != 0 && a > kMost / b ? kMost : a * b;
  }

  /// The numbers of an array, which has `count` of them by what the file announces: one that is said to have
  /// another number is refused before it is decompressed. Of texts the caller sees it.
  std::vector<double> numbers(const pugi::xml_node& array, std::uint64_t count, const std::string& what) {
    const NumberType type = *type_of(array, what);
    if (is_text(array, what))
      return parsed<double>(array, what, [type](std::string_view word, double& value) {
        return parse_number(word, type, value);
      });
    return decoded(block(array, type, count, what), type, encoding_.swap, progress_);
  }

  std::vector<std::int64_t> whole(const pugi::xml_node& array, std::uint64_t count, const std::string& what) {
    const NumberType type = *type_of(array, what);
    if (!is_whole(type)) fail(what + " has numbers that are not whole");
    if (is_text(array, what))
      return parsed<std::int64_t>(array, what, [type](std::string_view word, std::int64_t& value) {
        return parse_whole(word, type, value);
      });
    return decoded_whole(block(array, type, count, what), type, encoding_.swap, progress_);
  }

  bool is_text(const pugi::xml_node& array, const std::string& what) const {
    const std::string_view format = attribute_of(array, "format");
    if (format != "ascii" && format != "binary" && format != "appended" && !format.empty())
      fail(what + " has the format " + shown(format) + ", not ascii, binary or appended");
    return format == "ascii" || format.empty();
  }

  template <class Number, class Parse>
  std::vector<Number> parsed(const pugi::xml_node& array, const std::string& what, const Parse& parse) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::string_view text = array.child_value();
    std::vector<Number> values;
    for (std::size_t at = 0; (at = text.find_first_not_of(kSpace, at)) != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
      if ((values.size() & 0xFFFF) == 0) progress_.throw_if_cancelled();
      if (!parse(text.substr(at, end - at), values.emplace_back()))
        fail(what + ": entry " + std::to_string(values.size() - 1) + " is " +
             shown(text.substr(at, end - at)) + ", which is no number of its type");
      at = end;
    }
    return values;
  }

  /// The bytes of a binary array.
  std::string block(const pugi::xml_node& array, NumberType type, std::uint64_t count,
                    const std::string& what) {
    const bool is_appended = attribute_of(array, "format") == "appended";
    std::string_view text = array.child_value();
    if (is_appended) {
      const std::uint64_t offset = count_of(array, "offset", 0);
      if (!cut_.has_appended) fail(what + " is in appended data, which the file does not have");
      if (offset > cut_.appended.size())
        fail(what + " begins at byte " + std::to_string(offset) + " of the appended data, which have " +
             std::to_string(cut_.appended.size()));
      text = cut_.appended.substr(offset);
    }
    ByteStream stream(text, !is_appended || appended_base64_);
    if (!is_appended && stream.rest().empty()) return {};
    const auto check = [&](std::uint64_t size) {
      if (size != times(count, size_of(type)))
        fail(what + " is said to have " + std::to_string(size) + " bytes, but " + std::to_string(count) +
             " numbers of " + std::to_string(size_of(type)) + " are announced");
      budget_.take(count, sizeof(double), file_, what);
    };
    std::string bytes = read_block(stream, encoding_, file_, what, check, progress_);
    if (is_appended) {
      // Arrays that lie one over the other could make any amount of work of a small file.
      const std::size_t used = text.size() - stream.rest().size();
      if (used > appended_budget_) fail("its arrays overlap in the appended data");
      appended_budget_ -= used;
    } else if (!bytes.empty() && !stream.at_end()) {
      fail(what + " goes on after its end, with " + shown(stream.rest().substr(0, 20)));
    }
    return bytes;
  }

  const std::string& file_;
  const Progress& progress_;
  CutDocument cut_;
  SurfaceBuilder builder_;
  XmlEncoding encoding_;
  DecompressionBudget budget_;
  bool is_grid_ = false;
  bool appended_base64_ = false;
  std::uint64_t appended_budget_ = 0;  // bytes of it that may still be read, some more than once
  std::size_t pieces_ = 0;             // those read
  Arrays point_arrays_;
  Arrays cell_arrays_;
};

}  // namespace
}  // namespace vtk

LoadedSoup read_vtk_xml(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  return vtk::XmlReader(bytes, file, progress).read();
}

}  // namespace morsel::core
