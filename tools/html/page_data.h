#pragma once
/// The data of a mesh and of each method in a page: arrays in its buffers, and metadata that refer to them.

#include <span>
#include <vector>

#include "morsel/tools/html/buffers.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools::html {

/// {"vertices", "triangles", "origin"[3], "step", "positions", "corners", "input_vertices"}: coordinate c of
/// vertex v is origin[c] + step × positions[c · vertices + v], within half a step; `input_vertices` is null
/// where numbers are the input's.
Json write_mesh(const core::LoadedMesh& loaded, Buffers& buffers);

/// {"name", "values", "points", "pairs", "segments", "arcs"}. Vertices are the mesh's here.
///   values    {"low", "high", "data"}: low + (high − low) · data / 65535; values outside are clamped
///   points    {"vertex", "place", "type" (1 minimum, 2 saddle, 3 maximum), "multiplicity", "value",
///             "origin" (1 + vertex, or 0 if it has none), "match" (1 + its counterpart's number among the
///             first method's points, or 0)}; persistence follows from the pairs
///   pairs     {"extremum", "saddle"}: numbers of points, by ascending persistence; number of points + k is
///             loop k's cap
///   segments  {"ascending", "descending"}: a label per triangle
///   arcs      {"descending", "ascending"}: html/arc_paths.h, the saddle as a number of a point
Json write_method(const MethodOutcome& outcome, Buffers& buffers);

}  // namespace morsel::tools::html
