#include "morsel/tools/export/hierarchy_export.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/export/complex_file.h"
#include "morsel/tools/export/surface_file.h"

namespace morsel::tools {
namespace {

using core::Index;

std::int64_t number(Index i) { return i == core::kNone ? -1 : std::int64_t{i}; }

/// Per triangle, the cell that its own is linked to. Refers to its arguments.
VtpArray linked_cells(std::string name, const std::vector<Index>& labels,
                      const std::vector<mscomplex::Overlap>& links) {
  return {std::move(name), labels.size(), labels.size(),
          [&labels, &links](std::size_t t) { return number(links[labels[t]].segment); }};
}

}  // namespace

HierarchyExport::HierarchyExport(ResultFolder& folder, const core::LoadedMesh& loaded, Provenance provenance)
    : folder_(folder), loaded_(loaded), provenance_(std::move(provenance)) {}

void HierarchyExport::begin(const HierarchyBasis& basis) {
  field_name_ = basis.made.input.name;
  original_ = basis.made.input.field;
  provenance_.set_field(basis.made.input);
  provenance_.add_method(basis.made.outcome.steps);
}

void HierarchyExport::level(const Level& level) {
  const std::string place = std::to_string(level.place);
  Provenance provenance = provenance_;
  provenance.set("level", {{"place", level.place}, {"asked", level.name.asked}});
  const core::FileTarget surface = folder_.claim("surface." + place + ".vtp");
  const core::FileTarget complex = folder_.claim("complex." + place + ".vtp");
  std::vector<double> persistence(loaded_.mesh.vertex_count(), 0);
  for (std::size_t i = 0; i < level.points.points.size(); ++i)
    persistence[level.points.points[i].vertex] = level.persistence[i];
  core::parallel_for(0, 2, 1, [&](std::size_t i, std::size_t) {
    if (i == 0)
      write_surface(surface, level, persistence, provenance);
    else
      write_complex(complex, level, persistence, provenance);
  });
}

void HierarchyExport::write_surface(const core::FileTarget& target, const Level& level,
                                    std::span<const double> persistence, const Provenance& provenance) const {
  std::vector<std::uint8_t> types(loaded_.mesh.vertex_count(), 0);
  for (const morse::CriticalPoint& point : level.points.points)
    types[point.vertex] = static_cast<std::uint8_t>(point.type);
  std::vector<VtpArray> links;
  links.reserve(2 * mscomplex::kSegmentKinds.size());
  for (const SegmentKind kind : mscomplex::kSegmentKinds) {
    const std::string name = key_of(kind);
    const std::vector<Index>& labels = level.cells(kind).triangle;
    links.push_back(linked_cells(name + "_parent", labels, level.cell_links(kind).parents));
    links.push_back(linked_cells(name + "_merges_into", labels, level.cell_links(kind).merges_into));
  }
  write_surface_file(target,
                     {loaded_, field_name_, *level.field, *original_, types, persistence, level.segmentation},
                     provenance, links);
}

void HierarchyExport::write_complex(const core::FileTarget& target, const Level& level,
                                    std::span<const double> persistence, const Provenance& provenance) const {
  const mscomplex::MorseSmaleComplex& complex = level.complex;
  const std::vector<morse::CriticalPoint>& points = level.points.points;
  const core::VertexNumbering& numbering = loaded_.source.numbering;
  const std::size_t nodes = complex.node_count();
  std::vector<std::int64_t> parents(nodes + complex.arc_count(), -1);
  for (Index n = 0; n < nodes; ++n) {
    const mscomplex::Node node = complex.node(n);
    if (node.kind == mscomplex::NodeKind::cap) continue;
    const auto point = std::ranges::lower_bound(points, node.vertex, {}, &morse::CriticalPoint::vertex);
    const Index parent = level.parents[static_cast<std::size_t>(point - points.begin())];
    if (parent != core::kNone) parents[n] = numbering.input_vertex(parent);
  }
  write_complex_file(
      target, {loaded_, complex, field_name_, *level.field, persistence}, provenance,
      {{"parent", parents.size(), numbering.input_count, [&](std::size_t i) { return parents[i]; }}});
}

}  // namespace morsel::tools
