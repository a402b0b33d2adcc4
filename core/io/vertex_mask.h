#pragma once
/// Which vertices of a mesh's file are left out of the mesh. Internal to make_mesh().

#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"

namespace morsel::core {

struct VertexMask {
  std::vector<bool> left_out;              ///< by vertex of the file; empty if all stay
  std::vector<std::string> warnings = {};  ///< how many, and why
};

/// The vertices where BuildOptions::mask is 0 or nan and those where BuildOptions::needed are nan. Values
/// that are needed and cannot be had leave no vertex out: the field that needs them says why. Throws BadInput
/// if the mask cannot be read or has not one value for each vertex, InvalidArgument unless exactly one of its
/// file and property is given. O(n).
VertexMask read_vertex_mask(const LoadedSoup& file, const BuildOptions& options,
                            const Progress& progress = {});

/// "file=inside.csv,column=2", "property=inside" or the path of a file, whose text has no "="; a backslash
/// keeps the next character from separating. Throws InvalidArgument, naming `what`.
VertexValues parse_vertex_values(std::string_view text, std::string_view what);
/// The text that parse_vertex_values() reads it from.
std::string to_string(const VertexValues& values);

}  // namespace morsel::core
