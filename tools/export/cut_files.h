#pragma once
/// A cut surface and its cut as files.

#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/mscomplex/cut.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// Throws InvalidArgument unless write_cut_mesh() knows the path's ending; to be called before long work.
void check_cut_mesh_path(const core::FileTarget& target);

/// Writes the mesh cut open: .off, or .ply with the vertex property `input_vertex`, the number that a
/// vertex, or the one that it copies, has in the input file. Throws InvalidArgument on another ending,
/// WriteFailed.
void write_cut_mesh(const core::FileTarget& target, const mscomplex::CutMesh& cut,
                    const core::VertexNumbering& numbering, const Provenance& provenance,
                    const core::Progress& progress = {});

/// Throws InvalidArgument unless the path ends in .vtp.
void check_cut_graph_path(const core::FileTarget& target);

/// Writes the cut for ParaView (.vtp): a polyline a path, with its length and component, and at each
/// point the vertex in the input's numbers. Throws WriteFailed.
void write_cut_graph(const core::FileTarget& target, const mscomplex::CutGraph& cut,
                     const core::LoadedMesh& loaded, const Provenance& provenance);

}  // namespace morsel::tools
