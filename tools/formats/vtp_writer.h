#pragma once
/// Surfaces and lines for ParaView: VTK's XML PolyData format (.vtp).

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/types.h"

namespace morsel::tools {

/// A named array of a .vtp file; refers to the caller's data, which must outlive it. Whole
/// numbers take 32 bits where all of them fit.
struct VtpArray {
  std::string name;
  const char* type;  ///< VTK's name: "Float64", "UInt8", "Int32", "Int64", …
  int components = 1;
  std::uint64_t bytes = 0;
  std::vector<std::span<const std::byte>> pieces;  ///< one after the other; empty if `value` makes the array
  std::function<std::int64_t(std::size_t)> value;

  VtpArray(std::string array_name, std::span<const double> values);
  VtpArray(std::string array_name, std::span<const std::uint8_t> values);
  VtpArray(std::string array_name, std::span<const std::int32_t> values);
  /// Numbers below `bound`, or kNone, which is −1 in the file.
  VtpArray(std::string array_name, std::span<const core::Index> values, std::uint64_t bound);
  /// Points from several places, in this order.
  VtpArray(std::string array_name, const std::vector<std::span<const core::Point>>& points);
  /// Numbers that are computed as they are written: value(i) for i < count, all of them below `bound`.
  VtpArray(std::string array_name, std::size_t count, std::uint64_t bound,
           std::function<std::int64_t(std::size_t)> value);
};

/// Cells as VTK stores them: cell i has the points connectivity[offsets[i − 1]] … connectivity[offsets[i] −
/// 1].
struct VtpCells {
  std::size_t count;
  VtpArray connectivity;
  VtpArray offsets;

  VtpCells() : VtpCells(0, 0, {}) {}
  /// Cell i has the points first_point + end(i − 1) … first_point + end(i) − 1, consecutive; end(−1) is 0.
  VtpCells(std::size_t cells, std::size_t first_point, const std::function<std::int64_t(std::size_t)>& end);
  /// Triangles on `points` points; refers to them.
  VtpCells(std::span<const core::Triangle> triangles, std::size_t points);
};

/// A whole file. Cell arrays hold the vertices' cells first, then the lines', then the polygons'.
struct VtpDocument {
  std::vector<std::span<const core::Point>> points;
  VtpCells vertices;
  VtpCells lines;
  VtpCells polygons;
  std::vector<VtpArray> point_arrays;
  std::vector<VtpArray> cell_arrays;
  std::string provenance;  ///< the field array of that name, one string; none if it is empty
};

/// Writes binary data within the XML (base64), of which a small part at a time is in memory; the file is
/// whole or not there at all. Throws WriteFailed.
void write_vtp(const core::FileTarget& target, const VtpDocument& document,
               core::Sync sync = core::Sync::when_replacing);

}  // namespace morsel::tools
