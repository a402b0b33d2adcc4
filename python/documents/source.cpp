#include "morsel/python/documents/source.h"

#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/output_check.h"
#include "morsel/tools/report/request_words.h"

namespace morsel::python {
namespace {

constexpr const char* kInMemory = "(in memory)";

/// A mesh that has no file: the hash is of its positions and triangles.
tools::HashedFile in_memory(const core::TriangleMesh& mesh) {
  const auto bytes = [](const auto& row) {
    return std::string_view(reinterpret_cast<const char*>(row.data()), row.size_bytes());
  };
  return {kInMemory, tools::sha256_of(tools::sha256_of(bytes(mesh.positions())) +
                                      tools::sha256_of(bytes(mesh.triangles())))};
}

void write_mesh(const std::string& path, const core::LoadedMesh& loaded, bool has_values,
                const core::Progress& progress) {
  const std::string extension = core::file_extension(path);
  if (extension == ".ply") {
    core::write_ply(path, loaded.mesh, loaded.source.properties, {}, progress);
  } else if (extension == ".off" && !has_values) {
    core::write_off(path, loaded.mesh, {}, progress);
  } else {
    throw core::InvalidArgument(has_values
                                    ? "values are a property of the mesh's file, which .ply files hold, "
                                      "not " +
                                          path
                                    : "a mesh is written to .off or .ply, not to " + path);
  }
}

void check_unchanged(const MeshData& mesh) {
  std::error_code error;
  if (!std::filesystem::exists(mesh.file, error))
    throw core::BadInput(mesh.file + ", which the mesh was read from, is missing");
  if (last_change(mesh.file, error) != mesh.file_time || error)
    throw core::BadInput(mesh.path + " has changed since it was read");
}

/// Whether it can be made again.
bool is_document(const std::string& path) { return core::file_extension(path) == ".json"; }

}  // namespace

std::vector<core::Point> DocumentMesh::input_positions(const core::Progress& progress) const {
  if (loaded.source.numbering.from_input.empty())
    return {loaded.mesh.positions().begin(), loaded.mesh.positions().end()};
  if (!read_from.empty()) return core::read_polygon_soup(read_from, progress).soup.positions;
  std::vector<core::Point> positions(loaded.source.numbering.input_count, core::Point::Zero());
  for (core::Index v = 0; v < loaded.mesh.vertex_count(); ++v)
    positions[loaded.source.numbering.input_vertex(v)] = loaded.mesh.position(v);
  return positions;
}

void check_outputs(const DocumentPlace& place, const std::string& mesh,
                   const std::vector<std::string>& read) {
  tools::RunFiles files;
  files.reads_mesh_file("the mesh", mesh).writes("mesh =", place.mesh_file.value_or(""));
  for (const std::string& file : read) files.reads("a file of the field,", file);
  place.is_no_mesh ? files.writes_no_mesh("path =", place.path) : files.writes("path =", place.path);
  files.check();
}

std::vector<std::string> files_of(const tools::FieldOutcome& field) {
  std::vector<std::string> paths;
  paths.reserve(field.files.size());
  for (const core::FileParameter& file : field.files) paths.push_back(file.path);
  return paths;
}

std::vector<std::string> paths_of(const std::vector<tools::HashedFile>& files) {
  std::vector<std::string> paths;
  paths.reserve(files.size());
  for (const tools::HashedFile& file : files) paths.push_back(file.path);
  return paths;
}

DocumentMesh document_mesh(const StudyInput& input, const DocumentPlace& place,
                           const std::vector<std::string>& read, const core::Progress& progress) {
  const MeshData& mesh = *input.mesh;
  const bool has_values = input.values != nullptr;
  check_outputs(place, mesh.file, read);
  if (place.mesh_file) {
    core::LoadedMesh loaded = has_values ? mesh_with_values(*input.values) : in_own_numbers(mesh.loaded);
    write_mesh(*place.mesh_file, loaded, has_values, progress);
    return {
        std::move(loaded), {*place.mesh_file, tools::sha256_of_file(*place.mesh_file)}, {}, *place.mesh_file};
  }
  if (!mesh.path.empty() && !has_values) {
    check_unchanged(mesh);
    return {mesh.loaded,
            {mesh.path, tools::sha256_of(tools::MeshOrigin{mesh.file}, mesh.build)},
            mesh.build,
            mesh.file};
  }
  if (place.mesh_must_be_file)
    throw core::InvalidArgument(
        has_values
            ? "the report's field is of given values, which are in no file: name one for mesh and values "
              "(mesh=\"mesh.ply\")"
            : "the report's mesh is in no file: name one that it is written to (mesh=\"mesh.off\")");
  return {has_values ? mesh_with_values(*input.values) : mesh.loaded, in_memory(mesh.mesh()), mesh.build, {}};
}

DocumentField::DocumentField(const FieldHandle& field, const DocumentPlace& place,
                             const tools::Registry& registry, const core::Progress& progress)
    : mesh_(document_mesh(study_input(field), place, files_of(*field->story.input), progress)),
      made_(is_document(place.path) ? documented(*field, registry) : documented(*field)),
      is_request_(field->story.is_request) {}

tools::Provenance DocumentField::provenance(const std::string& command, const std::vector<std::string>& words,
                                            const tools::Json& json) const {
  if (!is_request_) return {"", tools::Json::object(), source()};
  std::vector<std::string> all = tools::words_of(request(), mesh_.build);
  tools::add_words(all, words);
  return {command_of(command, mesh_, all), json, source()};
}

std::string command_of(const std::string& command, const DocumentMesh& mesh,
                       const std::vector<std::string>& words) {
  std::vector<std::string> line = {"morsel", command, mesh.file.path};
  tools::add_words(line, words);
  return tools::command_line(line);
}

void write_document(const std::string& path, const std::function<void(tools::JsonSink&)>& write) {
  core::FileWriter file(path);
  tools::JsonStream json(file.stream());
  write(json);
  file.commit();
}

}  // namespace morsel::python
