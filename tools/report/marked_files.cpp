#include "morsel/tools/report/marked_files.h"

#include <utility>

#include "morsel/core/io/file_bytes.h"
#include "morsel/tools/report/mesh_section.h"

namespace morsel::tools {

MarkedFiles::MarkedFiles(const std::filesystem::path& list, std::uint64_t first,
                         const core::BuildOptions& build)
    : folder_(list.parent_path()), first_(first), build_(build) {
  const core::FileBytes bytes(list, list.string());
  list_ = {list.string(), sha256_of(bytes.view())};
  for (MarkedPair& pair : parse_marked_pairs(bytes.view(), list_.path)) {
    const std::filesystem::path path = folder_ / pair.marks;
    const core::FileBytes vertices(path, path.string());
    std::vector<Mark> marks = parse_marks(vertices.view(), path.string());
    files_.push_back({std::move(pair), std::move(marks), sha256_of(vertices.view())});
  }
}

MarkedMesh MarkedFiles::load(std::size_t i, const core::Progress& progress) {
  File& file = files_[i];
  HashedMesh mesh = read_hashed_mesh(path_of(i), build_, progress);
  file.mesh = mesh_section(file.pair.mesh, mesh.sha256, mesh.loaded);
  MarkedVertices marked = find_marked_vertices(file.marks, first_, mesh.loaded, marks_path_of(i).string());
  return {std::move(mesh.loaded), std::move(marked.vertices), std::move(marked.warnings)};
}

Json MarkedFiles::section(std::size_t i) const {
  const File& file = files_[i];
  return {{"mesh", file.mesh}, {"marks", {{"path", file.pair.marks}, {"sha256", file.marks_sha256}}}};
}

std::vector<std::string> MarkedFiles::warnings(std::size_t i) const {
  const auto found = files_[i].mesh.find("warnings");
  return found == files_[i].mesh.end() ? std::vector<std::string>() : found->get<std::vector<std::string>>();
}

void MarkedFiles::set_mesh(std::size_t i, Json section) {
  section["path"] = files_[i].pair.mesh;
  files_[i].mesh = std::move(section);
}

std::vector<HashedFile> MarkedFiles::inputs() const {
  std::vector<HashedFile> inputs = {list_};
  for (const File& file : files_) {
    inputs.push_back({file.pair.mesh, file.mesh["sha256"]});
    inputs.push_back({file.pair.marks, file.marks_sha256});
  }
  return inputs;
}

}  // namespace morsel::tools
