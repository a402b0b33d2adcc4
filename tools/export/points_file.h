#pragma once
/// Chosen points as files: a table, a cloud of points for other programs.

#include <cstdint>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/report/field_document.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// Writes the points in the order in which they were chosen, with the vertex numbers of the input file:
///   .csv  a row for each: vertex, x, y, z, type, type_code, multiplicity, value, persistence, rank,
///   distance, percentile, field; the provenance in comments below them .ply, .vtp  a point for each, with
///   the numbers among these as properties or arrays: `type` (type_code of the table) is 1 for minima, 2 for
///   saddles, 3 for maxima, `field` 0, or 1 where the field that fills up has the point; persistence is
///   finite, with `essential` (finite_persistence.h). .ply has the colours of the types, and `value` again as
///   `quality` (ply_colors.h). .glb  the surface in the colours of the field, and the points on it
///   (glb_scene.h)
/// Infinite numbers are "inf"; a percentile that was not asked for is empty, or nan. Throws InvalidArgument
/// on another ending, WriteFailed where writing fails.
void write_points(const core::FileTarget& target, const MadePoints& made, const FieldSource& source,
                  const Provenance& provenance);

/// The table (.csv) alone, at any path; `sync` as FileWriter's.
void write_points_table(const core::FileTarget& target, const MadePoints& made,
                        const core::LoadedMesh& loaded, const std::string& field_name,
                        const Provenance& provenance, core::Sync sync = core::Sync::when_replacing);

/// For each of so many vertices: 1 for the point that was chosen first, 2 for the next, …, 0 where none was.
std::vector<std::int32_t> chosen_order(const MadePoints& made, core::Index vertices);

/// Throws InvalidArgument unless write_points() knows the path's ending, or it is .json, whose document
/// points_writer.h makes; to be called before long work.
void check_points_path(const core::FileTarget& target);

}  // namespace morsel::tools
