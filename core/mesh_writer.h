#pragma once
/// Writing meshes to files: OFF and PLY; read_mesh() gets the same mesh back, bit for bit. Quads: OBJ.

#include <array>
#include <filesystem>
#include <span>

#include "morsel/core/mesh.h"
#include "morsel/core/mesh_io.h"
#include "morsel/core/progress.h"

namespace morsel::core {

/// Text, with as many digits as reading back the same doubles takes. The file is written whole or not at all
/// (file_writer.h). Throws WriteFailed.
void write_off(const std::filesystem::path& path, const TriangleMesh& mesh, const Progress& progress = {});

/// Binary, little-endian, in double precision, with one property per vertex for each of `properties` (values
/// by vertex of the mesh; NaN is allowed). The file is written whole or not at all (file_writer.h). Throws
/// WriteFailed; InvalidArgument if a property has not one value per vertex or a name that PLY cannot hold
/// (empty, with blanks or control characters, x, y, z, or one used before).
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
               std::span<const VertexProperty> properties = {}, const Progress& progress = {});

/// The same for vertices and triangles that are no TriangleMesh, such as an input's with unused vertices.
void write_ply(const std::filesystem::path& path, std::span<const Point> positions,
               std::span<const Triangle> triangles, std::span<const VertexProperty> properties = {},
               const Progress& progress = {});

/// Quads as Wavefront OBJ, text with as many digits as reading back the same doubles takes. The file is written whole or
/// not at all (file_writer.h). Throws WriteFailed.
void write_obj(const std::filesystem::path& path, std::span<const Point> positions,
               std::span<const std::array<Index, 4>> quads, const Progress& progress = {});

}  // namespace morsel::core
