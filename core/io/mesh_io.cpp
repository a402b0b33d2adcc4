#include "morsel/core/io/mesh_io.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/geotiff.h"
#include "morsel/core/io/gltf.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

struct Format {
  std::string_view extension;
  MeshFormat format;
  LoadedSoup (*read)(std::string_view bytes, const std::string& file, const Progress& progress);
};
constexpr auto kFormats = std::to_array<Format>({{".off", MeshFormat::off, read_off},
                                                 {".obj", MeshFormat::obj, read_obj},
                                                 {".ply", MeshFormat::ply, read_ply},
                                                 {".stl", MeshFormat::stl, read_stl},
                                                 {".gltf", MeshFormat::gltf, read_gltf},
                                                 {".glb", MeshFormat::gltf, read_gltf},
                                                 {".asc", MeshFormat::asc, read_asc},
                                                 {".tif", MeshFormat::geotiff, read_geotiff},
                                                 {".tiff", MeshFormat::geotiff, read_geotiff}});

const Format* find_format(const std::filesystem::path& path) {
  const auto* found = std::ranges::find(kFormats, file_extension(path), &Format::extension);
  return found == kFormats.end() ? nullptr : found;
}

}  // namespace

bool has_mesh_extension(const std::filesystem::path& path) { return find_format(path) != nullptr; }

std::string mesh_extensions(std::string_view last) {
  std::vector<std::string> names(kFormats.size());
  std::ranges::transform(kFormats, names.begin(), &Format::extension);
  return listed(names, last);
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  if (const Format* found = find_format(path)) return found->format;
  const std::string extension = file_extension(path);
  fail_reading(path.string(), extension.empty() ? "its name has no extension: use " + mesh_extensions()
                                                : "meshes are read from " + mesh_extensions(" and ") +
                                                      " files, not " + extension);
}

LoadedSoup parse_polygon_soup(std::string_view bytes, MeshFormat format, const std::string& name,
                              const Progress& progress) {
  const auto* found = std::ranges::find(kFormats, format, &Format::format);
  if (found == kFormats.end())
    throw InvalidArgument("unknown mesh format " + std::to_string(static_cast<int>(format)));
  progress.update("reading the mesh", 0);
  return found->read(bytes, name, progress);
}

LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress) {
  const std::string name = path.string();
  // A missing file is reported as such, whatever its extension.
  const FileBytes bytes(path, name);
  const MeshFormat format = mesh_format(path);
  if (format == MeshFormat::gltf) {  // which may name other files beside it
    progress.update("reading the mesh", 0);
    return read_gltf(bytes.view(), name, progress, path.parent_path());
  }
  return parse_polygon_soup(bytes.view(), format, name, progress);
}

namespace {

/// build_mesh(), with the file named in its errors.
LoadedMesh build(const std::filesystem::path& path, LoadedSoup file, const BuildOptions& options,
                 const Progress& progress) {
  try {
    BuiltMesh built = build_mesh(std::move(file.soup), options, progress);
    return {std::move(built.mesh),
            {std::move(built.numbering), std::move(file.properties), std::move(built.repairs),
             std::move(file.warnings)}};
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
