#pragma once
/// Marked points: the list of meshes that are marked, and the files of their vertices.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/mesh_io.h"

namespace morsel::tools {

/// A mesh and the file of its marked vertices, as paths in a list.
struct MarkedPair {
  std::string mesh;
  std::string marks;
};

/// A list of pairs, one a line: two paths separated by a comma, by a tab where the line has no comma, or else
/// by white space; in double quotes where they have such characters themselves (a quote within is doubled).
/// Empty lines and those that begin with # are skipped, as is a first line whose first word is "mesh", the
/// heading of a table. Throws BadInput, naming the list as `name` and the line, on lines of another form, on
/// a pair that is listed twice, and if there is none.
std::vector<MarkedPair> parse_marked_pairs(std::string_view text, const std::string& name);

/// A vertex as it is written in a file.
struct Mark {
  std::uint64_t number;
  std::size_t line;
};

/// The vertices of a file, in one of three forms, told apart by what it holds:
/// - numbers, any number of them a line
/// - a number and a position (four words a line, some position not a whole number of 0 and above): the
///   position is not used
/// - a table whose heading begins with the word "vertex": the first column
/// Words are separated by white space, commas or semicolons; # and % begin comments. A number may be written
/// as a real one ("1.2e+03"). Throws BadInput, naming the file as `name` and the line, on other words, and if
/// there is no vertex.
std::vector<Mark> parse_marks(std::string_view text, const std::string& name);

/// The marked vertices of a mesh, each once, in the order of the file.
struct MarkedVertices {
  std::vector<core::Index> vertices;  ///< of the mesh
  std::vector<std::string> warnings;  ///< what was tolerated: vertices that are marked twice
};

/// Looks the vertices up, which have the numbers of the mesh's file; the first of them is `first` (0 or 1).
/// Throws BadInput, naming the file of marks as `name` and the line, on vertices that the mesh does not have
/// or that repair has removed.
MarkedVertices find_marked_vertices(const std::vector<Mark>& marks, std::uint64_t first,
                                    const core::LoadedMesh& loaded, const std::string& name);

}  // namespace morsel::tools
