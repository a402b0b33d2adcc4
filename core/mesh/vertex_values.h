#pragma once
/// Where values for the vertices of a mesh's file come from.

#include <filesystem>
#include <string>

namespace morsel::core {

/// Exactly one of file and property.
struct VertexValues {
  /// A value for each vertex of the mesh's file, in its order: a text with a value a line (blank lines and
  /// what follows a # do not count), CSV, NumPy's .npy, or another mesh file with values for its vertices.
  std::filesystem::path file;
  /// Name of a scalar that the mesh's file gives for its vertices (PLY, VTK).
  std::string property;
  /// Of the file's columns or arrays, the name or the number (from 1) of one; empty: it has only one.
  std::string column = {};

  friend bool operator==(const VertexValues&, const VertexValues&) = default;
};

}  // namespace morsel::core
