#include "morsel/core/io/mesh_io.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "morsel/core/io/face_values.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/io/freesurfer.h"
#include "morsel/core/io/geotiff.h"
#include "morsel/core/io/gltf.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/vertex_mask.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

struct Format {
  std::string_view extension;
  MeshFormat format;
  std::string_view kind;  ///< as file_kind() names it
  LoadedSoup (*read)(std::string_view bytes, const std::string& file, const Progress& progress);
};
/// FreeSurfer's files have no extension; in its place is what lists of extensions say of them.
constexpr std::string_view kFreeSurfer = "FreeSurfer's lh.pial";
constexpr auto kFormats =
    std::to_array<Format>({{".off", MeshFormat::off, "an OFF file", read_off},
                           {".obj", MeshFormat::obj, "an OBJ file", read_obj},
                           {".ply", MeshFormat::ply, "a PLY file", read_ply},
                           {".stl", MeshFormat::stl, "an ASCII STL file", read_stl},
                           {".gltf", MeshFormat::gltf, "a glTF file", read_gltf},
                           {".glb", MeshFormat::gltf, "a glTF file", read_gltf},
                           {".vtk", MeshFormat::vtk, "a legacy VTK file", read_vtk},
                           {".vtp", MeshFormat::vtp, "a VTK XML file", read_vtk_xml},
                           {".vtu", MeshFormat::vtu, "a VTK XML file", read_vtk_xml},
                           {".gii", MeshFormat::gifti, "a GIFTI file", read_gifti},
                           {kFreeSurfer, MeshFormat::freesurfer, "a FreeSurfer surface", read_freesurfer},
                           {".asc", MeshFormat::asc, "an ESRI ASCII grid", read_asc},
                           {".tif", MeshFormat::geotiff, "a TIFF picture", read_geotiff},
                           {".tiff", MeshFormat::geotiff, "a TIFF picture", read_geotiff}});

const Format* find_extension(std::string_view extension) {
  const auto* found = std::ranges::find(kFormats, extension, &Format::extension);
  return found == kFormats.end() ? nullptr : found;
}
/// As --format takes it.
std::string_view format_name(const Format& format) {
  return format.format == MeshFormat::freesurfer ? "freesurfer" : format.extension.substr(1);
}
/// The name without an extension of a compression.
std::filesystem::path content_name(const std::filesystem::path& path) {
  return content_extension(path) == file_extension(path) ? path.filename() : path.stem();
}
const Format* find_format(const std::filesystem::path& path) {
  if (const Format* found = find_extension(content_extension(path))) return found;
  return find_extension(is_named_like_freesurfer_surface(content_name(path)) ? kFreeSurfer : "");
}

/// Whether a GIFTI file has values for the vertices of another file, by the extensions of the standard.
bool has_extension_of_values(const std::filesystem::path& path) {
  constexpr auto kValues = std::to_array<std::string_view>(
      {".shape", ".func", ".label", ".time", ".rgba", ".tensor", ".vector", ".dset", ".coord", ".topo"});
  const std::filesystem::path name = content_name(path);
  return file_extension(name) == ".gii" &&
         std::ranges::find(kValues, file_extension(name.stem())) != kValues.end();
}

/// ": name it .obj or use --format obj" of a kind that is read, ": use --format obj" where the format was
/// given and the name does not count; "" of others.
std::string remedy_for(std::string_view kind, bool is_given = false) {
  const auto* format = std::ranges::find(kFormats, kind, &Format::kind);
  if (format == kFormats.end()) return "";
  return ": " + (is_given ? "" : "name it " + std::string(format->extension) + " or ") + "use --format " +
         std::string(format_name(*format));
}

/// Throws what the reader of `format` says of a file, with what the file is if that is another kind.
[[noreturn]] void fail_by_kind(std::string_view content, const Format& format, const std::string& name,
                               const BadInput& error) {
  const std::string_view kind = file_kind(content);
  // FreeSurfer's reader tells its values itself, whose mark old surfaces have, too.
  const bool is_freesurfer = format.format == MeshFormat::freesurfer && kind.starts_with("a FreeSurfer");
  const bool is_gltf = format.format == MeshFormat::gltf && kind == "JSON";
  if (kind.empty() || kind == format.kind || is_freesurfer || is_gltf) throw error;
  const Format* named = find_format(name);
  const bool is_given = named == nullptr || named->format != format.format;
  const std::string remedy = remedy_for(kind, is_given);
  std::string what = "it is " + std::string(kind) + ", though " +
                     (is_given ? "the format that was given is " + std::string(format_name(format))
                               : "read as " + std::string(format.extension));
  if (!remedy.empty()) {  // which a reader may know better
    const std::string head = "cannot read \"" + name + "\": ";
    const std::string text = error.what();
    what += " (" + (text.starts_with(head) ? text.substr(head.size()) : text) + ")" + remedy;
  }
  fail_reading(name, what);
}

/// Why a file's name does not say how to read it.
std::string unknown_extension(const std::filesystem::path& path) {
  const std::string extension = content_extension(path);
  return extension.empty() ? "its name has no extension: use " + mesh_extensions()
                           : "meshes are read from " + mesh_extensions(" and ") + " files, not " + extension;
}

}  // namespace

bool has_mesh_extension(const std::filesystem::path& path) {
  return find_format(path) != nullptr && !has_extension_of_values(path);
}

std::optional<MeshFormat> recognised_format(const std::filesystem::path& path) {
  if (find_format(path) != nullptr) return std::nullopt;
  try {
    const FileBytes bytes(path, path.string());
    if (is_freesurfer_surface(DecodedBytes(bytes.view(), path.string()).view()))
      return MeshFormat::freesurfer;
  } catch (const BadInput&) {  // reading it as a mesh says why
  }
  return std::nullopt;
}

