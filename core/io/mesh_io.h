#pragma once
/// Reading meshes from files, in the formats that MeshFormat lists.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// A scalar that the file gives for each of its vertices, such as a PLY property, by input vertex; or for
/// each of its faces.
struct VertexProperty {
  std::string name;
  std::vector<double> values;
};

/// What the mesh's file has besides the mesh.
struct MeshSource {
  VertexNumbering numbering;
  std::vector<VertexProperty> properties;  ///< those of the vertices, then means of those of the faces
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

enum class MeshFormat { off, obj, ply, stl, gltf, vtk, vtp, vtu, gifti, freesurfer, asc, geotiff };

/// By the file's extension, any case; of a compressed file's name (.gz, .xz, .zst) by the one before. Throws
/// BadInput, listing the known ones, if it is another one. FreeSurfer's surfaces have no extension: they go
/// by names such as lh.white and rh.sphere.reg.
MeshFormat mesh_format(const std::filesystem::path& path);
/// Whether mesh_format() knows the name, and it is not that of a GIFTI file with values alone (.shape.gii).
bool has_mesh_extension(const std::filesystem::path& path);
/// The format of a file whose extension is no known one, by its first bytes: FreeSurfer's surfaces. None if
/// it is no such file or cannot be read.
std::optional<MeshFormat> recognised_format(const std::filesystem::path& path);
/// The extensions as a sentence lists them: ".off, .obj or .ply".
std::string mesh_extensions(std::string_view last = " or ");
/// The formats by name: "off", … ; and the one of a name. Throws InvalidArgument, listing them, if there is
/// none.
std::vector<std::string> mesh_format_names();
MeshFormat mesh_format_named(std::string_view name);

/// Reads the polygons of a file, whose format is that of its name or recognised_format(), in double
/// precision. gzip, xz and
/// zstd data are decompressed, whatever the file's name; UTF-16 text with a byte-order mark is converted.
/// What was odd in a file whose content is complete is said in the result's warnings. Corners are checked to
/// name vertices that exist; coordinates may be non-finite. Throws BadInput, naming the file and where
/// possible the line, if it is missing, unreadable, damaged or of another kind. Memory: the file's size and
/// twice the soup's; wrong counts in a header do not increase it. Independent of locales; about 200 MB of
/// text a second and thread (OFF and OBJ are read in parallel), and 500 MB of binary PLY.
LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress = {});
/// The same of a file of this format, whatever its name.
LoadedSoup read_polygon_soup(const std::filesystem::path& path, MeshFormat format,
                             const Progress& progress = {});

/// The same for a file that is in memory; errors call it `name`.
LoadedSoup parse_polygon_soup(std::string_view bytes, MeshFormat format, const std::string& name,
                              const Progress& progress = {});

/// The files beside a mesh's file that its content names and that are read with it: the buffers of glTF
/// files, each once and by name, whether they exist or not. None of other formats, and of files that cannot
/// be read: reading them as meshes says why. Without `format`, that of the file's name.
std::vector<std::filesystem::path> companion_files(const std::filesystem::path& path,
                                                   std::optional<MeshFormat> format = {});

/// read_polygon_soup() and make_mesh(). A MeshError names the file.
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

/// The second half of read_mesh(): build_mesh() of a file that was read; errors call it `name`. Properties of
/// faces become properties of vertices: the mean over the faces at each, weighted by their areas, called as
/// the property or, if the vertices have one of that name, "face:" and the name. Reads the values of
/// BuildOptions::mask and BuildOptions::needed, and warns of how many vertices they leave out and why: values
/// that are needed and cannot be had leave none out, and the field that needs them says why. Throws BadInput
/// if the mask cannot be read or has not one value for each vertex. Warns where joined vertices
/// (BuildOptions::weld) have different values, of which the first vertex's is taken, and where vertices
/// coincide that are not joined.
LoadedMesh make_mesh(LoadedSoup file, const std::string& name, const BuildOptions& options = {},
                     const Progress& progress = {});
/// Likewise of read_whole_mesh().
WholeMesh make_whole_mesh(LoadedSoup file, const std::string& name, const BuildOptions& options = {},
                          const Progress& progress = {});

}  // namespace morsel::core
