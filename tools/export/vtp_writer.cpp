#include "morsel/tools/export/vtp_writer.h"

#include <bit>

#include "morsel/core/file_writer.h"

namespace morsel::tools {

static_assert(sizeof(core::Point) == 3 * sizeof(double), "points are written as they lie in memory");

VtpArray::VtpArray(std::string array_name, std::span<const double> values)
    : name(std::move(array_name)), type("Float64"), data(values.data()), bytes(values.size_bytes()) {}
VtpArray::VtpArray(std::string array_name, std::span<const std::int32_t> values)
    : name(std::move(array_name)), type("Int32"), data(values.data()), bytes(values.size_bytes()) {}
VtpArray::VtpArray(std::string array_name, std::span<const std::int64_t> values)
    : name(std::move(array_name)), type("Int64"), data(values.data()), bytes(values.size_bytes()) {}
VtpArray::VtpArray(std::string array_name, std::span<const std::uint8_t> values)
    : name(std::move(array_name)), type("UInt8"), data(values.data()), bytes(values.size_bytes()) {}
VtpArray::VtpArray(std::string array_name, std::span<const core::Point> points)
    : name(std::move(array_name)),
      type("Float64"),
      data(points.data()),
      bytes(points.size_bytes()),
      components(3) {}

void VtpCells::add(std::span<const std::int64_t> points) {
  connectivity.insert(connectivity.end(), points.begin(), points.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
}

VtpCells triangle_cells(std::span<const core::Triangle> triangles) {
  VtpCells cells;
  cells.connectivity.reserve(3 * triangles.size());
  cells.offsets.reserve(triangles.size());
  for (const core::Triangle& t : triangles) cells.add(std::array<std::int64_t, 3>{t[0], t[1], t[2]});
  return cells;
}

namespace {

/// Writes the XML head with each array's place in the appended block, then the block itself.
class VtpWriter {
 public:
  VtpWriter(const std::filesystem::path& path, const VtpDocument& document)
      : file_(path), document_(document) {}

  void write() {
    const auto count = [](const VtpCells& cells) { return std::to_string(cells.offsets.size()); };
    file_.write(R"(<?xml version="1.0"?>)"
                "\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"");
    file_.write(std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    file_.write("\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
                std::to_string(document_.points.size()) + "\" NumberOfVerts=\"" + count(document_.vertices) +
                "\" NumberOfLines=\"" + count(document_.lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
                count(document_.polygons) + "\">\n");
    section("PointData", document_.point_arrays);
    section("CellData", document_.cell_arrays);
    section("Points", {VtpArray("Points", document_.points)});
    cells("Verts", document_.vertices);
    cells("Lines", document_.lines);
    cells("Polys", document_.polygons);
    file_.write("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    for (const VtpArray& array : appended_) {
      const std::uint64_t bytes = array.bytes;
      file_.write_bytes(&bytes, sizeof bytes);
      file_.write_bytes(array.data, array.bytes);
    }
    file_.write("\n</AppendedData>\n</VTKFile>\n");
    file_.commit();
  }

 private:
  void section(const std::string& name, const std::vector<VtpArray>& arrays) {
    file_.write("<" + name + ">\n");
    for (const VtpArray& array : arrays) {
      file_.write("<DataArray type=\"" + std::string(array.type) + "\" Name=\"" + array.name +
                  "\" NumberOfComponents=\"" + std::to_string(array.components) +
                  "\" format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n");
      offset_ += sizeof(std::uint64_t) + array.bytes;
      appended_.push_back(array);
    }
    file_.write("</" + name + ">\n");
  }

  void cells(const std::string& name, const VtpCells& cells) {
    section(name, {VtpArray("connectivity", std::span<const std::int64_t>(cells.connectivity)),
                   VtpArray("offsets", std::span<const std::int64_t>(cells.offsets))});
  }

  core::FileWriter file_;
  const VtpDocument& document_;
  std::vector<VtpArray> appended_;
  std::uint64_t offset_ = 0;
};

}  // namespace

void write_vtp(const std::filesystem::path& path, const VtpDocument& document) {
  VtpWriter(path, document).write();
}

}  // namespace morsel::tools