std::string mesh_extensions(std::string_view last) {
  std::vector<std::string> names(kFormats.size());
  std::ranges::transform(kFormats, names.begin(), &Format::extension);
  return listed(names, last);
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  if (const Format* found = find_format(path)) return found->format;
  fail_reading(path.string(), unknown_extension(path));
}

std::vector<std::string> mesh_format_names() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format_name(format));
  return names;
}

MeshFormat mesh_format_named(std::string_view name) {
  const auto* found = std::ranges::find(kFormats, name, format_name);
  if (found != kFormats.end()) return found->format;
  throw InvalidArgument("there is no mesh format " + shown(name) + ", only " +
                        listed(mesh_format_names(), " and "));
}

namespace {

/// parse_polygon_soup() of a file in a folder, where glTF files may name others; without one, they may not.
LoadedSoup parse_in(const std::optional<std::filesystem::path>& folder, std::string_view bytes,
                    MeshFormat format, const std::string& name, const Progress& progress) {
  const auto* found = std::ranges::find(kFormats, format, &Format::format);
  if (found == kFormats.end())
    throw InvalidArgument("unknown mesh format " + std::to_string(static_cast<int>(format)));
  progress.update("reading the mesh", 0);
  const DecodedBytes decoded(bytes, name, progress);
  std::string_view content = decoded.view();
  std::string converted;
  const bool is_converted = is_utf16(content);
  if (is_converted) content = converted = utf8_of_utf16(content, name);
  try {
    LoadedSoup soup = format == MeshFormat::gltf && folder ? read_gltf(content, name, progress, *folder)
                                                           : found->read(content, name, progress);
    if (is_converted) soup.warnings.insert(soup.warnings.begin(), kUtf16Warning);
    return soup;
  } catch (const BadInput& error) {
    fail_by_kind(content, *found, name, error);
  }
}

}  // namespace

LoadedSoup parse_polygon_soup(std::string_view bytes, MeshFormat format, const std::string& name,
                              const Progress& progress) {
  return parse_in(std::nullopt, bytes, format, name, progress);
}

LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress) {
  const std::string name = path.string();
  // A missing file is reported as such, whatever its extension.
  const FileBytes bytes(path, name);
  if (const Format* format = find_format(path))
    return parse_in(path.parent_path(), bytes.view(), format->format, name, progress);
  const DecodedBytes decoded(bytes.view(), name, progress);
  if (is_freesurfer_surface(decoded.view()))
    return parse_polygon_soup(decoded.view(), MeshFormat::freesurfer, name, progress);
  const std::string_view kind = file_kind(decoded.view());
  fail_reading(name, unknown_extension(path) +
                         (kind.empty() ? "" : "; it is " + std::string(kind) + remedy_for(kind)));
}

LoadedSoup read_polygon_soup(const std::filesystem::path& path, MeshFormat format, const Progress& progress) {
  const std::string name = path.string();
  return parse_in(path.parent_path(), FileBytes(path, name).view(), format, name, progress);
}

std::vector<std::filesystem::path> companion_files(const std::filesystem::path& path,
                                                   std::optional<MeshFormat> format) {
  const Format* named = find_format(path);
  if (!format && named != nullptr) format = named->format;
  if (format != MeshFormat::gltf) return {};
  try {
    return gltf_companions(path);
  } catch (const BadInput&) {  // reading it as a mesh says why
    return {};
  }
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

LoadedMesh make_mesh(LoadedSoup file, const std::string& name, const BuildOptions& options,
                     const Progress& progress) {
  try {
    LoadedSoup faces;  // what face properties need of the file
    if (!file.face_properties.empty()) faces = {file.soup, file.properties, std::move(file.face_properties)};
    VertexMask mask = read_vertex_mask(file, options, progress);
    BuiltMesh built = build_mesh(std::move(file.soup), options, progress, mask.left_out);
    LoadedMesh loaded{std::move(built.mesh),
                      {std::move(built.numbering), std::move(file.properties), std::move(built.repairs),
                       std::move(file.warnings)}};
    MeshSource& source = loaded.source;
    const auto warn = [&](std::string text) {
      if (!text.empty()) source.warnings.push_back(std::move(text));
    };
    for (std::string& text : mask.warnings) warn(std::move(text));
    for (std::string& text : built.warnings) warn(std::move(text));
    warn(difference_warning(source));
    for (VertexProperty& made : face_values_at_vertices(faces, representatives(source.numbering)))
      source.properties.push_back(std::move(made));
    warn(unwelded_warning(loaded.mesh, source.numbering, progress));
    return loaded;
  } catch (const MeshError& error) {
    throw error.about("\"" + name + "\"");
  } catch (const BadInput& error) {
    throw BadInput("cannot use \"" + name + "\": " + error.what());
  }
}

WholeMesh make_whole_mesh(LoadedSoup file, const std::string& name, const BuildOptions& options,
                          const Progress& progress) {
  std::vector<Point> positions = file.soup.positions;
  return {make_mesh(std::move(file), name, options, progress), std::move(positions)};
}

LoadedMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options,
                     const Progress& progress) {
  return make_mesh(read_polygon_soup(path, progress), path.string(), options, progress);
}

WholeMesh read_whole_mesh(const std::filesystem::path& path, const BuildOptions& options,
                          const Progress& progress) {
  return make_whole_mesh(read_polygon_soup(path, progress), path.string(), options, progress);
}

}  // namespace morsel::core
