#pragma once
/// Reading meshes from files, in the formats that MeshFormat lists.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// A scalar that the file gives for each of its vertices, such as a PLY property, by input vertex; or for each
/// of its faces.
struct VertexProperty {
  std::string name;
  std::vector<double> values;
};

/// What the mesh's file has besides the mesh.
struct MeshSource {
  VertexNumbering numbering;
  std::vector<VertexProperty> properties;
  std::vector<Repair> repairs;
  std::vector<std::string> warnings = {};  ///< what was read tolerantly, guessed or left out, a sentence each
};

struct LoadedMesh {
  TriangleMesh mesh;
  MeshSource source;
};

/// A file's polygons and vertex properties before any rule of the mesh is checked. Vertices are numbered from
/// 0 in the order of the file; those of an STL file, which has none, in the order in which a position first
/// appears (equal positions are one vertex).
struct LoadedSoup {
  PolygonSoup soup;
  std::vector<VertexProperty> properties;            ///< in the file's order, without x, y, z
  std::vector<VertexProperty> face_properties = {};  ///< likewise, by polygon
  std::vector<std::string> warnings = {};            ///< what was read tolerantly, a sentence each
};

enum class MeshFormat { off, obj, ply, stl, gltf, asc, geotiff };

/// By the file's extension, any case. Throws BadInput, listing the known ones, if it is another one.
MeshFormat mesh_format(const std::filesystem::path& path);
/// Whether the extension is that of a known format.
bool has_mesh_extension(const std::filesystem::path& path);
/// The extensions as a sentence lists them: ".off, .obj or .ply".
std::string mesh_extensions(std::string_view last = " or ");

/// Reads the polygons of a file, whose format is that of its extension, in double precision.
/// Corners are checked to name vertices that exist; coordinates may be non-finite. Throws BadInput, naming
/// the file and where possible the line, if it is missing, unreadable, damaged or of another kind. Memory:
/// the file's size and twice the soup's; wrong counts in a header do not increase it. Independent of locales;
/// about 200 MB of text a second and thread (OFF and OBJ are read in parallel), and 500 MB of binary PLY.
LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress = {});

/// The same for a file that is in memory; errors call it `name`.
LoadedSoup parse_polygon_soup(std::string_view bytes, MeshFormat format, const std::string& name,
                              const Progress& progress = {});

/// read_polygon_soup() and build_mesh(). A MeshError names the file.
LoadedMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options = {},
                     const Progress& progress = {});

/// A mesh and the positions of all vertices of its file, those that repair dropped included.
struct WholeMesh {
  LoadedMesh loaded;
  std::vector<Point> input_positions;
};

/// read_mesh() for callers that write in the input's vertex numbers.
WholeMesh read_whole_mesh(const std::filesystem::path& path, const BuildOptions& options = {},
                          const Progress& progress = {});

}  // namespace morsel::core
