#pragma once
/// Coloured surfaces for slides, web pages and Blender: binary glTF 2.0 (.glb).

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/types.h"

namespace morsel::tools {

/// Triangles that a viewer can show and hide by a name; refers to the caller's data.
struct GlbPart {
  std::string name;
  std::span<const core::Point> positions = {};
  std::span<const core::Point> normals = {};       ///< one for each position; unit, or 0 where there is none
  std::span<const core::Triangle> triangles = {};  ///< seen from both sides
  Eigen::Vector3f color = {1, 1, 1};               ///< of the whole, in linear light
  std::span<const Eigen::Vector3f> colors = {};    ///< or one for each position
};

/// Writes all parts that have triangles, at least one of which there must be, into one scene. Numbers are
/// single precision; positions are relative to the middle of the first part, which a node holds in full.
/// `provenance`, a JSON object, goes into asset.extras. The file is written whole or not at all. Throws
/// WriteFailed, also if it would have 4 GiB or more, which the format cannot hold.
void write_glb(const core::FileTarget& target, const std::vector<GlbPart>& parts,
               const std::string& provenance, core::Sync sync = core::Sync::when_replacing);

}  // namespace morsel::tools
