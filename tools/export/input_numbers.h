#pragma once
/// Fields and triangles of a mesh in the vertex numbers of its input file.

#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/mesh_io.h"

namespace morsel::tools {

/// A value for each of the input's vertices: nan for one that the mesh does not have, that of the first copy
/// for one that repair split.
std::vector<double> by_input_vertex(const core::ScalarField& field, const core::VertexNumbering& numbering);

/// The mesh's triangles on the input's vertices.
std::vector<core::Triangle> on_input_vertices(const core::TriangleMesh& mesh,
                                              const core::VertexNumbering& numbering);

}  // namespace morsel::tools
