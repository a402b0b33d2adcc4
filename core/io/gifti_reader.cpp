// GIFTI, the XML files of surfaces and their values in neuroimaging.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/gifti.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/xml_arrays.h"
#include "morsel/core/text/base64.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace gifti {
namespace {

constexpr std::size_t kPause = 1 << 16;  // elements between two checks for cancellation

constexpr std::string_view kPoints = "NIFTI_INTENT_POINTSET";
constexpr std::string_view kTriangles = "NIFTI_INTENT_TRIANGLE";

std::optional<NumberType> number_type(std::string_view name) {
  constexpr auto kTypes =
      std::to_array<std::pair<std::string_view, NumberType>>({{"NIFTI_TYPE_UINT8", NumberType::uint8},
                                                              {"NIFTI_TYPE_INT32", NumberType::int32},
                                                              {"NIFTI_TYPE_FLOAT32", NumberType::float32},
                                                              {"NIFTI_TYPE_INT8", NumberType::int8},
                                                              {"NIFTI_TYPE_INT16", NumberType::int16},
                                                              {"NIFTI_TYPE_UINT16", NumberType::uint16},
                                                              {"NIFTI_TYPE_UINT32", NumberType::uint32},
                                                              {"NIFTI_TYPE_INT64", NumberType::int64},
                                                              {"NIFTI_TYPE_UINT64", NumberType::uint64},
                                                              {"NIFTI_TYPE_FLOAT64", NumberType::float64}});
  const auto* found = std::ranges::find(kTypes, name, &std::pair<std::string_view, NumberType>::first);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The text within an element, comments left out.
std::string text_of(const pugi::xml_node& node) {
  std::string text;
  for (const pugi::xml_node& child : node.children())
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) text += child.value();
  return text;
}

/// What the metadata of an array call it.
std::string name_of(const pugi::xml_node& array) {
  for (const pugi::xml_node& entry : array.child("MetaData").children("MD"))
    if (text_of(entry.child("Name")) == "Name") return text_of(entry.child("Value"));
  return {};
}

/// Which corner a number is.
Index corner(double value, std::size_t vertices, std::size_t triangle, const std::string& what) {
  if (!(value >= 0 && value < static_cast<double>(vertices) && value == std::trunc(value)))
    throw BadInput(what + "triangle " + std::to_string(triangle) + " names vertex " + shortest(value) +
                   ", but there are " + std::to_string(vertices));
  return static_cast<Index>(value);
}

/// The only array of an intent, or the first, which is told; none is no array.
std::optional<std::size_t> find_array(const GiftiFile& gifti, std::string_view intent,
                                      std::vector<std::string>& warnings) {
  const auto& arrays = gifti.arrays();
  const auto has_intent = [&](const GiftiFile::Array& array) { return array.intent == intent; };
  const auto first = std::ranges::find_if(arrays, has_intent);
  if (first == arrays.end()) return std::nullopt;
  if (const auto count = std::ranges::count_if(arrays, has_intent); count > 1)
    warnings.push_back("it has " + std::to_string(count) + " arrays " + std::string(intent) +
                       ", of which the first is read");
  return static_cast<std::size_t>(first - arrays.begin());
}

/// What a file without a surface has instead: "an array NIFTI_INTENT_SHAPE".
std::string contents_of(const GiftiFile& gifti) {
  const auto& arrays = gifti.arrays();
  if (arrays.empty()) return "no data array";
  return (arrays.size() == 1 ? "one data array, " : std::to_string(arrays.size()) + " data arrays, first ") +
         arrays.front().intent;
}

/// Sets of one value a vertex, as properties.
void add_properties(GiftiFile& gifti, LoadedSoup& result) {
  std::set<std::string, std::less<>> names;
  for (std::size_t i = 0; i < gifti.arrays().size(); ++i) {
    const GiftiFile::Array& array = gifti.arrays()[i];
    if (array.intent == kPoints || array.intent == kTriangles || array.columns != 1) continue;
    if (array.rows != result.soup.positions.size()) {
      result.warnings.push_back(gifti.called(i) + " has " + std::to_string(array.rows) +
                                " values, not one for each vertex, and is left out");
      continue;
    }
    std::string name = array.name.empty() ? "array " + std::to_string(i + 1) : array.name;
    if (names.contains(name)) name += " (array " + std::to_string(i + 1) + ")";
    names.insert(name);
    result.properties.push_back({std::move(name), gifti.values(i)});
  }
}

}  // namespace
}  // namespace gifti

