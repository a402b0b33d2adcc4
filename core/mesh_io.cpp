#include "morsel/core/mesh_io.h"

#include <utility>

#include "morsel/core/file_bytes.h"
#include "morsel/core/file_extension.h"
#include "morsel/core/mesh_formats.h"
#include "morsel/core/text_scanner.h"

namespace morsel::core {
MeshFormat mesh_format(const std::filesystem::path& path) {
  const std::string extension = file_extension(path);
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  fail_reading(path.string(), extension.empty()
                                  ? "its name has no extension: use .off, .obj, .ply or .stl"
                                  : "meshes are read from .off, .obj, .ply and .stl files, not " + extension);
}

LoadedSoup parse_polygon_soup(std::string_view bytes, MeshFormat format, const std::string& name,
                              const Progress& progress) {
  progress.update("reading the mesh", 0);
  switch (format) {
    case MeshFormat::off:
      return read_off(bytes, name, progress);
    case MeshFormat::obj:
      return read_obj(bytes, name, progress);
    case MeshFormat::ply:
      return read_ply(bytes, name, progress);
    case MeshFormat::stl:
      return read_stl(bytes, name, progress);
  }
  throw InvalidArgument("unknown mesh format " + std::to_string(static_cast<int>(format)));
}

LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress) {
  const std::string name = path.string();
  // A missing file is reported as such, whatever its extension.
  const FileBytes bytes(path, name);
  return parse_polygon_soup(bytes.view(), mesh_format(path), name, progress);
}

namespace {

/// Whatever is wrong names the file.
LoadedMesh build(const std::filesystem::path& path, LoadedSoup file, const BuildOptions& options,
                 const Progress& progress) {
  try {
    BuiltMesh built = build_mesh(std::move(file.soup), options, progress);
    return {std::move(built.mesh),
            {std::move(built.numbering), std::move(file.properties), std::move(built.repairs)}};
  } catch (const MeshError& error) {
    throw error.about("\"" + path.string() + "\"");
  } catch (const BadInput& error) {
    throw BadInput("cannot use \"" + path.string() + "\": " + error.what());
  }
}

}  // namespace

LoadedMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options,
                     const Progress& progress) {
  return build(path, read_polygon_soup(path, progress), options, progress);
}

WholeMesh read_whole_mesh(const std::filesystem::path& path, const BuildOptions& options,
                          const Progress& progress) {
  LoadedSoup file = read_polygon_soup(path, progress);
  std::vector<Point> positions = file.soup.positions;
  return {build(path, std::move(file), options, progress), std::move(positions)};
}

}  // namespace morsel::core
