#pragma once
/// The meshes that an interrupted study of landmarks has done.

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "morsel/tools/formats/journal.h"
#include "morsel/tools/report/marked_files.h"

namespace morsel::tools {

/// Keeps the result of each mesh in a journal, an entry each, by the hashes of its mesh and its vertices: a
/// file that has changed since counts as new.
class LandmarksJournal : public LandmarksStore {
 public:
  /// Refers to all but `known`, the files that the fields read. Entries that are no results of this plan are
  /// dropped.
  LandmarksJournal(Journal& journal, MarkedFiles& files, const LandmarksPlan& plan,
                   std::vector<HashedFile> known);

  std::optional<LandmarksOnMesh> find(std::size_t mesh) override;
  void add(std::size_t mesh, const LandmarksOnMesh& result) override;

  /// The number of meshes that the journal has.
  std::size_t count() const { return known_.size(); }

 private:
  using Hashes = std::pair<std::string, std::string>;  // of the mesh and of its vertices
  struct Entry {  // NOLINT(bugprone-exception-escape): of the JSON library
    Json mesh;
    LandmarksOnMesh result;
  };

  Journal& journal_;
  MarkedFiles& files_;
  const LandmarksPlan& plan_;
  std::vector<HashedFile> field_files_;
  std::map<Hashes, Entry> known_;
};

}  // namespace morsel::tools
