#pragma once
/// A Morse-Smale complex as lines on its surface, as one file for ParaView.

#include <filesystem>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/tools/formats/vtp_writer.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// Nodes as vertices, then arcs as lines. Per cell `kind` (0 minimum, 1 saddle, 2 maximum, 3 cap, 4
/// descending arc, 5 ascending arc), `vertex` (a node's critical vertex, an arc's saddle) and `end_vertex`
/// (where an arc ends; −1 for nodes and at caps), in the input's numbers; `more` are further arrays of one
/// value a node and one an arc. Does not wait until the file is on disk. Throws WriteFailed.
void write_complex_file(const core::FileTarget& target, const core::LoadedMesh& loaded,
                        const mscomplex::MorseSmaleComplex& complex, const Provenance& provenance,
                        const std::vector<VtpArray>& more = {});

}  // namespace morsel::tools
