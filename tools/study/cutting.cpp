#include "morsel/tools/study/cutting.h"

#include <utility>

#include "morsel/tools/study/comparison.h"

namespace morsel::tools {
namespace {

std::vector<ComponentCut> by_component(const core::TriangleMesh& mesh, const mscomplex::CutGraph& found,
                                       const CutOutcome& outcome) {
  std::vector<ComponentCut> components(mesh.component_count());
  for (core::Index c = 0; c < mesh.component_count(); ++c) {
    components[c].genus = mesh.genus(c);
    components[c].loops = mesh.boundary_loop_count(c);
  }
  for (core::Index v = 0; v < mesh.vertex_count(); ++v) ++components[mesh.component_of_vertex(v)].vertices;
  for (const core::Index v : outcome.opened.copied) ++components[mesh.component_of_vertex(v)].copies;
  for (const mscomplex::CutPath& path : found.paths) components[path.component].length_found += path.length;
  for (const mscomplex::CutPath& path : outcome.cut.paths) {
    ++components[path.component].paths;
    components[path.component].length += path.length;
  }
  return components;
}

}  // namespace

CutOutcome cut_surface(const core::ScalarField& field, bool shorten, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const Stopwatch complex_watch;
  const mscomplex::MorseSmaleComplex complex(field, progress);
  const double complex_seconds = complex_watch.seconds();

  const Stopwatch cut_watch;
  const mscomplex::CutGraph found = mscomplex::find_cut(complex, field, progress);
  const double cut_seconds = cut_watch.seconds();

  const Stopwatch shorten_watch;
  mscomplex::ShortenedCut shortened{.cut = found};
  if (shorten) shortened = mscomplex::shorten(mesh, found, {}, progress);
  const double shorten_seconds = shorten_watch.seconds();

  const Stopwatch open_watch;
  mscomplex::CutMesh opened = mscomplex::cut_open(mesh, shortened.cut.edges);
  CutOutcome outcome{.cut = std::move(shortened.cut),
                     .length_found = found.length,
                     .attempts = shortened.attempts,
                     .replaced = shortened.replaced,
                     .is_settled = shortened.is_settled,
                     .opened = std::move(opened),
                     .components = {},
                     .complex_seconds = complex_seconds,
                     .cut_seconds = cut_seconds,
                     .shorten_seconds = shorten_seconds,
                     .open_seconds = open_watch.seconds()};
  outcome.components = by_component(mesh, found, outcome);
  return outcome;
}

}  // namespace morsel::tools
