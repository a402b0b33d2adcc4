#pragma once
/// The marked meshes of a list, read from files.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/study/landmarks.h"
#include "morsel/tools/study/marks.h"

namespace morsel::tools {

/// The pairs of a list (marks.h), whose relative paths begin at the list's folder, with their hashes.
class MarkedFiles : public MarkedMeshes {
 public:
  /// Reads the list and all files of vertices; meshes are read by load(). `first`: the number of a file's
  /// first vertex. Throws BadInput on what cannot be read, or as parse_marked_pairs() and parse_marks().
  MarkedFiles(const std::filesystem::path& list, std::uint64_t first, const core::BuildOptions& build);

  std::size_t size() const override { return files_.size(); }
  /// The mesh's path from the working folder.
  std::string name(std::size_t i) const override { return path_of(i).string(); }
  /// Throws as core::read_mesh() and find_marked_vertices().
  MarkedMesh load(std::size_t i, const core::Progress& progress) override;

  const HashedFile& list() const { return list_; }
  std::filesystem::path path_of(std::size_t i) const { return folder_ / files_[i].pair.mesh; }
  std::filesystem::path marks_path_of(std::size_t i) const { return folder_ / files_[i].pair.marks; }
  const core::BuildOptions& build() const { return build_; }

  /// {"mesh", "marks"}: what documents say of a pair, paths as in the list. `mesh` is a mesh_section(), there
  /// after load() or set_mesh().
  Json section(std::size_t i) const;
  /// The "warnings" in it.
  std::vector<std::string> warnings(std::size_t i) const;
  /// The mesh_section() of the same file from an earlier run.
  void set_mesh(std::size_t i, Json section);
  /// Of the mesh's file as it is now; and of the file of vertices when it was read.
  std::string mesh_sha256(std::size_t i) const { return sha256_of(MeshOrigin{path_of(i)}, build_); }
  const std::string& marks_sha256(std::size_t i) const { return files_[i].marks_sha256; }
  /// All of them, with the paths that section() has: the list, and each mesh with its vertices.
  std::vector<HashedFile> inputs() const;

 private:
  struct File {
    MarkedPair pair;
    std::vector<Mark> marks;
    std::string marks_sha256;
    Json mesh = {};
  };

  std::filesystem::path folder_;
  HashedFile list_;
  std::uint64_t first_;
  core::BuildOptions build_;
  std::vector<File> files_;  // each is changed by one thread
};

}  // namespace morsel::tools
