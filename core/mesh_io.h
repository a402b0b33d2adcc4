#pragma once
/// Reading meshes from files: OFF, OBJ, PLY and STL.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/core/mesh_builder.h"
#include "morsel/core/progress.h"

namespace morsel::core {

/// A scalar that the file gives for each of its vertices (a PLY property), by input vertex.
struct VertexProperty {
  std::string name;
  std::vector<double> values;
};

/// What the mesh's file said besides the mesh.
struct MeshSource {
  VertexNumbering numbering;
  std::vector<VertexProperty> properties;
  std::vector<Repair> repairs;
};

struct LoadedMesh {
  TriangleMesh mesh;
  MeshSource source;
};

/// A file's polygons and vertex properties before any rule of the mesh is checked.
struct LoadedSoup {
  PolygonSoup soup;
  std::vector<VertexProperty> properties;
};

/// Reads the polygons of an .off, .obj, .ply or .stl file (by extension, any case). Throws BadInput if the
/// file is missing, unreadable, damaged or of another kind.
LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress = {});

/// read_polygon_soup() and build_mesh().
LoadedMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options = {},
                     const Progress& progress = {});

}  // namespace morsel::core
