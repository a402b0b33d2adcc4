#pragma once
/// glTF 2.0, of the part FORMATS of the library: by tinygltf, without pictures. Internal.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// The triangles of a glTF file, .gltf (JSON) or .glb (binary), told apart by the first bytes.
///
/// What is read: the primitives TRIANGLES, TRIANGLE_STRIP and TRIANGLE_FAN of all meshes in the default scene
/// (the first one, or all roots of nodes, or all meshes, if there is none), with the transforms of their
/// nodes. Order: nodes depth first in the order of the file, primitives in that of their mesh. Vertices are
/// those of the primitives' accessors, all of them and in their order; primitives of one node that share
/// their accessors share the vertices, others are not joined. Triangles of strips that repeat a vertex are
/// left out, and a node that mirrors turns its triangles round. Attributes `_NAME` of scalars are vertex
/// properties, NaN where a primitive has none.
///
/// Buffers are the binary part, data URIs, or files in `folder` itself; without it, those are refused. Every
/// accessor is compared with the lengths of its buffers before it is read. Points, lines, skins, morph
/// targets and instances are left out with a warning; compressed primitives (Draco, meshopt) and other
/// required extensions that change geometry are refused by name. Of a scene that morsel wrote, by the
/// generator in it, the surface alone is read, with a warning. Repetition is limited: 2²³ vertices and
/// corners and 16 for each byte.
LoadedSoup read_gltf(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_gltf(std::string_view bytes, const std::string& file, const Progress& progress,
                     const std::filesystem::path& folder);

/// The files that the buffers of a glTF file name, each once and by name, whether they exist or not. Throws
/// BadInput if it cannot be read.
std::vector<std::filesystem::path> gltf_companions(const std::filesystem::path& path);

}  // namespace morsel::core
