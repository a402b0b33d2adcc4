#pragma once
/// Values that come with the mesh: from a file of values, or from a property of the mesh's own file.

#include <memory>
#include <string>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/vertex_values.h"

namespace morsel::morse {

using VertexScalarOptions = core::VertexValues;

/// The field with the given values. They are numbered as the vertices of the mesh's *file*, so `source` maps
/// them to mesh vertices (null: a mesh made in memory, with the numbers of its own vertices). Where several
/// of the file's vertices became one, it has the value of its VertexNumbering::to_input (and the Morse
/// function warns where others have another one in a file of values); values of vertices that were dropped
/// are not used and may be nan.
///
/// Throws InvalidArgument unless one of file and property is set; BadInput, naming file, line and value, if
/// the file is missing or unreadable, a line is not one number, there are too few or too many values, a
/// vertex of the mesh has a non-finite one, or the property or column does not exist (listing those that do).
/// `warnings` receives what was odd in the file, a sentence each. O(n log n).
core::ScalarField vertex_scalar(const core::TriangleMesh& mesh, const core::MeshSource* source,
                                const VertexScalarOptions& options, const core::Progress& progress = {},
                                std::vector<std::string>* warnings = nullptr);

/// Keys: file=PATH, with column=NAME where it has several, or property=NAME. The file is read when the
/// function is evaluated.
std::unique_ptr<core::MorseFunction> make_vertex_scalar(core::ParameterReader& reader);

}  // namespace morsel::morse
