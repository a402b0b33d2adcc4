#pragma once
/// One field as a file: text, PLY, VTP, GLB or GIFTI.

#include <string>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/report/field_document.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// Writes the field of `source` in the vertex numbers of the input file: .txt has one value a line, as short
/// as reads back exactly, below lines that begin with #; .ply (binary) and .vtp have the surface with the
/// values as vertex property NAME, that of the Morse function; .ply again as `quality`, with colours
/// (ply_colors.h); .vtp, where a method has changed the field, with NAME_original and NAME_change
/// (surface_file.h); .shape.gii and .func.gii (GIFTI) have the values in single precision. An input vertex
/// that the mesh does not have gets `nan`; one that repair split gets the value of its first copy. .glb has
/// the surface with colours, and the chosen points or else all critical points (glb_scene.h). Chosen points,
/// if there are any, are a property `chosen` (chosen_order()) of .ply and .vtp. Throws InvalidArgument on
/// another ending, WriteFailed where writing fails.
void write_field(const core::FileTarget& target, const FieldSource& source,
                 std::span<const core::Point> input_positions, const Provenance& provenance,
                 const MadePoints* chosen = nullptr);

/// Throws InvalidArgument unless write_field() knows the path's ending; to be called before long work.
void check_field_path(const core::FileTarget& target);

/// Whether a file of this ending has chosen points, too.
bool holds_points(const core::FileTarget& field);

}  // namespace morsel::tools
