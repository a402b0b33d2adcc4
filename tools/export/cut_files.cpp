#include "morsel/tools/export/cut_files.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/formats/vtp_writer.h"

namespace morsel::tools {
namespace {

bool is_ply(const core::FileTarget& target) {
  return core::checked_extension(target, "a cut mesh is written", {".off", ".ply"}) == ".ply";
}

}  // namespace

void check_cut_mesh_path(const core::FileTarget& target) { is_ply(target); }

void write_cut_mesh(const core::FileTarget& target, const mscomplex::CutMesh& cut,
                    const core::VertexNumbering& numbering, const Provenance& provenance,
                    const core::Progress& progress) {
  if (!is_ply(target)) {
    core::write_off(target, cut.mesh, provenance.lines(), progress);
    return;
  }
  core::VertexProperty input_vertex{"input_vertex", std::vector<double>(cut.mesh.vertex_count())};
  for (core::Index v = 0; v < cut.mesh.vertex_count(); ++v)
    input_vertex.values[v] = numbering.input_vertex(cut.original(v));
  core::write_ply(target, cut.mesh, {&input_vertex, 1}, provenance.lines(), progress);
}

void check_cut_graph_path(const core::FileTarget& target) {
  core::checked_extension(target, "a cut is written for ParaView", {".vtp"});
}

void write_cut_graph(const core::FileTarget& target, const mscomplex::CutGraph& cut,
                     const core::LoadedMesh& loaded, const Provenance& provenance) {
  std::vector<core::Point> points;
  std::vector<core::Index> vertices;
  std::vector<std::int64_t> ends;
  std::vector<double> lengths;
  std::vector<core::Index> components;
  for (const mscomplex::CutPath& line : cut.paths) {
    for (const core::Index v : line.vertices) {
      points.push_back(loaded.mesh.position(v));
      vertices.push_back(loaded.source.numbering.input_vertex(v));
    }
    ends.push_back(static_cast<std::int64_t>(points.size()));
    lengths.push_back(line.length);
    components.push_back(line.component);
  }
  VtpDocument document;
  document.points = {points};
  document.lines = {ends.size(), 0, [&](std::size_t i) { return ends[i]; }};
  document.point_arrays = {{"input_vertex", std::span<const core::Index>(vertices), core::kNone}};
  document.cell_arrays = {{"length", std::span<const double>(lengths)},
                          {"component", std::span<const core::Index>(components), core::kNone}};
  document.provenance = provenance.json();
  write_vtp(target, document);
}

}  // namespace morsel::tools
