#include "morsel/tools/report/landmarks_journal.h"

#include <utility>

#include "morsel/tools/report/landmarks_result.h"
#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools {

LandmarksJournal::LandmarksJournal(Journal& journal, MarkedFiles& files, const LandmarksPlan& plan,
                                   std::vector<HashedFile> known)
    : journal_(journal), files_(files), plan_(plan), field_files_(std::move(known)) {
  journal.take_entries([&](const JsonView& entry) {
    const JsonView mesh = entry["mesh"];
    check_mesh(mesh);
    check_sha256(entry["marks"]["sha256"]);
    LandmarksOnMesh result = read_result(entry["result"], plan_);
    result.seconds = entry["seconds"].number(0);
    known_[{mesh["sha256"].text(), entry["marks"]["sha256"].text()}] = {mesh.json(), std::move(result)};
  });
}

std::optional<LandmarksOnMesh> LandmarksJournal::find(std::size_t mesh) {
  if (known_.empty()) return std::nullopt;
  const auto entry = known_.find({files_.mesh_sha256(mesh), files_.marks_sha256(mesh)});
  if (entry == known_.end()) return std::nullopt;
  files_.set_mesh(mesh, entry->second.mesh);
  return entry->second.result;
}

void LandmarksJournal::add(std::size_t mesh, const LandmarksOnMesh& result) {
  Json entry = files_.section(mesh);
  entry["result"] = result_section(result, plan_, field_files_);
  entry["seconds"] = result.seconds;
  journal_.add(entry);
}

}  // namespace morsel::tools
