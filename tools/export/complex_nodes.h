#pragma once
/// Nodes of a complex as files have them: each with a place, and with finite values.

#include <span>

#include "morsel/core/field/scalar_field.h"
#include "morsel/mscomplex/complex.h"

namespace morsel::tools {

/// A node's vertex, or the middle of a cap's loop, which has no vertex of its own.
core::Point place_of(const core::TriangleMesh& mesh, const mscomplex::Node& node);
/// A node's value; of a cap, whose value is infinite, the field's maximum.
double finite_value(const mscomplex::Node& node, const core::ScalarField& field);
/// That of the node's vertex, among one for each vertex of the mesh; infinite for a cap.
double persistence_of(const mscomplex::Node& node, std::span<const double> persistence);

}  // namespace morsel::tools
