#include "morsel/tools/export/complex_nodes.h"

#include <cmath>

#include "morsel/persistence/diagram.h"

namespace morsel::tools {
namespace {

core::Point loop_center(const core::TriangleMesh& mesh, core::Index loop) {
  core::Point sum = core::Point::Zero();
  for (const core::Index h : mesh.boundary_loop(loop)) sum += mesh.position(mesh.origin(h));
  return sum / static_cast<double>(mesh.boundary_loop(loop).size());
}

}  // namespace

core::Point place_of(const core::TriangleMesh& mesh, const mscomplex::Node& node) {
  return node.kind == mscomplex::NodeKind::cap ? loop_center(mesh, node.cell) : mesh.position(node.vertex);
}

double finite_value(const mscomplex::Node& node, const core::ScalarField& field) {
  return std::isfinite(node.value) ? node.value : field.max();
}

double persistence_of(const mscomplex::Node& node, std::span<const double> persistence) {
  return node.kind == mscomplex::NodeKind::cap ? persistence::kInfinite : persistence[node.vertex];
}

}  // namespace morsel::tools
