#pragma once
/// Surfaces and lines for ParaView: VTK's XML PolyData format (.vtp).

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::tools {

/// A named array of a .vtp file; refers to the caller's data, which must live until it is written.
struct VtpArray {
  std::string name;
  const char* type;  ///< VTK's name: "Float64", "Int32", "Int64", "UInt8"
  const void* data;
  std::size_t bytes;
  int components = 1;

  VtpArray(std::string array_name, std::span<const double> values);
  VtpArray(std::string array_name, std::span<const std::int32_t> values);
  VtpArray(std::string array_name, std::span<const std::int64_t> values);
  VtpArray(std::string array_name, std::span<const std::uint8_t> values);
  VtpArray(std::string array_name, std::span<const core::Point> points);
};

/// Cells as VTK stores them: cell i has the points connectivity[offsets[i − 1]] … connectivity[offsets[i] −
/// 1].
struct VtpCells {
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  void add(std::span<const std::int64_t> points);
};

/// A whole file. Cell arrays hold the vertices' cells first, then the lines', then the polygons'.
struct VtpDocument {
  std::span<const core::Point> points;
  VtpCells vertices;
  VtpCells lines;
  VtpCells polygons;
  std::vector<VtpArray> point_arrays;
  std::vector<VtpArray> cell_arrays;
};

/// Writes binary (raw appended) data, whole or not at all. Throws WriteFailed.
void write_vtp(const std::filesystem::path& path, const VtpDocument& document);

/// The polygon cells of a list of triangles.
VtpCells triangle_cells(std::span<const core::Triangle> triangles);

}  // namespace morsel::tools