struct GiftiFile::Document {
  pugi::xml_document xml;
  std::vector<pugi::xml_node> arrays;
};

GiftiFile::GiftiFile(std::string_view bytes, const std::string& file, const Progress& progress)
    : file_(file), progress_(progress), budget_(bytes.size()), document_(std::make_unique<Document>()) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  const pugi::xml_parse_result parsed = document_->xml.load_buffer(bytes.data(), bytes.size());
  progress.throw_if_cancelled();
  if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!parsed) {
    const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0));
    const auto line = std::ranges::count(bytes.substr(0, at), '\n') + 1;
    std::string reason = parsed.description();
    if (!reason.empty()) reason.front() = static_cast<char>(reason.front() | 0x20);
    fail_reading(file, "line " + std::to_string(line) + ": it is no whole XML: " + reason);
  }
  const pugi::xml_node root = document_->xml.document_element();
  if (std::string_view(root.name()) != "GIFTI")
    fail_reading(file, "it is no GIFTI file: its outermost element is " + shown(root.name()));
  for (const pugi::xml_node& node : root.children("DataArray")) {
    Array array;
    array.intent = node.attribute("Intent").value();
    array.name = gifti::name_of(node);
    document_->arrays.push_back(node);
    const auto dimension = [&](int axis) {
      const std::string name = "Dim" + std::to_string(axis);
      const auto size = gifti::whole_number(node.attribute(name.c_str()).value());
      if (!size)
        fail_reading(file, "data array " + std::to_string(document_->arrays.size()) + " has no " + name +
                               " that is a whole number");
      return *size;
    };
    const auto dimensions = gifti::whole_number(node.attribute("Dimensionality").value());
    if (!dimensions || *dimensions < 1 || *dimensions > 6)
      fail_reading(file, "data array " + std::to_string(document_->arrays.size()) +
                             " has no Dimensionality from 1 to 6");
    array.rows = dimension(0);
    for (int axis = 1; axis < static_cast<int>(*dimensions); ++axis) {
      const std::uint64_t size = dimension(axis);
      if (size != 0 && array.columns > std::numeric_limits<std::uint32_t>::max() / size)
        fail_reading(file,
                     "data array " + std::to_string(document_->arrays.size()) + " is larger than any file");
      array.columns *= size;
    }
    arrays_.push_back(std::move(array));
  }
  const pugi::xml_attribute announced = root.attribute("NumberOfDataArrays");
  if (announced && gifti::whole_number(announced.value()) != arrays_.size())
    warnings_.push_back("it announces " + shown(announced.value()) + " data arrays and has " +
                        std::to_string(arrays_.size()));
}

GiftiFile::~GiftiFile() = default;

std::string GiftiFile::called(std::size_t i) const {
  return "data array " + std::to_string(i + 1) + " (" + arrays_[i].intent + ")";
}

