#include "morsel/core/io/mesh_io.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "morsel/core/io/face_values.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/numbers.h"
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
                                                 {".stl", MeshFormat::stl, read_stl}});

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
  return parse_polygon_soup(bytes.view(), mesh_format(path), name, progress);
}

namespace {

/// Per vertex of the input the one whose place it takes in the mesh; itself where it does not.
std::vector<Index> representatives(const VertexNumbering& numbering) {
  std::vector<Index> result(numbering.input_count);
  for (Index v = 0; v < result.size(); ++v) {
    const Index at = numbering.mesh_vertex(v);
    result[v] = at == kNone ? v : numbering.input_vertex(at);
  }
  return result;
}

/// Joined vertices should have had the same values. Empty if they had.
std::string difference_warning(const MeshSource& source) {
  std::vector<std::string> differences;
  for (const VertexProperty& property : source.properties)
    if (const JoinedDifference d = compare_joined(source.numbering, property.values); d.count > 0)
      differences.push_back(shown(property.name) + " at " + grouped(d.count) + " (by up to " +
                            shortest(d.largest) + ")");
  if (differences.empty()) return {};
  return "joined vertices have different values of " + listed(differences, " and ") +
         "; that of the first vertex is taken";
}

}  // namespace

LoadedMesh make_mesh(LoadedSoup file, const BuildOptions& options, const std::string& name,
                     const Progress& progress) {
  try {
    LoadedSoup faces;  // what face properties need of the file
    if (!file.face_properties.empty()) faces = {file.soup, file.properties, std::move(file.face_properties)};
    BuiltMesh built = build_mesh(std::move(file.soup), options, progress);
    LoadedMesh loaded{std::move(built.mesh),
                      {std::move(built.numbering), std::move(file.properties), std::move(built.repairs),
                       std::move(file.warnings)}};
    MeshSource& source = loaded.source;
    const auto warn = [&](std::string text) {
      if (!text.empty()) source.warnings.push_back(std::move(text));
    };
    for (std::string& text : built.warnings) warn(std::move(text));
    warn(difference_warning(source));
    for (VertexProperty& made : face_values_at_vertices(faces, representatives(source.numbering)))
      source.properties.push_back(std::move(made));
    warn(unwelded_warning(loaded.mesh, source.numbering));
    return loaded;
  } catch (const MeshError& error) {
    throw error.about("\"" + name + "\"");
  } catch (const BadInput& error) {
    throw BadInput("cannot use \"" + name + "\": " + error.what());
  }
}

LoadedMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options,
                     const Progress& progress) {
  return make_mesh(read_polygon_soup(path, progress), options, path.string(), progress);
}

WholeMesh read_whole_mesh(const std::filesystem::path& path, const BuildOptions& options,
                          const Progress& progress) {
  LoadedSoup file = read_polygon_soup(path, progress);
  std::vector<Point> positions = file.soup.positions;
  return {make_mesh(std::move(file), options, path.string(), progress), std::move(positions)};
}

}  // namespace morsel::core
