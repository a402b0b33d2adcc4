#include "morsel/tools/formats/vtp_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <utility>

#include "morsel/core/parallel/stop.h"
#include "morsel/tools/formats/base64.h"
#include "morsel/tools/formats/markup.h"

namespace morsel::tools {

static_assert(sizeof(core::Point) == 3 * sizeof(double) && sizeof(core::Triangle) == 3 * sizeof(core::Index),
              "points and triangles are written as they lie in memory");

namespace {

constexpr std::uint64_t kInt32Bound = std::uint64_t{1} << 31;

/// The number of points of cells whose points are consecutive.
std::size_t points_in(std::size_t cells, const std::function<std::int64_t(std::size_t)>& end) {
  return cells == 0 ? 0 : static_cast<std::size_t>(end(cells - 1));
}

}  // namespace

VtpArray::VtpArray(std::string array_name, std::span<const double> values)
    : name(std::move(array_name)),
      type("Float64"),
      bytes(values.size_bytes()),
      pieces{std::as_bytes(values)} {}

VtpArray::VtpArray(std::string array_name, std::span<const std::uint8_t> values)
    : name(std::move(array_name)), type("UInt8"), bytes(values.size_bytes()), pieces{std::as_bytes(values)} {}

VtpArray::VtpArray(std::string array_name, std::span<const std::int32_t> values)
    : name(std::move(array_name)), type("Int32"), bytes(values.size_bytes()), pieces{std::as_bytes(values)} {}

VtpArray::VtpArray(std::string array_name, std::span<const core::Index> values, std::uint64_t bound)
    : name(std::move(array_name)),
      type(bound <= kInt32Bound ? "Int32" : "UInt32"),
      bytes(values.size_bytes()),
      pieces{std::as_bytes(values)} {}

VtpArray::VtpArray(std::string array_name, const std::vector<std::span<const core::Point>>& points)
    : name(std::move(array_name)), type("Float64"), components(3) {
  for (const std::span<const core::Point> piece : points) {
    pieces.push_back(std::as_bytes(piece));
    bytes += piece.size_bytes();
  }
}

VtpArray::VtpArray(std::string array_name, std::size_t count, std::uint64_t bound,
                   std::function<std::int64_t(std::size_t)> value_of)
    : name(std::move(array_name)),
      type(bound <= kInt32Bound ? "Int32" : "Int64"),
      bytes(count * (bound <= kInt32Bound ? sizeof(std::int32_t) : sizeof(std::int64_t))),
      value(std::move(value_of)) {}

VtpCells::VtpCells(std::size_t cells, std::size_t first_point,
                   const std::function<std::int64_t(std::size_t)>& end)
    : count(cells),
      connectivity("connectivity", points_in(cells, end), first_point + points_in(cells, end),
                   [first_point](std::size_t i) { return static_cast<std::int64_t>(first_point + i); }),
      offsets("offsets", cells, points_in(cells, end) + 1, end) {}

VtpCells::VtpCells(std::span<const core::Triangle> triangles, std::size_t points)
    : count(triangles.size()),
      connectivity("connectivity",
                   triangles.empty() ? std::span<const core::Index>()
                                     : std::span(triangles.front().data(), 3 * triangles.size()),
                   points),
      offsets("offsets", count, 3 * count + 1,
              [](std::size_t i) { return static_cast<std::int64_t>(3 * i + 3); }) {}

namespace {

/// Writes the arrays into the XML itself, as base64: ParaView 5.11 refuses raw appended data.
class VtpWriter {
 public:
  VtpWriter(const core::FileTarget& target, const VtpDocument& document, core::Sync sync)
      : file_(target, sync), document_(document) {}

  void write() {
    const auto count = [](const VtpCells& cells) { return std::to_string(cells.count); };
    const VtpArray points("Points", document_.points);
    file_.write(R"(<?xml version="1.0"?>)"
                "\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"");
    file_.write(std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    file_.write("\" header_type=\"UInt64\">\n<PolyData>\n");
    field_data();
    file_.write("<Piece NumberOfPoints=\"" + std::to_string(points.bytes / sizeof(core::Point)) +
                "\" NumberOfVerts=\"" + count(document_.vertices) + "\" NumberOfLines=\"" +
                count(document_.lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
                count(document_.polygons) + "\">\n");
    section("PointData", document_.point_arrays);
    section("CellData", document_.cell_arrays);
    section("Points", {points});
    cells("Verts", document_.vertices);
    cells("Lines", document_.lines);
    cells("Polys", document_.polygons);
    file_.write("</Piece>\n</PolyData>\n</VTKFile>\n");
    file_.commit();
  }

 private:
  void field_data() {
    if (document_.provenance.empty()) return;
    const std::span text(document_.provenance.c_str(), document_.provenance.size() + 1);  // ended by a zero
    VtpArray array("provenance", std::span<const std::uint8_t>());
    array.bytes = text.size();
    array.pieces = {std::as_bytes(text)};
    file_.write(
        "<FieldData>\n<Array type=\"String\" Name=\"provenance\" NumberOfTuples=\"1\" "
        "format=\"binary\">\n");
    contents(array);
    file_.write("</Array>\n</FieldData>\n");
  }

  void section(const std::string& name, const std::vector<VtpArray>& arrays) {
    file_.write("<" + name + ">\n");
    for (const VtpArray& array : arrays) {
      file_.write("<DataArray type=\"" + std::string(array.type) + "\" Name=\"" + markup_text(array.name) +
                  "\" NumberOfComponents=\"" + std::to_string(array.components) + "\" format=\"binary\">\n");
      contents(array);
      file_.write("</DataArray>\n");
    }
    file_.write("</" + name + ">\n");
  }

  void cells(const std::string& name, const VtpCells& cells) {
    section(name, {cells.connectivity, cells.offsets});
  }

  /// The number of bytes and the bytes, one run of base64.
  void contents(const VtpArray& array) {
    const std::uint64_t bytes = array.bytes;
    encode(std::as_bytes(std::span(&bytes, 1)));
    for (const std::span<const std::byte> piece : array.pieces) {
      constexpr std::size_t kPart = std::size_t{3} << 16;
      for (std::size_t first = 0; first < piece.size(); first += kPart)
        encode(piece.subspan(first, std::min(kPart, piece.size() - first)));
    }
    if (array.value && array.type == std::string_view("Int32")) write_values<std::int32_t>(array);
    if (array.value && array.type == std::string_view("Int64")) write_values<std::int64_t>(array);
    encoder_.finish(text_);
    text_ += '\n';
    flush();
  }

  void encode(std::span<const std::byte> bytes) {
    core::throw_if_stopped();
    encoder_.encode(bytes, text_);
    flush();
  }

  void flush() {
    file_.write(text_);
    text_.clear();
  }

  template <class Int>
  void write_values(const VtpArray& array) {
    std::array<Int, 4096> buffer;
    const std::size_t count = array.bytes / sizeof(Int);
    for (std::size_t first = 0; first < count; first += buffer.size()) {
      const std::size_t some = std::min(buffer.size(), count - first);
      for (std::size_t i = 0; i < some; ++i) buffer[i] = static_cast<Int>(array.value(first + i));
      encode(std::as_bytes(std::span(buffer.data(), some)));
    }
  }

  core::FileWriter file_;
  const VtpDocument& document_;
  Base64Encoder encoder_;
  std::string text_;
};

}  // namespace

void write_vtp(const core::FileTarget& target, const VtpDocument& document, core::Sync sync) {
  VtpWriter(target, document, sync).write();
}

}  // namespace morsel::tools