std::vector<double> GiftiFile::values(std::size_t i) {
  progress_.throw_if_cancelled();
  const pugi::xml_node& node = document_->arrays[i];
  const Array& array = arrays_[i];
  const std::string what = "cannot read \"" + file_ + "\": " + called(i) + ": ";
  const std::string_view encoding = node.attribute("Encoding").value();
  if (encoding == "ExternalFileBinary")
    throw BadInput(what + "its numbers are in another file, " +
                   shown(node.attribute("ExternalFileName").value()) +
                   " (ExternalFileBinary), which is not read; write it with the numbers in the file");
  const std::optional<NumberType> type = gifti::number_type(node.attribute("DataType").value());
  if (!type)
    throw BadInput(what + "its numbers have the unknown type " + shown(node.attribute("DataType").value()));
  const std::string text = gifti::text_of(node.child("Data"));
  if (array.columns != 0 && array.rows > std::numeric_limits<std::uint64_t>::max() / 8 / array.columns)
    throw BadInput(what + "it announces " + std::to_string(array.rows) + " rows of " +
                   std::to_string(array.columns) + ", more than any file has");
  const std::uint64_t count = array.rows * array.columns;
  std::vector<double> numbers;
  if (encoding == "ASCII") {
    numbers = text_numbers(text, *type, count, what, progress_);
  } else if (encoding == "Base64Binary" || encoding == "GZipBase64Binary") {
    const std::string_view order = node.attribute("Endian").value();
    if (order != "LittleEndian" && order != "BigEndian")
      throw BadInput(what + "its Endian is " + shown(order) + ", neither LittleEndian nor BigEndian");
    std::optional<std::string> bytes = decode_base64(text, progress_);
    if (!bytes) throw BadInput(what + "its data are not base64");
    const std::uint64_t size = count * size_of(*type);
    if (encoding == "GZipBase64Binary") {
      budget_.take(count, sizeof(double), file_, called(i));
      bytes = inflated(*bytes, size, what, progress_);
    } else if (bytes->size() != size) {
      throw BadInput(what + "it has " + std::to_string(bytes->size()) + " bytes, but its sizes need " +
                     std::to_string(size));
    }
    const std::endian written = order == "BigEndian" ? std::endian::big : std::endian::little;
    numbers = decoded(*bytes, *type, written != std::endian::native, progress_);
  } else {
    throw BadInput(what + "its encoding " + shown(encoding) +
                   " is none of ASCII, Base64Binary and GZipBase64Binary");
  }
  if (array.columns < 2 ||
      std::string_view(node.attribute("ArrayIndexingOrder").value()) != "ColumnMajorOrder")
    return numbers;
  std::vector<double> by_row(numbers.size());
  for (std::uint64_t at = 0; at < count; ++at) {
    if (at % gifti::kPause == 0) progress_.throw_if_cancelled();
    by_row[at] = numbers[at % array.columns * array.rows + at / array.columns];
  }
  return by_row;
}

LoadedSoup read_gifti(std::string_view bytes, const std::string& file, const Progress& progress) {
  GiftiFile gifti(bytes, file, progress);
  LoadedSoup result;
  result.warnings = gifti.warnings();
  const std::optional<std::size_t> points = gifti::find_array(gifti, gifti::kPoints, result.warnings);
  const std::optional<std::size_t> triangles = gifti::find_array(gifti, gifti::kTriangles, result.warnings);
  if (!points && !triangles)
    fail_reading(file, "it is no surface: it has " + gifti::contents_of(gifti) +
                           " (vertex-scalar:file= reads values for vertices)");
  if (!points || !triangles)
    fail_reading(file, std::string("it has ") +
                           (points ? "points without triangles (NIFTI_INTENT_TRIANGLE)"
                                   : "triangles without points (NIFTI_INTENT_POINTSET)") +
                           "; a surface is read from one file with both");
  for (const std::size_t i : {*points, *triangles})
    if (gifti.arrays()[i].columns != 3)
      fail_reading(file, gifti.called(i) + " has " + std::to_string(gifti.arrays()[i].columns) +
                             " numbers a row, not three");
  if (std::max(gifti.arrays()[*points].rows, gifti.arrays()[*triangles].rows) >= (kNone - 1) / 3)
    fail_reading(file, "it has more vertices or triangles than can be numbered");

  const std::vector<double> coordinates = gifti.values(*points);
  auto& positions = result.soup.positions;
  positions.resize(coordinates.size() / 3);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (v % gifti::kPause == 0) progress.throw_if_cancelled();
    positions[v] = {coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]};
  }
  progress.update("reading the mesh", 0.5);
  const std::vector<double> corners = gifti.values(*triangles);
  const std::string what = "cannot read \"" + file + "\": " + gifti.called(*triangles) + ": ";
  result.soup.corners.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % gifti::kPause == 0) progress.throw_if_cancelled();
    result.soup.corners[i] = gifti::corner(corners[i], positions.size(), i / 3, what);
  }
  result.soup.offsets.resize(corners.size() / 3 + 1);
  for (std::size_t f = 0; f < result.soup.offsets.size(); ++f) result.soup.offsets[f] = 3 * f;
  gifti::add_properties(gifti, result);
  return result;
}

}  // namespace morsel::core
