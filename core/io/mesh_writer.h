#pragma once
/// Writing meshes to files: OFF and PLY; read_mesh() gets the same mesh back, bit for bit. Quads: OBJ.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// Lines that a file has at its head and that readers pass over, such as where it comes from: "# …" in OFF
/// and OBJ files, "comment …" in PLY files. All writers here throw InvalidArgument if one has a control
/// character, such as a line's end, or ends in a backslash, which would join it to the next line of an OBJ
/// file. Some programs take no lines of more than 1,000 bytes.
using Comments = std::span<const std::string>;

/// Text, with as many digits as reading back the same doubles takes. The file is written whole or not at all
/// (file_writer.h). Throws WriteFailed.
void write_off(const FileTarget& target, const TriangleMesh& mesh, Comments comments = {},
               const Progress& progress = {});

/// A named array for a file's vertices or faces, one value for each; refers to the caller's data. Numbers
/// keep their type in the file (double, int or uchar).
struct PropertyView {
  std::string name;
  std::variant<std::span<const double>, std::span<const std::int32_t>, std::span<const std::uint8_t>> values;

  PropertyView(std::string property_name, std::span<const double> numbers)
      : name(std::move(property_name)), values(numbers) {}
  PropertyView(std::string property_name, std::span<const std::int32_t> numbers)
      : name(std::move(property_name)), values(numbers) {}
  PropertyView(std::string property_name, std::span<const std::uint8_t> numbers)
      : name(std::move(property_name)), values(numbers) {}
};

/// Binary, little-endian, in double precision, with one property per vertex for each of `properties` (values
/// by vertex of the mesh; NaN is allowed). The file is written whole or not at all (file_writer.h). Throws
/// WriteFailed; InvalidArgument if a property has not one value per vertex or a name that PLY cannot hold
/// (empty, with blanks or control characters, x, y, z, or one used before).
void write_ply(const FileTarget& target, const TriangleMesh& mesh,
               std::span<const VertexProperty> properties = {}, Comments comments = {},
               const Progress& progress = {});

/// The same for vertices and triangles that are no TriangleMesh, such as an input's with unused vertices, and
/// with properties of faces too (whose names may not be vertex_indices nor vertex_index).
void write_ply(const FileTarget& target, std::span<const Point> positions,
               std::span<const Triangle> triangles, std::span<const PropertyView> vertex_properties = {},
               std::span<const PropertyView> face_properties = {}, Comments comments = {},
               const Progress& progress = {});

/// Quads as Wavefront OBJ, text with as many digits as reading back the same doubles takes. The file is
/// written whole or not at all (file_writer.h). Throws WriteFailed.
void write_obj(const FileTarget& target, std::span<const Point> positions,
               std::span<const std::array<Index, 4>> quads, Comments comments = {},
               const Progress& progress = {});

}  // namespace morsel::core
